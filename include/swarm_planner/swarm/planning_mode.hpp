// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace swarm_planner {

/// How a swarm is planned: Problem 2, one UAV after the other, or Problem 1, all of them at once.
enum class PlanningMode { kIterative, kJoint };

/// Why a swarm of so many UAVs cannot be planned in a mode, in words; empty if it can.
std::optional<std::string> planningModeFault(PlanningMode mode, std::size_t uavs);

}  // namespace swarm_planner
