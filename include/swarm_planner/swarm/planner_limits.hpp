// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// Of a bound, by which a measured start may exceed it.
constexpr double kBoundSlack = 0.1;

/// What the check demands of a plan. `workspace`: of the scenario, null if it has none.
CheckLimits makeCheckLimits(const Parameters& parameters, const Workspace* workspace);

/// Bounds for the solver, which keeps tangents to them at the samples: a little inside of what the check demands.
FlightBounds solverBounds(FlightBounds bounds);

}  // namespace swarm_planner
