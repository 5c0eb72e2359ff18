// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"

namespace swarm_planner {

/// Odometry of one UAV in the planning frame.
struct UavMeasurement {
  bool received = false;
  double stamp = 0.0;           ///< [s]
  Vector3 p = Vector3::Zero();  ///< [m]
  Vector3 v = Vector3::Zero();  ///< [m/s]
};

/// All that one cycle looks at. Sized once; filled anew each cycle.
struct Snapshot {
  double now = 0.0;                  ///< [s]
  std::vector<UavMeasurement> uavs;  ///< one per UAV, in the scenario's order
  /// What trackers report; need not be every obstacle, nor differ from the cycle before. Obstacles that are missing are
  /// remembered for track_timeout.
  std::vector<TrackedObstacle> obstacles;
  /// What is mapped, in the planning frame; null: nothing. Another one from one cycle to the next is a map that has
  /// changed.
  std::shared_ptr<const VoxelMap> map;
};

}  // namespace swarm_planner
