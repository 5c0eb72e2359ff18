// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/experiment_runs.hpp"

#include <algorithm>
#include <stdexcept>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/config/rehearsal.hpp"
#include "swarm_planner/config/tight_scenarios.hpp"

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
  if (options.as_paper) given["as_paper"] = true;
  return given;
}

void requireMode(PlanningMode mode, const std::string& source, const Mission& mission) {
  const std::optional<std::string> fault =
      planningModeFault(mode, mission.scenario.uavs.size(), mission.parameters.limits.as_paper);
  if (fault) throw ConfigError(source + ": " + *fault);
}

/// The runs of one scenario: for each seed one, or one by each problem.
void addRuns(const Mission& mission, const std::string& source, const ExperimentOptions& options,
             std::vector<ExperimentRun>& runs) {
  std::vector<std::uint64_t> seeds = options.seeds;
  if (seeds.empty()) seeds = {static_cast<std::uint64_t>(mission.parameters.simulation.seed)};
  std::vector<PlanningMode> modes = {options.mode};
  if (options.command == ExperimentCommand::kCompare) modes = {PlanningMode::kIterative, PlanningMode::kJoint};
  for (const PlanningMode mode : modes) {
    requireMode(mode, source, mission);
  }
  for (const std::uint64_t seed : seeds) {
    for (const PlanningMode mode : modes) runs.push_back({mission, seed, options.shortest_paths, mode, {}});
  }
}

/// Of fly and compare.
std::vector<ExperimentRun> scenarioRuns(const ExperimentOptions& options, const ParameterMap& given) {
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
  return {makeMission(scenario, given, scenario.name), seed, false, PlanningMode::kIterative, {}};
}

/// 10 m, and from 20 UAVs on as much as leaves them 3 m of it each.
double circleRadius(int uavs) { return std::max(10.0, 0.5 * uavs); }

/// The scenario of a command that makes one from a seed.
Scenario generated(const ExperimentOptions& options, int uavs, std::uint64_t seed) {
  const double perturbation = options.perturbation.value_or(kPerturbation);
  switch (options.command) {
    case ExperimentCommand::kMonteCarlo:
      return paperMonteCarlo(uavs, seed);
    case ExperimentCommand::kScaling:
      return paperScaling(uavs);
    case ExperimentCommand::kCircleSwap:
      return circleSwap(uavs, options.radius.value_or(circleRadius(uavs)), seed, perturbation);
    case ExperimentCommand::kForest:
      return forest(uavs, options.gap.value_or(kForestGap), seed);
    case ExperimentCommand::kSmallForest:
      return smallForest(uavs, seed);
    case ExperimentCommand::kGap:
      return gap(uavs, perturbation, seed);
    case ExperimentCommand::kBoxHeadOn:
      return boxHeadOn(uavs, perturbation, seed);
    case ExperimentCommand::kUTrap:
      return uTrap(uavs, perturbation, seed);
    case ExperimentCommand::kSameGoal:
      return sameGoal(uavs, perturbation, seed);
    case ExperimentCommand::kDens:
      return denseRoom(uavs, seed);
    case ExperimentCommand::kSwapj:
      return swapInRoom(uavs, seed);
    case ExperimentCommand::kMovingObstacles:
      return movingObstacles(uavs, options.obstacles, seed);
    case ExperimentCommand::kHelp:
    case ExperimentCommand::kFly:
    case ExperimentCommand::kCompare:
    case ExperimentCommand::kRehearse:
      break;
  }
  throw std::logic_error("this command makes no scenario from a seed");
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
  if (options.command == ExperimentCommand::kHelp) return runs;
  if (options.command == ExperimentCommand::kCompare && options.scenario_files.empty()) {
    addRuns(makeMission(paperSix(), given, "paper_six"), "paper_six", options, runs);
    return runs;
  }
  if (options.command == ExperimentCommand::kFly || options.command == ExperimentCommand::kCompare) {
    return scenarioRuns(options, given);
  }
  for (const int uavs : options.uavs) {
    for (const std::uint64_t seed : options.seeds) {
      constexpr double kHour = 3600.0;  // [s]
      runs.push_back(options.command == ExperimentCommand::kRehearse
                         ? rehearsalRun(uavs, kHour * options.hours, seed, given)
                         : generatedRun(generated(options, uavs, seed), seed, given));
      runs.back().shortest_paths = options.shortest_paths;
      runs.back().mode = options.mode;
      requireMode(options.mode, runs.back().mission.scenario.name, runs.back().mission);
    }
  }
  return runs;
}

}  // namespace swarm_planner
