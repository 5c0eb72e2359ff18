// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/experiment_runs.hpp"

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/config/rehearsal.hpp"

namespace swarm_planner {
namespace {

/// Parameters that the command line sets, on top of those of its parameter file.
ParameterMap givenParameters(const ExperimentOptions& options) {
  Faults faults;
  ParameterMap given;
  if (options.parameter_file) given = parseParameterFile(*options.parameter_file, false, faults);
  faults.throwIfAny();
  for (const auto& [name, value] : options.disturbances) given[name] = value;
  if (options.threads) given["threads"] = *options.threads;
  for (const std::string& parameter : options.left_out) given[parameter] = false;
  return given;
}

/// The runs of one scenario: for each seed one, or one by each problem.
void addRuns(const Mission& mission, const std::string& source, const ExperimentOptions& options,
             std::vector<ExperimentRun>& runs) {
  std::vector<std::uint64_t> seeds = options.seeds;
  if (seeds.empty()) seeds = {static_cast<std::uint64_t>(mission.parameters.simulation.seed)};
  std::vector<PlanningMode> modes = {options.mode};
  if (options.command == ExperimentCommand::kCompare) modes = {PlanningMode::kIterative, PlanningMode::kJoint};
  for (const PlanningMode mode : modes) {
    const std::optional<std::string> fault = planningModeFault(mode, mission.scenario.uavs.size());
    if (fault) throw ConfigError(source + ": " + *fault);
  }
  for (const std::uint64_t seed : seeds) {
    for (const PlanningMode mode : modes) runs.push_back({mission, seed, mode, {}});
  }
}

std::vector<ExperimentRun> flyRuns(const ExperimentOptions& options, const ParameterMap& given) {
  std::vector<ExperimentRun> runs;
  std::string faults;
  for (const std::string& file : options.scenario_files) {
    try {
      addRuns(loadMission(file, given), file, options, runs);
    } catch (const ConfigError& error) {
      faults += faults.empty() ? "" : "\n";
      faults += error.what();
    }
  }
  if (!faults.empty()) throw ConfigError(faults);
  return runs;
}

/// Scenarios that a generator makes; the command's name stands for the file in faults.
ExperimentRun generatedRun(const Scenario& scenario, std::uint64_t seed, const ParameterMap& given) {
  return {makeMission(scenario, given, scenario.name), seed, PlanningMode::kIterative, {}};
}

}  // namespace

ExperimentRun rehearsalRun(int uavs, double duration, std::uint64_t seed, ParameterMap given) {
  given.emplace("track_timeout", kRehearsalTrackTimeout);
  ExperimentRun run = generatedRun(rehearsal(uavs, duration, seed), seed, given);
  run.goals = rehearsalField(uavs);
  return run;
}

std::vector<ExperimentRun> makeExperimentRuns(const ExperimentOptions& options) {
  const ParameterMap given = givenParameters(options);
  std::vector<ExperimentRun> runs;
  switch (options.command) {
    case ExperimentCommand::kFly:
      return flyRuns(options, given);
    case ExperimentCommand::kCompare:
      if (!options.scenario_files.empty()) return flyRuns(options, given);
      addRuns(makeMission(paperSix(), given, "paper_six"), "paper_six", options, runs);
      break;
    case ExperimentCommand::kMonteCarlo:
      for (const std::uint64_t seed : options.seeds) {
        runs.push_back(generatedRun(paperMonteCarlo(options.uavs.front(), seed), seed, given));
      }
      break;
    case ExperimentCommand::kScaling:
      for (const int uavs : options.uavs) {
        for (const std::uint64_t seed : options.seeds) runs.push_back(generatedRun(paperScaling(uavs), seed, given));
      }
      break;
    case ExperimentCommand::kCircleSwap:
      for (const std::uint64_t seed : options.seeds) {
        runs.push_back(generatedRun(circleSwap(options.uavs.front(), options.radius, seed), seed, given));
      }
      break;
    case ExperimentCommand::kMovingObstacles:
      for (const std::uint64_t seed : options.seeds) {
        runs.push_back(generatedRun(movingObstacles(options.uavs.front(), options.obstacles, seed), seed, given));
      }
      break;
    case ExperimentCommand::kRehearse:
      for (const std::uint64_t seed : options.seeds) {
        constexpr double kHour = 3600.0;  // [s]
        runs.push_back(rehearsalRun(options.uavs.front(), kHour * options.hours, seed, given));
      }
      break;
    case ExperimentCommand::kHelp:
      break;
  }
  return runs;
}

}  // namespace swarm_planner
