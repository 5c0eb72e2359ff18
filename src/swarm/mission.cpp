// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/mission.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <sstream>
#include <vector>

#include "swarm_planner/map/map_file.hpp"
#include "swarm_planner/map/octree_conversion.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {

namespace {

std::string startKey(std::size_t uav) { return "uavs[" + std::to_string(uav) + "].start"; }

std::string pairFault(const ScenarioUav& first, const ScenarioUav& second, const LimitParameters& limits) {
  std::ostringstream text;
  text << first.name << " and " << second.name << " start " << (first.start - second.start).norm()
       << " m apart, inside the pair ellipsoid of pair_distance " << limits.pair_distance
       << " m and pair_distance_vertical " << limits.pair_distance_vertical << " m";
  return text.str();
}

/// The axis along which the starts spread most.
int widestAxis(const std::vector<ScenarioUav>& uavs) {
  Vector3 low = uavs.front().start;
  Vector3 high = low;
  for (const ScenarioUav& uav : uavs) {
    low = low.cwiseMin(uav.start);
    high = high.cwiseMax(uav.start);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

/// UAVs that start too close to each other, eq. (14). Sorted along one axis, so that in large swarms only near ones
/// are compared.
void checkPairs(const std::vector<ScenarioUav>& uavs, const LimitParameters& limits, const std::string& source,
                Faults& faults) {
  const int axis = widestAxis(uavs);
  const double reach = axis == 2 ? limits.pair_distance_vertical : limits.pair_distance;
  std::vector<std::size_t> order(uavs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return uavs[i].start[axis] < uavs[j].start[axis]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Vector3 d = uavs[order[j]].start - uavs[order[i]].start;
      if (d[axis] >= reach) break;
      if (pairGauge(d, limits) >= 1.0) continue;
      const auto [first, second] = std::minmax(order[i], order[j]);
      faults.add(source, startKey(second), pairFault(uavs[first], uavs[second], limits));
    }
  }
}

/// UAVs that start closer than uav_radius to an obstacle's surface, or inside one.
void checkObstacles(const Scenario& scenario, const LimitParameters& limits, const std::string& source,
                    Faults& faults) {
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    const Superellipsoid shape = makeObstacle(obstacle);
    for (std::size_t i = 0; i < scenario.uavs.size(); ++i) {
      const ScenarioUav& uav = scenario.uavs[i];
      if (shape.distanceLowerBound(uav.start) >= limits.uav_radius) continue;
      const double distance = shape.signedDistance(uav.start);
      if (distance >= limits.uav_radius) continue;
      std::ostringstream text;
      if (distance < 0.0) {
        text << uav.name << " starts inside obstacle " << obstacle.id;
      } else {
        text << uav.name << " starts " << distance << " m from the surface of obstacle " << obstacle.id
             << ", less than uav_radius " << limits.uav_radius << " m";
      }
      faults.add(source, startKey(i), text.str());
    }
  }
}

/// UAVs that start closer than uav_radius to an occupied voxel, or inside one.
void checkMap(const Mission& mission, const std::string& source, Faults& faults) {
  const double radius = mission.parameters.limits.uav_radius;
  for (std::size_t i = 0; i < mission.scenario.uavs.size(); ++i) {
    const ScenarioUav& uav = mission.scenario.uavs[i];
    const double distance = mission.map->distance(uav.start, radius);
    if (distance >= radius) continue;
    std::ostringstream text;
    if (distance > 0.0) {
      text << uav.name << " starts " << distance << " m from an occupied voxel of the map, less than uav_radius "
           << radius << " m";
    } else {
      text << uav.name << " starts inside an occupied voxel of the map";
    }
    faults.add(source, startKey(i), text.str());
  }
}

/// The map of the scenario's file; null if it names none, and with a fault if that cannot be read.
std::shared_ptr<const VoxelMap> loadMap(const Scenario& scenario, const std::string& source, Faults& faults) {
  if (scenario.map_file.empty()) return nullptr;
  std::string why;
  std::shared_ptr<const VoxelMap> map;
  if (const std::optional<OctreeData> data = readMapFile(scenario.map_file, why)) {
    map = toVoxelMap(*data, scenario.unknown_is_occupied, nullptr, why);
  }
  if (map == nullptr) faults.add(source, "map.octomap", "cannot use '" + scenario.map_file + "': " + why);
  return map;
}

void checkWorkspace(const Scenario& scenario, const std::string& source, Faults& faults) {
  if (!scenario.workspace) return;
  for (std::size_t i = 0; i < scenario.uavs.size(); ++i) {
    const Vector3& start = scenario.uavs[i].start;
    if ((start.array() >= scenario.workspace->min.array()).all() &&
        (start.array() <= scenario.workspace->max.array()).all()) {
      continue;
    }
    faults.add(source, startKey(i), scenario.uavs[i].name + " starts outside the workspace");
  }
}

/// Whether a parameter, or the scenario's override of it, is among the faults.
bool isFaulty(const Faults& faults, const std::string& name) {
  return std::any_of(faults.list().begin(), faults.list().end(),
                     [&](const Fault& fault) { return fault.key == name || fault.key == "overrides." + name; });
}

/// The mission of a scenario read without faults other than those in `faults`. Throws ConfigError that lists all.
Mission resolve(const Scenario& scenario, const ParameterMap& given, const std::string& source, Faults& faults) {
  const bool scenario_stands = faults.empty();
  Mission mission{scenario, resolveParameters(given, scenario.overrides, source, faults),
                  loadMap(scenario, source, faults)};
  if (scenario_stands) {
    // A distance that is a fault itself stands at its default: starts judged by it would mislead.
    const LimitParameters& limits = mission.parameters.limits;
    if (!isFaulty(faults, "pair_distance") && !isFaulty(faults, "pair_distance_vertical")) {
      checkPairs(scenario.uavs, limits, source, faults);
    }
    if (!isFaulty(faults, "uav_radius")) {
      checkObstacles(scenario, limits, source, faults);
      if (mission.map != nullptr) checkMap(mission, source, faults);
    }
    checkWorkspace(scenario, source, faults);
  }
  faults.throwIfAny();
  return mission;
}

}  // namespace

Mission loadMission(const std::string& scenario_path, const ParameterMap& given) {
  Faults faults;
  const Scenario scenario = parseScenarioFile(scenario_path, faults);
  return resolve(scenario, given, scenario_path, faults);
}

Mission makeMission(const Scenario& scenario, const ParameterMap& given, const std::string& source) {
  Faults faults;
  // A program's scenario must satisfy what a file's must: written as one, it is judged by the same rules.
  parseScenarioText(toYaml(scenario), source, faults);
  return resolve(scenario, given, source, faults);
}

std::size_t maxTracks(const Mission& mission) {
  return std::max(static_cast<std::size_t>(mission.parameters.input.max_tracks), mission.scenario.obstacles.size());
}

Superellipsoid makeObstacle(const ScenarioObstacle& obstacle) {
  return Superellipsoid(obstacle.id, obstacle.center, obstacle.radii, obstacle.exponents, obstacle.yaw,
                        obstacle.velocity);
}

}  // namespace swarm_planner
