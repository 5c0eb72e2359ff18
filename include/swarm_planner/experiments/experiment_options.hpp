// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "swarm_planner/swarm/planning_mode.hpp"

namespace swarm_planner {

/// The command line cannot be used; what() says what is wrong and what was expected.
class OptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class ExperimentCommand {
  kHelp,
  kFly,
  kCompare,
  kMonteCarlo,
  kScaling,
  kCircleSwap,
  kForest,
  kSmallForest,
  kGap,
  kBoxHeadOn,
  kUTrap,
  kSameGoal,
  kDens,
  kSwapj,
  kMovingObstacles,
  kRehearse
};

/// What swarm_experiment is asked to do.
struct ExperimentOptions {
  ExperimentCommand command = ExperimentCommand::kHelp;
  std::vector<std::string> scenario_files;  ///< fly, compare; of compare empty for paperSix()
  std::vector<int> uavs;                    ///< the others; scaling: several
  std::optional<double> radius;             ///< circle_swap [m]
  std::optional<double> perturbation;       ///< circle_swap, gap, box_head_on, u_trap, same_goal [m]
  std::optional<double> gap;                ///< forest [m]
  int obstacles = 8;                        ///< moving_obstacles
  double hours = 1.0;                       ///< rehearse: simulated time

  /// A run for each: --seeds A:B (both ends included), --seed S, or 0; monte_carlo: as many from S on as scenarios.
  /// Empty only for fly without either: then the parameter "seed" holds.
  std::vector<std::uint64_t> seeds;
  /// Parameters of the simulation that --noise, --bias, --wind, --latency, --jitter and --drop set.
  std::map<std::string, double> disturbances;
  bool shortest_paths = false;                   ///< flown paths are measured against them
  PlanningMode mode = PlanningMode::kIterative;  ///< fly --joint: Problem 1
  std::optional<int> threads;                    ///< of the planner
  /// Parameters that are to be false, those of negative_controls.hpp.
  std::set<std::string> left_out;
  bool as_paper = false;  ///< the paper's method alone
  std::optional<std::string> parameter_file;
  std::optional<std::string> json_file;
  std::optional<std::string> csv_directory;
};

/// Reads the arguments after the program's name. Throws OptionError at the first that cannot be used.
ExperimentOptions parseExperimentOptions(const std::vector<std::string>& arguments);

/// The text of --help.
std::string experimentUsage();

}  // namespace swarm_planner
