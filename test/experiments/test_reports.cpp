// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, scripts that read the results break: a key is missing, a number is cut, a file is half written.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <numeric>
#include <set>

#include "support/temporary_directory.hpp"
#include "swarm_planner/experiments/atomic_file.hpp"
#include "swarm_planner/experiments/json_report.hpp"
#include "swarm_planner/experiments/statistics.hpp"
#include "swarm_planner/experiments/text_report.hpp"

namespace swarm_planner {
namespace {

RunResult someResult() {
  RunResult run;
  run.scenario = "a \"strange\"\n\\name";
  run.seed = 12345678901234ULL;
  run.uavs = 6;
  run.cycles = 313;
  run.cycle_ms = {1.25, 1.0, 3.0, 4.123456789};
  run.kkt_nonzeros = 6189;
  run.flown.min_uav_distance = 2.0 / 3.0;
  run.flown.collisions = {{1.5, 0, false, 1}, {2.5, 1, true, 0}};
  run.flown.final_lag = {-1.0, 2.5};
  run.fallbacks["the solver found no plan"] = 3;
  run.fallbacks["late"] = 1;
  run.flown.cost = 1.0e7 / 3.0;
  return run;
}

/// Whose result it is.
ExperimentRun someRun() {
  ExperimentRun run;
  run.mission.scenario.name = "two";
  run.mission.scenario.uavs.resize(2);
  run.mission.scenario.uavs[0].name = "anna";
  run.mission.scenario.uavs[1].name = "bert";
  run.mission.scenario.obstacles.resize(1);
  run.mission.scenario.obstacles[0].id = 42;
  return run;
}

std::set<std::string> keysOf(const YAML::Node& node) {
  std::set<std::string> keys;
  for (const auto& entry : node) keys.insert(entry.first.as<std::string>());
  return keys;
}

TEST(JsonReport, HasEveryKeyOfTheContractAndTheDisturbances) {
  const YAML::Node json = YAML::Load(toJson({someRun(), someRun()}, {someResult(), RunResult()}));
  ASSERT_TRUE(json.IsSequence());
  ASSERT_EQ(json.size(), 2u);
  const std::set<std::string> keys = {"scenario",
                                      "seed",
                                      "uavs",
                                      "problem",
                                      "mode",
                                      "cycles",
                                      "cycle_ms",
                                      "cycle_cpu_ms",
                                      "cycle_ms_histogram",
                                      "uav_ms_histogram",
                                      "as_paper",
                                      "uav_ms",
                                      "sqp_iterations",
                                      "qp_iterations",
                                      "kkt_nonzeros",
                                      "min_uav_distance_m",
                                      "min_obstacle_clearance_m",
                                      "collisions",
                                      "uav_collisions",
                                      "obstacle_collisions",
                                      "collision_events",
                                      "final_lag_m",
                                      "stuck_uavs",
                                      "mission_time_s",
                                      "path_length_m",
                                      "tracking_error_m",
                                      "arrived_uavs",
                                      "refusals",
                                      "rejected_plans",
                                      "workspace_violations",
                                      "fallbacks",
                                      "deadline_misses",
                                      "cost",
                                      "disturbances",
                                      "without",
                                      "timed_out",
                                      "time_ratio",
                                      "path_ratio",
                                      "mission_time_ratio",
                                      "stuck_with_target_inside_obstacle",
                                      "strayed_uavs",
                                      "strayed_uavs_with_reason",
                                      "flights"};
  const std::set<std::string> distribution = {"mean", "median", "p99", "max"};
  const std::set<std::string> mean_max = {"mean", "max"};
  for (const YAML::Node& run : json) {
    EXPECT_EQ(keysOf(run), keys);
    EXPECT_EQ(keysOf(run["cycle_ms"]), distribution);
    EXPECT_EQ(keysOf(run["uav_ms"]), distribution);
    for (const char* key : {"sqp_iterations", "qp_iterations", "final_lag_m", "tracking_error_m"}) {
      EXPECT_EQ(keysOf(run[key]), mean_max) << key;
    }
  }
}

TEST(JsonReport, GivesTheValuesBack) {
  const YAML::Node run = YAML::Load(toJson({someRun()}, {someResult()}))[0];
  EXPECT_EQ(run["scenario"].as<std::string>(), "a \"strange\"\n\\name");
  EXPECT_EQ(run["seed"].as<std::uint64_t>(), 12345678901234ULL);
  EXPECT_EQ(run["collisions"].as<int>(), 2);
  EXPECT_EQ(run["kkt_nonzeros"].as<int>(), 6189);
  EXPECT_NEAR(run["min_uav_distance_m"].as<double>(), 2.0 / 3.0, 1e-11);
  EXPECT_TRUE(run["min_obstacle_clearance_m"].IsNull());
  EXPECT_EQ(run["cycle_ms"]["max"].as<double>(), 4.123456789);
  EXPECT_EQ(run["final_lag_m"]["mean"].as<double>(), -1.0);
  EXPECT_EQ(run["fallbacks"]["the solver found no plan"].as<int>(), 3);
  EXPECT_EQ(run["fallbacks"]["late"].as<int>(), 1);
  EXPECT_NEAR(run["cost"].as<double>() / (1.0e7 / 3.0), 1.0, 1e-11);
}

TEST(JsonReport, ListsTheCollisionsByKind) {
  RunResult result = someResult();
  result.flown.collisions.push_back({3.25, 0, true, 0});
  const YAML::Node run = YAML::Load(toJson({someRun(), someRun()}, {RunResult(), result}))[1];
  EXPECT_EQ(run["collisions"].as<int>(), 3);
  EXPECT_EQ(run["uav_collisions"].as<int>(), 1);
  EXPECT_EQ(run["obstacle_collisions"].as<int>(), 2);
  const YAML::Node events = run["collision_events"];
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0]["time_s"].as<double>(), 1.5);
  EXPECT_EQ(events[0]["uav"].as<std::string>(), "anna");
  EXPECT_EQ(events[0]["with"].as<std::string>(), "bert");
  EXPECT_EQ(events[2]["time_s"].as<double>(), 3.25);
  EXPECT_EQ(events[2]["uav"].as<std::string>(), "anna");
  EXPECT_EQ(events[2]["with"].as<std::string>(), "obstacle 42");
}

