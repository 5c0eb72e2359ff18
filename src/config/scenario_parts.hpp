// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>

#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

/// A UAV at rest at the start of a straight reference, which its target leaves at t = 0 with `speed` [m/s].
ScenarioUav straightUav(std::size_t number, const Vector3& start, const Vector3& goal, double speed);

/// Ends once all UAVs are within 0.2 m of their references' ends, after 60 s at most.
EndCondition allAtGoal();

/// The velocity of (19) [m/s], to 1e-6: `heading` and `climb` angle in rad.
Vector3 velocityTowards(double speed, double heading, double climb);

}  // namespace swarm_planner
