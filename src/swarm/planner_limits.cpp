// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/planner_limits.hpp"

namespace swarm_planner {
namespace {

constexpr double kReserve = 0.002;  // of the bounds, that the solver stays inside

}  // namespace

CheckLimits makeCheckLimits(const Parameters& parameters, const Workspace* workspace) {
  const LimitParameters& distances = parameters.limits;
  CheckLimits limits;
  limits.bounds = FlightBounds(parameters, workspace);
  limits.bound_slack = kBoundSlack;
  limits.workspace_slack = distances.tracking_margin;
  limits.pair_horizontal = distances.pair_distance + 2.0 * distances.tracking_error;
  limits.pair_vertical = distances.pair_distance_vertical + 2.0 * distances.tracking_error;
  return limits;
}

FlightBounds solverBounds(FlightBounds bounds) {
  bounds.max_speed *= 1.0 - kReserve;
  bounds.max_acceleration *= 1.0 - kReserve;
  bounds.max_thrust_acceleration *= 1.0 - kReserve;
  bounds.min_vertical_thrust += kReserve * bounds.gravity.z();
  return bounds;
}

}  // namespace swarm_planner
