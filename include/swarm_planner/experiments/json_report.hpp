// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/experiments/experiment_runs.hpp"
#include "swarm_planner/experiments/run_result.hpp"

namespace swarm_planner {

/// The results of `runs` as JSON (INTERFACES "Experiment program"): an array with an object per run, every key present;
/// a minimum without a partner is null. Numbers have 12 significant digits.
std::string toJson(const std::vector<ExperimentRun>& runs, const std::vector<RunResult>& results);

}  // namespace swarm_planner
