// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace swarm_planner {

/// How a swarm is planned: Problem 2, one UAV after the other; Problem 1, all of them at once; or groups of those that
/// interact strongly at once, one group or UAV after the other.
enum class PlanningMode { kIterative, kJoint, kGroups };

/// "iterative", "joint", "groups".
const char* planningModeText(PlanningMode mode);
std::optional<PlanningMode> planningModeFrom(const std::string& text);

/// Why a swarm of so many UAVs cannot be planned in a mode, `as_paper` or not, in words; empty if it can.
std::optional<std::string> planningModeFault(PlanningMode mode, std::size_t uavs, bool as_paper);

}  // namespace swarm_planner
