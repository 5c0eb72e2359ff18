// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "swarm_planner/model/kinematics.hpp"

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

/// Samples a motion every `dt` [s] for `horizon` [s] (infinity: all of it), first point at its `epoch` [s], last one at
/// the horizon's end. motion.after(elapsed) is its KinematicState, motion.duration() its length [s]. Reuses the memory
/// of `out`.
template <class Motion>
void sampleMotion(const Motion& motion, double epoch, double dt, double horizon, double yaw, SetpointTrajectory& out) {
  constexpr double kShortestInterval = 1e-6;  // of dt: a last interval shorter than this is rounding
  const double end = std::max(0.0, std::min(horizon, motion.duration()));
  const auto intervals = static_cast<std::size_t>(std::max(0.0, std::ceil(end / dt - kShortestInterval)));
  out.epoch = epoch;
  out.points.resize(intervals + 1);
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double time = i < intervals ? static_cast<double>(i) * dt : end;
    const KinematicState x = motion.after(time);
    out.points[i] = {time, x.p, x.v, x.a, yaw};
  }
}

}  // namespace swarm_planner
