// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/experiment_options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <map>
#include <numeric>
#include <sstream>

#include "swarm_planner/config/parameter_io.hpp"
#include "swarm_planner/experiments/negative_controls.hpp"

namespace swarm_planner {
namespace {

constexpr int kMostUavs = 100000;
constexpr int kMostObstacles = 10000;
constexpr int kMostThreads = 256;
constexpr double kMostHours = 1000.0;
constexpr std::uint64_t kMostScenarios = 1000000;
constexpr std::uint64_t kLargestSeed = 2147483647;  // that of the parameter "seed", so that a run can be repeated there

bool isOption(const std::string& argument) { return argument.rfind("--", 0) == 0; }

std::uint64_t wholeNumber(const std::string& option, const std::string& text, std::uint64_t least, std::uint64_t most) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (text.empty() || error != std::errc() || stop != end || number < least || number > most) {
    throw OptionError(option + ": expected a whole number from " + std::to_string(least) + " to " +
                      std::to_string(most) + ", not \"" + text + "\"");
  }
  return number;
}

/// NaN if `text` is no finite number.
double numberFrom(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  const bool read = static_cast<bool>(stream >> number) && stream.peek() == std::istringstream::traits_type::eof();
  return read && std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN();
}

double positiveNumber(const std::string& option, const std::string& text) {
  const double number = numberFrom(text);
  if (!(number > 0.0)) throw OptionError(option + ": expected a number > 0, not \"" + text + "\"");
  return number;
}

double numberFromZero(const std::string& option, const std::string& text) {
  const double number = numberFrom(text);
  if (!(number >= 0.0)) throw OptionError(option + ": expected a number >= 0, not \"" + text + "\"");
  return number;
}

/// A value that `parameter` takes.
double parameterValue(const std::string& option, const std::string& text, const std::string& parameter) {
  const double number = numberFrom(text);
  if (const std::optional<std::string> expected = expectedInstead(parameter, number)) {
    throw OptionError(option + ": expected " + *expected + ", not \"" + text + "\"");
  }
  return number;
}

std::vector<std::uint64_t> seedsFrom(std::uint64_t first, std::uint64_t count) {
  std::vector<std::uint64_t> seeds(count);
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

std::vector<std::uint64_t> seedRange(const std::string& option, const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw OptionError(option + ": expected A:B, not \"" + text + "\"");
  const std::uint64_t first = wholeNumber(option, text.substr(0, colon), 0, kLargestSeed);
  const std::uint64_t last = wholeNumber(option, text.substr(colon + 1), first, kLargestSeed);
  if (last - first >= kMostScenarios) throw OptionError(option + ": more than a million seeds");
  return seedsFrom(first, last - first + 1);
}

struct CommandInfo {
  ExperimentCommand command;
  std::vector<int> uavs;  ///< unless --uavs says otherwise; empty: the scenario files say
};

const std::map<std::string, CommandInfo> kCommands = {
    {"fly", {ExperimentCommand::kFly, {}}},
    {"compare", {ExperimentCommand::kCompare, {}}},
    {"monte_carlo", {ExperimentCommand::kMonteCarlo, {6}}},
    {"scaling", {ExperimentCommand::kScaling, {6, 16, 32, 64}}},
    {"circle_swap", {ExperimentCommand::kCircleSwap, {10}}},
    {"forest", {ExperimentCommand::kForest, {10}}},
    {"small_forest", {ExperimentCommand::kSmallForest, {20}}},
    {"gap", {ExperimentCommand::kGap, {8}}},
    {"box_head_on", {ExperimentCommand::kBoxHeadOn, {4}}},
    {"u_trap", {ExperimentCommand::kUTrap, {3}}},
    {"same_goal", {ExperimentCommand::kSameGoal, {6}}},
    {"dens", {ExperimentCommand::kDens, {16}}},
    {"swapj", {ExperimentCommand::kSwapj, {16}}},
    {"moving_obstacles", {ExperimentCommand::kMovingObstacles, {6}}},
    {"rehearse", {ExperimentCommand::kRehearse, {6}}},
};

/// Options that set parameters of the simulation, whose ranges hold.
const std::map<std::string, std::vector<const char*>> kDisturbances = {
    {"--noise", {"position_noise", "velocity_noise"}},
    {"--bias", {"position_bias"}},
    {"--wind", {"wind"}},
    {"--latency", {"latency"}},
    {"--jitter", {"jitter"}},
    {"--drop", {"drop"}},
};

/// Walks through the arguments; what an option needs is taken from behind it.
class Parser {
 public:
  explicit Parser(const std::vector<std::string>& arguments) : arguments_(splitEquals(arguments)) {}

  ExperimentOptions parse();

 private:
  /// "--key=value" as "--key" "value".
  static std::vector<std::string> splitEquals(const std::vector<std::string>& arguments);
  bool takesScenarios() const {
    return options_.command == ExperimentCommand::kFly || options_.command == ExperimentCommand::kCompare;
  }
  bool atEnd() const { return next_ == arguments_.size(); }
  std::string value(const std::string& option);
  std::vector<std::string> values(const std::string& option);
  void requireCommand(const std::string& option, std::initializer_list<ExperimentCommand> commands) const;
  void readOption(const std::string& option);
  void readStudyOption(const std::string& option);
  void leaveOut(const std::string& names);
  void check();

  std::vector<std::string> arguments_;
  std::size_t next_ = 0;
  std::vector<std::string> seen_;
  std::vector<int> default_uavs_;
  std::uint64_t scenarios_ = 100;
  ExperimentOptions options_;
};

ExperimentOptions Parser::parse() {
  if (std::find(arguments_.begin(), arguments_.end(), "--help") != arguments_.end()) return options_;
  if (atEnd()) throw OptionError("no command given");
  const std::string command = arguments_[next_++];
  const auto found = kCommands.find(command);
  if (found == kCommands.end()) throw OptionError("unknown command \"" + command + "\"");
  options_.command = found->second.command;
  default_uavs_ = found->second.uavs;
  while (!atEnd()) {
    const std::string argument = arguments_[next_++];
    if (isOption(argument)) {
      const bool again = std::find(seen_.begin(), seen_.end(), argument) != seen_.end();
      if (again && argument != "--without") throw OptionError(argument + ": given twice");
      seen_.push_back(argument);
      readOption(argument);
    } else if (takesScenarios()) {
      options_.scenario_files.push_back(argument);
    } else {
      throw OptionError("unexpected argument \"" + argument + "\"");
    }
  }
  check();
  return options_;
}

std::vector<std::string> Parser::splitEquals(const std::vector<std::string>& arguments) {
  std::vector<std::string> split;
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.find('=');
    if (isOption(argument) && equals != std::string::npos) {
      split.push_back(argument.substr(0, equals));
      split.push_back(argument.substr(equals + 1));
    } else {
      split.push_back(argument);
    }
  }
  return split;
}

std::string Parser::value(const std::string& option) {
  if (atEnd() || isOption(arguments_[next_])) throw OptionError(option + ": a value is missing");
  return arguments_[next_++];
}

std::vector<std::string> Parser::values(const std::string& option) {
  std::vector<std::string> list = {value(option)};
  while (!atEnd() && !isOption(arguments_[next_])) list.push_back(arguments_[next_++]);
  return list;
}

void Parser::requireCommand(const std::string& option, std::initializer_list<ExperimentCommand> commands) const {
  if (std::find(commands.begin(), commands.end(), options_.command) == commands.end()) {
    throw OptionError(option + ": does not go with this command");
  }
}

void Parser::readOption(const std::string& option) {
  if (option == "--json") {
    options_.json_file = value(option);
  } else if (option == "--csv") {
    options_.csv_directory = value(option);
  } else if (option == "--params") {
    options_.parameter_file = value(option);
  } else if (option == "--seed") {
    options_.seeds = {wholeNumber(option, value(option), 0, kLargestSeed)};
  } else if (option == "--seeds") {
    options_.seeds = seedRange(option, value(option));
  } else if (option == "--threads") {
    options_.threads = static_cast<int>(wholeNumber(option, value(option), 1, kMostThreads));
  } else if (option == "--shortest-paths") {
    options_.shortest_paths = true;
  } else if (option == "--as-paper") {
    options_.as_paper = true;
  } else if (option == "--without") {
    leaveOut(value(option));
  } else if (const auto disturbance = kDisturbances.find(option); disturbance != kDisturbances.end()) {
    const std::string text = value(option);
    for (const char* parameter : disturbance->second) {
      options_.disturbances[parameter] = parameterValue(option, text, parameter);
    }
  } else {
    readStudyOption(option);
  }
}

/// "check,segments"
void Parser::leaveOut(const std::string& names) {
  std::istringstream list(names + ",");
  for (std::string name; std::getline(list, name, ',');) {
    std::string known;
    bool found = false;
    for (const NegativeControl& control : kNegativeControls) {
      known += (known.empty() ? "" : ", ") + std::string(control.name);
      if (name != control.name) continue;
      options_.left_out.insert(control.parameter);
      found = true;
    }
    if (!found) throw OptionError("--without: expected some of " + known + ", not \"" + name + "\"");
  }
}

void Parser::readStudyOption(const std::string& option) {
  if (option == "--joint" || option == "--groups") {
    if (options_.command == ExperimentCommand::kCompare) throw OptionError(option + ": does not go with this command");
    options_.mode = option == "--joint" ? PlanningMode::kJoint : PlanningMode::kGroups;
  } else if (option == "--uavs") {
    if (default_uavs_.empty()) throw OptionError(option + ": does not go with this command");
    for (const std::string& count : values(option)) {
      options_.uavs.push_back(static_cast<int>(wholeNumber(option, count, 1, kMostUavs)));
    }
  } else if (option == "--scenarios") {
    requireCommand(option, {ExperimentCommand::kMonteCarlo});
    scenarios_ = wholeNumber(option, value(option), 1, kMostScenarios);
  } else if (option == "--radius") {
    requireCommand(option, {ExperimentCommand::kCircleSwap});
    options_.radius = positiveNumber(option, value(option));
  } else if (option == "--perturbation") {
    requireCommand(option, {ExperimentCommand::kCircleSwap, ExperimentCommand::kGap, ExperimentCommand::kBoxHeadOn,
                            ExperimentCommand::kUTrap, ExperimentCommand::kSameGoal});
    options_.perturbation = numberFromZero(option, value(option));
  } else if (option == "--gap") {
    requireCommand(option, {ExperimentCommand::kForest});
    options_.gap = numberFromZero(option, value(option));
  } else if (option == "--hours") {
    requireCommand(option, {ExperimentCommand::kRehearse});
    options_.hours = positiveNumber(option, value(option));
    if (options_.hours > kMostHours) throw OptionError(option + ": more than a thousand hours");
  } else if (option == "--obstacles") {
    requireCommand(option, {ExperimentCommand::kMovingObstacles});
    options_.obstacles = static_cast<int>(wholeNumber(option, value(option), 1, kMostObstacles));
  } else {
    throw OptionError("unknown option " + option);
  }
}

/// What can be told only once all arguments are known; sets the defaults.
void Parser::check() {
  const auto given = [this](const char* option) {
    return std::find(seen_.begin(), seen_.end(), option) != seen_.end();
  };
  const bool iterative = options_.mode == PlanningMode::kIterative && options_.command != ExperimentCommand::kCompare;
  if (options_.as_paper && !iterative) throw OptionError("--as-paper: does not go with Problem 1");
  if (given("--seed") && given("--seeds")) throw OptionError("--seed and --seeds: give one of them");
  if (given("--joint") && given("--groups")) throw OptionError("--joint and --groups: give one of them");
  if (given("--scenarios") && given("--seeds")) throw OptionError("--scenarios and --seeds: give one of them");
  if (options_.command == ExperimentCommand::kFly) {
    if (options_.scenario_files.empty()) throw OptionError("fly: no scenario file given");
    return;
  }
  if (options_.command == ExperimentCommand::kCompare && !options_.scenario_files.empty()) return;
  if (options_.seeds.empty()) options_.seeds = {0};
  if (options_.uavs.empty()) options_.uavs = default_uavs_;
  if (options_.command == ExperimentCommand::kScaling) return;
  const bool monte_carlo = options_.command == ExperimentCommand::kMonteCarlo;
  if (monte_carlo && !given("--seeds")) options_.seeds = seedsFrom(options_.seeds.front(), scenarios_);
  if (options_.uavs.size() > 1) throw OptionError("--uavs: one number is expected here");
}

}  // namespace

