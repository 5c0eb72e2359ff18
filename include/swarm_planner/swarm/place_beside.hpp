// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>

#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// Where a UAV that was to rest at `place`, where obstacle `obstacle` of the surroundings will come, may rest instead
/// from time `t` [s] on: beside the obstacle's way, to the right or left of it, above or below, whichever is nearest
/// and clear of everything. Empty if none of them is. Takes no heap.
std::optional<Vector3> placeBeside(const Vector3& place, std::size_t obstacle, double t, const CheckLimits& limits,
                                   const CheckSurroundings& surroundings);

}  // namespace swarm_planner
