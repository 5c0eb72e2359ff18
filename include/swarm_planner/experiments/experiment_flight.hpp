// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/experiments/experiment_runs.hpp"

namespace swarm_planner {

/// Flies a run with the planner of its mode. If faults are injected, what became of them is in the result; in a
/// rehearsal UAVs get new goals all the time. `observers` are told in the order given.
RunResult flyExperimentRun(const ExperimentRun& run, std::vector<RunObserver*> observers = {});

}  // namespace swarm_planner
