// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a mistyped command line flies something else than was meant, for hours.
#include <gtest/gtest.h>

#include <map>

#include "swarm_planner/experiments/experiment_options.hpp"

namespace swarm_planner {
namespace {

using Arguments = std::vector<std::string>;

TEST(ExperimentOptions, ReadsWhatIsGiven) {
  const ExperimentOptions options = parseExperimentOptions(
      {"fly",  "a.yaml",    "--seeds",   "3:5",      "b.yaml", "--json=out.json", "--csv", "dir",        "--noise",
       "0.02", "--latency", "0.1",       "--jitter", "0.05",   "--drop",          "0.2",   "--bias=0.3", "--wind",
       "4",    "--without", "avoidance", "--params", "p.yaml", "--threads",       "2"});
  EXPECT_EQ(options.command, ExperimentCommand::kFly);
  EXPECT_EQ(options.scenario_files, (Arguments{"a.yaml", "b.yaml"}));
  EXPECT_EQ(options.seeds, (std::vector<std::uint64_t>{3, 4, 5}));
  EXPECT_EQ(options.json_file, "out.json");
  EXPECT_EQ(options.csv_directory, "dir");
  EXPECT_EQ(options.parameter_file, "p.yaml");
  EXPECT_EQ(options.disturbances, (std::map<std::string, double>{{"position_noise", 0.02},
                                                                 {"velocity_noise", 0.02},
                                                                 {"position_bias", 0.3},
                                                                 {"wind", 4.0},
                                                                 {"latency", 0.1},
                                                                 {"jitter", 0.05},
                                                                 {"drop", 0.2}}));
  EXPECT_EQ(options.threads, 2);
  EXPECT_EQ(options.left_out, std::set<std::string>{"avoidance"});
}

TEST(ExperimentOptions, HasTheStudiesOfThePaperAsDefaults) {
  const ExperimentOptions monte_carlo = parseExperimentOptions({"monte_carlo"});
  EXPECT_EQ(monte_carlo.uavs, std::vector<int>{6});
  EXPECT_EQ(monte_carlo.seeds.size(), 100u);
  EXPECT_EQ(monte_carlo.seeds.back(), 99u);
  const ExperimentOptions part = parseExperimentOptions({"monte_carlo", "--scenarios", "4", "--seed", "10"});
  EXPECT_EQ(part.seeds, (std::vector<std::uint64_t>{10, 11, 12, 13}));
  EXPECT_EQ(parseExperimentOptions({"monte_carlo", "--seeds", "7:7"}).seeds, std::vector<std::uint64_t>{7});
  EXPECT_EQ(parseExperimentOptions({"scaling"}).uavs, (std::vector<int>{6, 16, 32, 64}));
  EXPECT_EQ(parseExperimentOptions({"scaling", "--uavs", "6", "128"}).uavs, (std::vector<int>{6, 128}));
  const ExperimentOptions swap = parseExperimentOptions({"circle_swap", "--radius", "4.5"});
  EXPECT_EQ(swap.uavs, std::vector<int>{10});
  EXPECT_EQ(swap.radius, 4.5);
  EXPECT_EQ(swap.seeds, std::vector<std::uint64_t>{0});
  EXPECT_TRUE(parseExperimentOptions({"fly", "a.yaml"}).seeds.empty());
  EXPECT_EQ(parseExperimentOptions({"scaling", "--help"}).command, ExperimentCommand::kHelp);
}

TEST(ExperimentOptions, LeavesOutWhatIsNamedWithCommasOrInTurn) {
  const std::set<std::string> expected = {"plan_check", "segment_constraints", "latency_compensation"};
  EXPECT_EQ(parseExperimentOptions({"circle_swap", "--without", "check,segments,latency"}).left_out, expected);
  EXPECT_EQ(
      parseExperimentOptions({"circle_swap", "--without=check", "--without", "latency,segments", "--without", "check"})
          .left_out,
      expected);
  EXPECT_TRUE(parseExperimentOptions({"circle_swap"}).left_out.empty());
}

TEST(ExperimentOptions, FliesThePapersMethodWhereAsked) {
  EXPECT_TRUE(parseExperimentOptions({"monte_carlo", "--as-paper"}).as_paper);
  EXPECT_FALSE(parseExperimentOptions({"monte_carlo"}).as_paper);
}

TEST(ExperimentOptions, FliesSixUavsAmongEightMovingObstacles) {
  const ExperimentOptions options = parseExperimentOptions({"moving_obstacles"});
  EXPECT_EQ(options.command, ExperimentCommand::kMovingObstacles);
  EXPECT_EQ(options.uavs, std::vector<int>{6});
  EXPECT_EQ(options.obstacles, 8);
  EXPECT_EQ(options.seeds, std::vector<std::uint64_t>{0});
  const ExperimentOptions more =
      parseExperimentOptions({"moving_obstacles", "--uavs", "3", "--obstacles", "20", "--seeds", "1:2"});
  EXPECT_EQ(more.uavs, std::vector<int>{3});
  EXPECT_EQ(more.obstacles, 20);
  EXPECT_EQ(more.seeds.size(), 2u);
}

TEST(ExperimentOptions, KnowsTheTightPlacesAndTheirUavs) {
  const std::map<std::string, std::pair<ExperimentCommand, int>> expected = {
      {"forest", {ExperimentCommand::kForest, 10}}, {"small_forest", {ExperimentCommand::kSmallForest, 20}},
      {"gap", {ExperimentCommand::kGap, 8}},        {"box_head_on", {ExperimentCommand::kBoxHeadOn, 4}},
      {"u_trap", {ExperimentCommand::kUTrap, 3}},   {"same_goal", {ExperimentCommand::kSameGoal, 6}},
      {"dens", {ExperimentCommand::kDens, 16}},     {"swapj", {ExperimentCommand::kSwapj, 16}}};
  for (const auto& [name, what] : expected) {
    const ExperimentOptions options = parseExperimentOptions({name});
    EXPECT_EQ(options.command, what.first) << name;
    EXPECT_EQ(options.uavs, std::vector<int>{what.second}) << name;
    EXPECT_EQ(options.seeds, std::vector<std::uint64_t>{0}) << name;
    EXPECT_FALSE(options.shortest_paths);
    EXPECT_EQ(parseExperimentOptions({name, "--uavs", "3"}).uavs, std::vector<int>{3}) << name;
  }
  const ExperimentOptions options =
      parseExperimentOptions({"gap", "--perturbation", "0", "--shortest-paths", "--seeds", "1:3"});
  EXPECT_EQ(options.perturbation, 0.0);
  EXPECT_TRUE(options.shortest_paths);
  EXPECT_EQ(parseExperimentOptions({"forest", "--gap", "1.5"}).gap, 1.5);
  EXPECT_FALSE(parseExperimentOptions({"forest"}).gap);
  EXPECT_FALSE(parseExperimentOptions({"circle_swap"}).radius);
}

TEST(ExperimentOptions, RehearsesAnHourWithSixUavs) {
  const ExperimentOptions options = parseExperimentOptions({"rehearse"});
  EXPECT_EQ(options.command, ExperimentCommand::kRehearse);
  EXPECT_EQ(options.hours, 1.0);
  EXPECT_EQ(options.uavs, std::vector<int>{6});
  EXPECT_EQ(options.seeds, std::vector<std::uint64_t>{0});
  EXPECT_EQ(parseExperimentOptions({"rehearse", "--hours", "0.25", "--uavs", "9"}).hours, 0.25);
}

struct Mistake {
  Arguments arguments;
  std::string expected;  ///< part of the message
};

TEST(ExperimentOptions, RefusesEveryMistakeAndSaysWhy) {
  const std::vector<Mistake> mistakes = {
      {{}, "no command"},
      {{"flye"}, "unknown command \"flye\""},
      {{"fly"}, "no scenario file"},
      {{"fly", "a.yaml", "--jsn", "x"}, "unknown option --jsn"},
      {{"fly", "a.yaml", "--json"}, "--json: a value is missing"},
      {{"fly", "a.yaml", "--json", "--csv", "dir"}, "--json: a value is missing"},
      {{"fly", "a.yaml", "--seed", "1", "--seed", "2"}, "given twice"},
      {{"fly", "a.yaml", "--seed", "-1"}, "--seed: expected a whole number"},
      {{"fly", "a.yaml", "--seed", "1.5"}, "--seed: expected a whole number"},
      {{"fly", "a.yaml", "--seed", "99999999999999999999999"}, "--seed: expected a whole number"},
      {{"fly", "a.yaml", "--seeds", "3"}, "expected A:B"},
      {{"fly", "a.yaml", "--seeds", "5:3"}, "--seeds: expected a whole number from 5"},
      {{"fly", "a.yaml", "--seeds", ":3"}, "--seeds: expected a whole number"},
      {{"fly", "a.yaml", "--seeds", "0:2000000"}, "more than a million"},
      {{"fly", "a.yaml", "--seed", "1", "--seeds", "1:2"}, "one of them"},
      {{"fly", "a.yaml", "--noise", "-0.1"}, "--noise: expected a number >= 0"},
      {{"fly", "a.yaml", "--noise", "nan"}, "--noise: expected a number >= 0"},
      {{"fly", "a.yaml", "--noise", "inf"}, "--noise: expected a number >= 0"},
      {{"fly", "a.yaml", "--noise", "0.1x"}, "--noise: expected a number >= 0"},
      {{"fly", "a.yaml", "--noise="}, "--noise: expected a number >= 0"},
      {{"fly", "a.yaml", "--threads", "0"}, "--threads: expected a whole number from 1"},
      {{"fly", "a.yaml", "--without", "guid"},
       "expected some of check, segments, latency, guide, avoidance, right_of_way, not \"guid\""},
      {{"fly", "a.yaml", "--without", "check,,latency"}, "not \"\""},
      {{"fly", "a.yaml", "--without", "check,"}, "not \"\""},
      {{"fly", "a.yaml", "--without"}, "--without: a value is missing"},
      {{"circle_swap", "--obstacles", "8"}, "does not go with this command"},
      {{"monte_carlo", "--obstacles", "8"}, "does not go with this command"},
      {{"moving_obstacles", "--obstacles", "0"}, "--obstacles: expected a whole number from 1"},
      {{"moving_obstacles", "--radius", "5"}, "does not go with this command"},
      {{"moving_obstacles", "--scenarios", "5"}, "does not go with this command"},
      {{"moving_obstacles", "--uavs", "6", "7"}, "one number"},
      {{"fly", "a.yaml", "--uavs", "6"}, "does not go with this command"},
      {{"rehearse", "--hours", "0"}, "--hours: expected a number > 0"},
      {{"rehearse", "--hours", "1e6"}, "more than a thousand hours"},
      {{"rehearse", "--uavs", "6", "7"}, "one number"},
      {{"circle_swap", "--hours", "1"}, "does not go with this command"},
      {{"compare", "a.yaml", "--joint"}, "--joint: does not go with this command"},
      {{"fly", "a.yaml", "--latency", "-0.1"}, "--latency: expected a number in [0, 10] [s], not \"-0.1\""},
      {{"fly", "a.yaml", "--latency", "100"}, "--latency: expected a number in [0, 10] [s], not \"100\""},
      {{"fly", "a.yaml", "--latency", "0.1s"}, "--latency: expected a number in [0, 10] [s], not \"0.1s\""},
      {{"fly", "a.yaml", "--latency"}, "--latency: a value is missing"},
      {{"fly", "a.yaml", "--jitter", "nan"}, "--jitter: expected a number in [0, 10] [s], not \"nan\""},
      {{"fly", "a.yaml", "--drop", "20"}, "--drop: expected a number in [0, 1], not \"20\""},
      {{"fly", "a.yaml", "--drop", "-0.2"}, "--drop: expected a number in [0, 1], not \"-0.2\""},
      {{"fly", "a.yaml", "--bias", "-1"}, "--bias: expected a number >= 0 [m], not \"-1\""},
      {{"monte_carlo", "--wind", "31"}, "--wind: expected a number in [0, 30] [m/s], not \"31\""},
      {{"scaling", "--wind", "strong"}, "--wind: expected a number in [0, 30] [m/s], not \"strong\""},
      {{"circle_swap", "--drop", "0.1", "--drop", "0.2"}, "--drop: given twice"},
      {{"monte_carlo", "--scenarios", "0"}, "--scenarios: expected a whole number from 1"},
      {{"monte_carlo", "--scenarios", "5", "--seeds", "1:2"}, "one of them"},
      {{"monte_carlo", "--uavs", "6", "7"}, "one number"},
      {{"monte_carlo", "--radius", "7"}, "does not go with this command"},
      {{"monte_carlo", "stray"}, "unexpected argument \"stray\""},
      {{"scaling", "--uavs"}, "--uavs: a value is missing"},
      {{"scaling", "--uavs", "6", "0"}, "--uavs: expected a whole number from 1"},
      {{"gap", "--uavs", "6", "7"}, "one number"},
      {{"gap", "--gap", "1"}, "does not go with this command"},
      {{"forest", "--gap", "-1"}, "--gap: expected a number >= 0"},
      {{"forest", "--perturbation", "0.1"}, "does not go with this command"},
      {{"u_trap", "--perturbation", "-0.1"}, "--perturbation: expected a number >= 0"},
      {{"u_trap", "--perturbation", "inf"}, "--perturbation: expected a number >= 0"},
      {{"dens", "--radius", "3"}, "does not go with this command"},
      {{"circle_swap", "--radius", "0"}, "--radius: expected a number > 0"},
  };
  for (const Mistake& mistake : mistakes) {
    std::string line;
    for (const std::string& argument : mistake.arguments) line += argument + " ";
    try {
      parseExperimentOptions(mistake.arguments);
      ADD_FAILURE() << "accepted: " << line;
    } catch (const OptionError& error) {
      EXPECT_NE(std::string(error.what()).find(mistake.expected), std::string::npos) << line << ": " << error.what();
    }
  }
}

}  // namespace
}  // namespace swarm_planner