/// Anna arrived, a tenth later than she could and by a path a twentieth longer; Bert waits in vain.
RunResult someFlights() {
  RunResult run;
  run.flown.mission_time = 60.0;
  UavFlight anna, bert;
  anna.arrived = true;
  anna.arrival_time = 11.0;
  anna.path_length = 20.8;
  anna.remaining = 0.2;
  bert.stuck = true;
  bert.lag = 33.0;
  bert.behind_target = 33.0;
  bert.target_inside = true;
  bert.target_inside_ago = 0.0;
  run.flown.flights = {anna, bert};
  run.bounds = {{10.0, 20.0}, {12.0, std::nullopt}};
  return run;
}

TEST(JsonReport, TellsOfEveryFlightAndWhatItIsMeasuredAgainst) {
  const YAML::Node run = YAML::Load(toJson({someRun()}, {someFlights()}))[0];
  EXPECT_NEAR(run["time_ratio"]["max"].as<double>(), 1.1, 1e-9);
  EXPECT_NEAR(run["path_ratio"]["max"].as<double>(), 1.05, 1e-9);
  EXPECT_TRUE(run["mission_time_ratio"].IsNull()) << "not all have arrived";
  EXPECT_EQ(run["stuck_with_target_inside_obstacle"].as<int>(), 1);
  EXPECT_EQ(run["strayed_uavs"].as<int>(), 0);
  EXPECT_EQ(run["strayed_uavs_with_reason"].as<int>(), 1);
  ASSERT_EQ(run["flights"].size(), 2u);
  const YAML::Node anna = run["flights"][0], bert = run["flights"][1];
  EXPECT_EQ(keysOf(anna), (std::set<std::string>{"uav", "arrival_time_s", "least_time_s", "path_length_m",
                                                 "remaining_m", "shortest_path_m", "stuck", "lag_m", "behind_target_m",
                                                 "target_inside_obstacle", "target_inside_obstacle_ago_s"}));
  EXPECT_EQ(anna["uav"].as<std::string>(), "anna");
  EXPECT_EQ(anna["arrival_time_s"].as<double>(), 11.0);
  EXPECT_EQ(anna["shortest_path_m"].as<double>(), 20.0);
  EXPECT_TRUE(anna["target_inside_obstacle_ago_s"].IsNull());
  EXPECT_FALSE(anna["stuck"].as<bool>());
  EXPECT_TRUE(bert["arrival_time_s"].IsNull());
  EXPECT_TRUE(bert["shortest_path_m"].IsNull());
  EXPECT_TRUE(bert["stuck"].as<bool>());
  EXPECT_TRUE(bert["target_inside_obstacle"].as<bool>());
}

