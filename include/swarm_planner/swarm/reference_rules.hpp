// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Throws std::invalid_argument with the reason unless `path` has 1 to kMostPathPoints plausible points, `start` [m] is
/// finite and not negative, and `speed` [m/s] is within 0 and kMostSpeed.
void requireReference(const std::vector<Vector3>& path, double start, double speed);

}  // namespace swarm_planner