ExperimentOptions parseExperimentOptions(const std::vector<std::string>& arguments) {
  return Parser(arguments).parse();
}

std::string experimentUsage() {
  return R"(usage: swarm_experiment COMMAND [options]

Flies the swarm closed loop, planner and simulated vehicles, without ROS, and measures it.

commands:
  fly SCENARIO.yaml [SCENARIO.yaml ...]   the given scenario files
  compare [SCENARIO.yaml ...]             Problem 1, all UAVs at once, against Problem 2, one after the other;
                                          without a file: section 4 of the paper
  monte_carlo [--scenarios 100] [--uavs 6]
                                          random obstacles as in section 4.1 of the paper
  scaling [--uavs 6 16 32 64]             growing swarms as in section 4.2 of the paper
  circle_swap [--uavs 10] [--radius 10]   UAVs on a circle [m] change places with their opposites; beyond 20 UAVs its
                                          radius is half a metre for each if not given
  forest [--uavs 10] [--gap 0.8]          the same across 44 m of cylinders that leave such gaps [m] at least; 0: any
  small_forest [--uavs 20]                the same on a circle of 4 m radius with ten cylinders
  gap [--uavs 8]                          through one opening that has room for one
  box_head_on [--uavs 4]                  each meets the middle of the face of a box
  u_trap [--uavs 3]                       references lead into a dead end
  same_goal [--uavs 6]                    all are sent to one point
  dens [--uavs 16]                        from random places to others in a room full of columns
  swapj [--uavs 16]                       across a room to the opposite side
  moving_obstacles [--uavs 6] [--obstacles 8]
                                          UAVs cross a field among random moving obstacles
  rehearse [--hours 1] [--uavs 6]         one mission after the other, with random faults of every kind

options:
  --json FILE          write the results as JSON
  --csv DIR            write states.csv, obstacles.csv, cycles.csv and solves.csv
  --seed S             seed of disturbances and of random scenarios (monte_carlo: of the first one)
  --seeds A:B          a run for each seed from A to B
  --perturbation P     circle_swap, gap, box_head_on, u_trap, same_goal: seeds other than 0 move starts and goals by
                       up to P [m] along each axis, 0.1 if not given
  --shortest-paths     compare the flown paths with the shortest ones around standing obstacles; takes seconds for each
                       UAV that has to go round some
  --without WHAT       negative control: leave out (several: with commas, or the option again)
                         check      plans fly unchecked
                         segments   constraints hold at the samples alone, not between them
                         latency    measurements count as of the present, and plans start from them
                         guide      no ways round what blocks references are searched
                         avoidance  plans ignore obstacles and other UAVs
                         right_of_way  no UAV gives way where several block each other
  --as-paper           the paper's method alone: the acceleration is held between the samples, constraints hold at the
                       samples, and there is neither check nor guide nor right of way; planning takes no time
  --joint              plan by Problem 1, all UAVs at once, at most 8
  --groups             plan at once for groups of up to 8 UAVs that interact strongly
  --params FILE        parameters, as in config/planner.yaml; those that a scenario sets come first
  --threads T          threads of the planner; the flight does not depend on it
  --help               this text

disturbances, none by default:
  --noise SIGMA        odometry: standard deviation of each coordinate [m] and [m/s]
  --bias B             odometry: constant error of each UAV's position, of length B [m] in a random direction
  --wind W             gusts: standard deviation of the wind on each axis [m/s], 0 to 30
  --latency S          every message (odometry, obstacle tracks, setpoints) is S later [s], 0 to 10
  --jitter S           and by a random time from 0 to S more [s], 0 to 10; messages may overtake each other
  --drop P             every message is lost with this probability, 0 to 1

Exit status: 0 flown, 1 faults in a file or results that cannot be written, 2 wrong command line.
doc/experiments.md explains every field of the results.
)";
}

}  // namespace swarm_planner
