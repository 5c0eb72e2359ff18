// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/model/trajectory.hpp"

namespace swarm_planner {

/// One point of a published trajectory.
struct Setpoint {
  double time_from_start = 0.0;  ///< [s]
  Vector3 p = Vector3::Zero();
  Vector3 v = Vector3::Zero();
  Vector3 a = Vector3::Zero();
  double yaw = 0.0;  ///< [rad]
};

/// A trajectory as a vehicle receives it: sampled states from an epoch on.
struct SetpointTrajectory {
  double epoch = 0.0;  ///< [s]
  std::vector<Setpoint> points;
};

/// Samples a plan every `dt` [s] for `horizon` [s] (infinity: the whole plan), first point at the epoch, last one
/// at the horizon's end. Reuses the memory of `out`.
void samplePlan(const Trajectory& plan, double dt, double horizon, double yaw, SetpointTrajectory& out);

}  // namespace swarm_planner
