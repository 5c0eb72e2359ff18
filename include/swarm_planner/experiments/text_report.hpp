// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/experiments/experiment_runs.hpp"
#include "swarm_planner/experiments/run_result.hpp"

namespace swarm_planner {

/// A table for people: a line per run, a line for all of them if there are several, then who collided with what and
/// why UAVs fell back. `runs` and `results` belong together, in the same order.
std::string toTable(const std::vector<ExperimentRun>& runs, const std::vector<RunResult>& results);

}  // namespace swarm_planner
