// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

/// Adds a fault for every number that is legal but beyond those of plausible.hpp: no scenario is there, and arithmetic
/// would fail on it.
void addAbsurdNumbers(const Scenario& scenario, const std::string& source, Faults& faults);

}  // namespace swarm_planner
