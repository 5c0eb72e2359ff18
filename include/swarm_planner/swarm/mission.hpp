// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "swarm_planner/config/parameter_io.hpp"
#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// A validated scenario with the parameters that hold for it.
struct Mission {
  Scenario scenario;
  Parameters parameters;
  std::shared_ptr<const VoxelMap> map;  ///< of the scenario's map_file; null: there is none
};

/// Reads a scenario file and resolves its parameters on top of `given`. Throws ConfigError that lists every
/// fault, including UAVs that start inside each other's pair ellipsoid (14), closer than uav_radius to an obstacle's
/// surface or to an occupied voxel of the map, or outside the workspace, and a map file that cannot be read.
Mission loadMission(const std::string& scenario_path, const ParameterMap& given);

/// The same for a scenario made by a program; it is held to the rules of a scenario file. `source` names it in faults;
/// lines in them are those of toYaml(scenario).
Mission makeMission(const Scenario& scenario, const ParameterMap& given, const std::string& source);

/// Obstacle tracks in use at most: max_tracks, or as many as the scenario has obstacles if that is more.
std::size_t maxTracks(const Mission& mission);

/// The obstacle at its t = 0. Throws std::invalid_argument if its numbers make no superellipsoid, which a mission's
/// obstacles always do.
Superellipsoid makeObstacle(const ScenarioObstacle& obstacle);

}  // namespace swarm_planner
