// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// How far ahead shortfalls are looked at [s].
constexpr double kShortfallTime = 10.0;

/// By how much, and for how long, a motion and its rest fall short of the least distances within kShortfallTime from
/// `from` [s] on: the integral over time of the worst shortfall at each moment [m s]; 0 if they keep them. So of two
/// motions that begin too close to something the one that leaves sooner has less. A motion that hits what is mapped
/// counts as staying there: of two that do, the one that comes there later, or slower, has less. Looked at every 0.05
/// s: it ranks motions none of which is safe, it proves nothing.
double shortfall(const CommittedMotion& motion, double from, const CheckLimits& limits,
                 const CheckSurroundings& surroundings);

}  // namespace swarm_planner
