// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "swarm_planner/experiments/json_object.hpp"
#include "swarm_planner/experiments/run_result.hpp"

namespace swarm_planner {

/// Injected faults by kind as a table, and those that were missed; empty if none was injected.
std::string faultTable(const Scenario& scenario, const RunResult& run);

/// ", after push of uav1 at 3.20 s": the faults that concerned one of the two within the last seconds; may be empty.
std::string faultsBefore(const Collision& collision, const Scenario& scenario);

/// Adds the members "faults", "fault_misses", "worst_recovery_s" and "rehearsal" where there is something to tell.
void addFaults(const RunResult& run, JsonObject& object);

}  // namespace swarm_planner
