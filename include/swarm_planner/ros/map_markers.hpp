// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/publisher.h>

#include <string>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// A map as cubes of one size, those that can be seen.
struct MapDrawing {
  double width = 0.0;            ///< of a cube [m]
  std::vector<Vector3> centers;  ///< [m]
};

/// The occupied voxels with middles below `top` [m] that have a neighbour that is not occupied; if these are more than
/// `most` > 0, cubes of twice the width in their place, and so on.
MapDrawing drawingOf(const VoxelMap& map, double top, std::size_t most);

/// How high the scenario's UAVs are, at their starts and along their references [m].
double highestPoint(const Scenario& scenario);

/// Shows maps in rviz: one marker of cubes, coloured by height, sent once per map and kept for viewers that join later.
/// What is more than half a metre above all starts and references is left out: a ceiling would hide all.
class MapMarkers {
 public:
  MapMarkers(const Mission& mission, std::string frame, const MapOptions& options);

  void show(const VoxelMap& map);

 private:
  const std::string frame_;
  const double top_;  ///< [m]
  const std::size_t most_;
  ros::Publisher publisher_;
};

}  // namespace swarm_planner
