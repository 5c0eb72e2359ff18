// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/experiments/experiment_runs.hpp"
#include "swarm_planner/experiments/run_result.hpp"

namespace swarm_planner {

/// Problem 1 over Problem 2 in the same scenario with the same seed.
struct Comparison {
  double cycle_time = 0.0;  ///< ratio of the medians
  double cost = 0.0;        ///< of the flights, eq. (17) closed loop
  double kkt_nonzeros = 0.0;
};
Comparison compare(const RunResult& iterative, const RunResult& joint);

/// A table for people: both problems of every scenario and seed side by side. `runs` and `results` as compare flies
/// them: of each scenario and seed first Problem 2, then Problem 1.
std::string comparisonTable(const std::vector<ExperimentRun>& runs, const std::vector<RunResult>& results);

}  // namespace swarm_planner
