// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: scripts/sim reports success after a collision, or writes what no JSON reader takes.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "swarm_planner/ros/run_report.hpp"

namespace swarm_planner {
namespace {

RunReport goodReport() {
  RunReport report;
  report.scenario = "paper_six";
  report.uavs = 6;
  report.ended_by = "scenario";
  report.summary.min_uav_distance = 18.25;
  report.summary.final_lag = {0.5, 2.5};
  report.cycles = 312;
  report.cycle_time_mean = 0.002;
  return report;
}

TEST(RunReport, JsonIsOneLineThatReadsBack) {
  const std::string json = toJson(goodReport());
  EXPECT_EQ(json.find('\n'), std::string::npos);
  const YAML::Node read = YAML::Load(json);  // JSON is YAML
  EXPECT_TRUE(read["clear"].as<bool>());
  EXPECT_EQ(read["scenario"].as<std::string>(), "paper_six");
  EXPECT_EQ(read["uavs"].as<int>(), 6);
  EXPECT_EQ(read["collisions"].as<int>(), 0);
  EXPECT_EQ(read["min_uav_distance_m"].as<double>(), 18.25);
  EXPECT_TRUE(read["min_obstacle_clearance_m"].IsNull());
  EXPECT_EQ(read["final_lag_m"]["max"].as<double>(), 2.5);
  EXPECT_EQ(read["cycle_ms"]["mean"].as<double>(), 2.0);
}

TEST(RunReport, EscapesTheScenariosName) {
  RunReport report = goodReport();
  report.scenario = "a \"b\" \\ c";
  EXPECT_EQ(YAML::Load(toJson(report))["scenario"].as<std::string>(), report.scenario);
}

TEST(RunReport, IsClearOnlyWithoutCollisionAndRunToTheEnd) {
  EXPECT_TRUE(goodReport().clear());
  RunReport collided = goodReport();
  collided.summary.collisions.emplace_back();
  EXPECT_FALSE(collided.clear());
  EXPECT_FALSE(YAML::Load(toJson(collided))["clear"].as<bool>());
  EXPECT_NE(toText(collided).find("COLLISION"), std::string::npos);
  RunReport interrupted = goodReport();
  interrupted.ended_by = "interrupt";
  EXPECT_FALSE(interrupted.clear());
  RunReport limited = goodReport();
  limited.ended_by = "duration";
  EXPECT_TRUE(limited.clear());
}

}  // namespace
}  // namespace swarm_planner