TEST(JsonReport, RatiosAreNullWhereNobodyArrived) {
  const YAML::Node run = YAML::Load(toJson({someRun()}, {someResult()}))[0];
  EXPECT_TRUE(run["time_ratio"].IsNull());
  EXPECT_TRUE(run["path_ratio"].IsNull());
  RunResult result = someFlights();
  result.flown.flights[1] = result.flown.flights[0];
  result.flown.mission_time = 18.0;
  EXPECT_NEAR(YAML::Load(toJson({someRun()}, {result}))[0]["mission_time_ratio"].as<double>(), 1.5, 1e-9);
}

TEST(Reports, TellWhatWasLeftOut) {
  RunResult result;
  const YAML::Node all = YAML::Load(toJson({someRun()}, {result}))[0]["without"];
  EXPECT_TRUE(all.IsSequence() && all.size() == 0u);
  EXPECT_EQ(toTable({someRun()}, {result}).find("without"), std::string::npos);
  result.left_out = {"check", "latency"};
  const YAML::Node without = YAML::Load(toJson({someRun()}, {result}))[0]["without"];
  EXPECT_EQ(without.as<std::vector<std::string>>(), result.left_out);
  const std::string table = toTable({someRun()}, {result});
  EXPECT_NE(table.find("negative control, without latency"), std::string::npos) << table;
}

TEST(JsonReport, NoRunsAreAnEmptyArray) { EXPECT_EQ(YAML::Load(toJson({}, {})).size(), 0u); }

TEST(TextReport, SaysWhoCollidedWithWhatAndSumsTheRunsUp) {
  const std::string table = toTable({someRun(), someRun()}, {someResult(), someResult()});
  EXPECT_NE(table.find("anna too close to bert at 1.50 s"), std::string::npos) << table;
  EXPECT_NE(table.find("bert too close to obstacle 42 at 2.50 s"), std::string::npos) << table;
  EXPECT_NE(table.find("all 2 runs"), std::string::npos) << table;
}

TEST(Statistics, MedianAndPercentilesLieBetweenTheRanks) {
  std::vector<double> samples(101);
  std::iota(samples.rbegin(), samples.rend(), 0.0);
  const Distribution distribution = distributionOf(samples);
  EXPECT_DOUBLE_EQ(distribution.mean, 50.0);
  EXPECT_DOUBLE_EQ(distribution.median, 50.0);
  EXPECT_DOUBLE_EQ(distribution.p99, 99.0);
  EXPECT_DOUBLE_EQ(distribution.max, 100.0);
  EXPECT_DOUBLE_EQ(distributionOf({4.0, 1.0, 3.0, 2.0}).median, 2.5);
  EXPECT_DOUBLE_EQ(distributionOf({}).max, 0.0);
}

TEST(Statistics, HistogramsCountEverySampleOnce) {
  const Histogram histogram = histogramOf({0.0, 1e-4, 0.00101, 0.5, 0.5, 2.0, 1e9, std::nan("")});
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0ULL), 8u);
  EXPECT_EQ(histogram.counts.front(), 4u) << "0, too little, the first bin's own, and what is no number";
  EXPECT_EQ(histogram.counts.back(), 1u);
  const auto bin =
      static_cast<std::size_t>(std::floor(Histogram::kBinsPerDecade * std::log10(0.5 / Histogram::kLeast)));
  EXPECT_EQ(histogram.counts[bin], 2u);
}

TEST(AtomicFile, IsThereCompleteOrNotAtAll) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("result.json");
  { const AtomicFile abandoned(path); }
  EXPECT_EQ(directory.size(), 0u);
  {
    AtomicFile file(path);
    EXPECT_EQ(contentOf(path), "");
    file.write("all of it");
  }
  EXPECT_EQ(contentOf(path), "all of it");
  EXPECT_EQ(directory.size(), 1u);
  EXPECT_THROW(AtomicFile(directory.file("missing/result.json")), std::runtime_error);
  EXPECT_THROW(AtomicFile(directory.file("")), std::runtime_error);
}

}  // namespace
}  // namespace swarm_planner
