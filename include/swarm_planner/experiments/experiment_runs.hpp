// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "swarm_planner/experiments/experiment_options.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// One run of an experiment, ready to be flown.
struct ExperimentRun {
  Mission mission;
  std::uint64_t seed = 0;
  bool shortest_paths = false;  ///< flown paths are to be measured against them
  PlanningMode mode = PlanningMode::kIterative;
  std::optional<Workspace> goals;  ///< a rehearsal: where UAVs get random goals, one after the other
};

/// A rehearsal(uavs, duration, seed). Tracks are remembered for kRehearsalTrackTimeout unless `given` sets
/// track_timeout.
ExperimentRun rehearsalRun(int uavs, double duration, std::uint64_t seed, ParameterMap given = {});

/// The runs that a command asks for, in the order in which they are reported. Throws ConfigError with the faults of all
/// scenario and parameter files together.
std::vector<ExperimentRun> makeExperimentRuns(const ExperimentOptions& options);

}  // namespace swarm_planner
