// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/model/setpoints.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {

namespace {
/// A last interval shorter than this fraction of dt is rounding: merged into the one before.
constexpr double kShortestInterval = 1e-6;
}  // namespace

void samplePlan(const Trajectory& plan, double dt, double horizon, double yaw, SetpointTrajectory& out) {
  const double end = std::min(horizon, plan.duration());
  const auto intervals = static_cast<std::size_t>(std::max(0.0, std::ceil(end / dt - kShortestInterval)));
  out.epoch = plan.epoch;
  out.points.resize(intervals + 1);
  for (std::size_t i = 0; i <= intervals; ++i) {
    Setpoint& point = out.points[i];
    point.time_from_start = i < intervals ? static_cast<double>(i) * dt : std::max(0.0, end);
    const KinematicState x = plan.after(point.time_from_start);
    point.p = x.p;
    point.v = x.v;
    point.a = x.a;
    point.yaw = yaw;
  }
}

}  // namespace swarm_planner
