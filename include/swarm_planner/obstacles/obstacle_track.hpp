// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// An obstacle as it was seen at `stamp`. Not called ObstacleTrack: catkin puts the message of that name, which the
/// contract fixes, into this same namespace.
struct TrackedObstacle {
  Superellipsoid shape;         ///< centre at `stamp`, planning frame
  double stamp = 0.0;           ///< [s]
  double position_sigma = 0.0;  ///< standard deviation of the centre [m]
  double velocity_sigma = 0.0;  ///< standard deviation of the velocity [m/s]
};

}  // namespace swarm_planner
