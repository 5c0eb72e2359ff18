// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// By how much a motion falls short of the least distances at worst, from `from` [s] until it rests [m]; 0 if it keeps
/// them. Looked at every 0.05 s: it ranks motions none of which is safe, it proves nothing.
double worstShortfall(const CommittedMotion& motion, double from, const CheckLimits& limits,
                      const CheckSurroundings& surroundings);

}  // namespace swarm_planner
