// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: a misspelt parameter that is silently ignored, faults shown one at a time, a node.yaml that
// tells other defaults than those that hold.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "swarm_planner/ros/node_parameters.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/ros/quad_sim_options.hpp"

namespace swarm_planner {
namespace {

constexpr char kScenario[] = "config/scenarios/crossing.yaml";

ParameterMap goodParameters() { return {{"scenario", std::string(kScenario)}}; }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(NodeParameters, TakesItsOwnAndLeavesTheRest) {
  ParameterMap given = goodParameters();
  given["setpoint_dt"] = 0.1;
  given["max_speed"] = 4.0;
  Faults faults;
  const PlannerNodeOptions options = takePlannerNodeOptions(given, faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  EXPECT_EQ(options.scenario, kScenario);
  EXPECT_EQ(options.setpoint_dt, 0.1);
  EXPECT_EQ(options.odometry_topic, "{uav}/odometry");
  ASSERT_EQ(given.size(), 1U);
  EXPECT_EQ(given.count("max_speed"), 1U);
}

TEST(NodeParameters, IntegerServesAsRealNumberButNotTheOtherWay) {
  ParameterMap given = goodParameters();
  given["marker_rate"] = 5;
  Faults faults;
  EXPECT_EQ(takePlannerNodeOptions(given, faults).marker_rate, 5.0);
  EXPECT_TRUE(faults.empty()) << faults.text();
  ParameterMap sim = goodParameters();
  sim["exit_at_end"] = 1;
  takeQuadSimOptions(sim, faults);
  EXPECT_TRUE(contains(faults.text(), "exit_at_end")) << faults.text();
}

struct BadParameter {
  const char* key;
  ParameterValue value;
  const char* message;
};

TEST(NodeParameters, NamesEveryFaultAndWhatWasExpected) {
  const BadParameter table[] = {
      {"scenario", 7, "a string"},
      {"odometry_topic", std::string("odometry"), "{uav}"},
      {"trajectory_topic", std::string("command"), "{uav}"},
      {"odometry_twist_frame", std::string("boddy"), "body or world"},
      {"setpoint_delivery", std::string("soon"), "at_once or at_epoch"},
      {"mode", std::string("all"), "iterative, joint or groups"},
      {"planning_share", 0.0, "[0.001, 1]"},
      {"planning_share", 1.1, "[0.001, 1]"},
      {"setpoint_dt", 0.0, "[0.001, 1]"},
      {"setpoint_dt", std::nan(""), "[0.001, 1]"},
      {"setpoint_horizon", -1.0, "expected within"},
      {"marker_rate", std::string("often"), "a number"},
      {"uav_marker_size", -0.5, "expected within"},
      {"trail_duration", true, "a number"},
      {"diagnostic_period", 0, "[0.1, 60]"},
  };
  for (const BadParameter& bad : table) {
    ParameterMap given = goodParameters();
    given[bad.key] = bad.value;
    Faults faults;
    takePlannerNodeOptions(given, faults);
    ASSERT_EQ(faults.list().size(), 1U) << bad.key << "\n" << faults.text();
    EXPECT_EQ(faults.list()[0].key, bad.key);
    EXPECT_TRUE(contains(faults.list()[0].message, bad.message)) << faults.text();
  }
}

TEST(NodeParameters, MissingScenarioIsAFault) {
  ParameterMap given;
  Faults faults;
  takePlannerNodeOptions(given, faults);
  EXPECT_TRUE(contains(faults.text(), "scenario: is missing")) << faults.text();
}

TEST(NodeParameters, MissionTellsAllFaultsInOneList) {
  ParameterMap given = {{"max_sped", 3.0}, {"uav_radius", -1.0}};
  Faults faults;
  faults.add("parameters", "setpoint_dt", "is 0");
  try {
    loadNodeMission(kScenario, given, faults);
    FAIL() << "three faults were accepted";
  } catch (const ConfigError& error) {
    for (const char* key : {"setpoint_dt", "max_sped", "uav_radius"}) {
      EXPECT_TRUE(contains(error.what(), key)) << key << " is missing in:\n" << error.what();
    }
  }
}

TEST(NodeParameters, ParametersAreCheckedWithoutAScenarioToo) {
  Faults faults;
  faults.add("parameters", "scenario", "is missing");
  try {
    loadNodeMission("", {{"max_sped", 3.0}}, faults);
    FAIL() << "a missing scenario was accepted";
  } catch (const ConfigError& error) {
    EXPECT_TRUE(contains(error.what(), "scenario: is missing")) << error.what();
    EXPECT_TRUE(contains(error.what(), "max_sped")) << error.what();
  }
}

TEST(NodeParameters, GoodMissionLoads) {
  const Mission mission = loadNodeMission(kScenario, {{"max_acceleration", 9.0}}, Faults());
  EXPECT_EQ(mission.scenario.uavs.size(), 6U);
  EXPECT_EQ(mission.parameters.limits.max_acceleration, 9.0);
}

TEST(NodeParameters, ShippedFileTellsEveryDefault) {
  const YAML::Node file = YAML::LoadFile("config/node.yaml");
  std::set<std::string> keys;
  for (const auto& entry : file) keys.insert(entry.first.as<std::string>());
  for (const NodeParameter& parameter : plannerNodeTable()) {
    if (parameter.required) continue;
    ASSERT_EQ(keys.erase(parameter.name), 1U) << parameter.name << " is not in config/node.yaml";
    const YAML::Node value = file[parameter.name];
    if (std::holds_alternative<double>(parameter.default_value)) {
      EXPECT_EQ(value.as<double>(), std::get<double>(parameter.default_value)) << parameter.name;
    } else {
      EXPECT_EQ(value.as<std::string>(), std::get<std::string>(parameter.default_value)) << parameter.name;
    }
  }
  EXPECT_TRUE(keys.empty()) << *keys.begin() << " in config/node.yaml is no parameter of the node";
}

TEST(NodeParameters, ManualNamesEveryOne) {
  std::ifstream file("doc/ros.md");
  std::ostringstream manual;
  manual << file.rdbuf();
  for (const auto* table : {&plannerNodeTable(), &quadSimTable()}) {
    for (const NodeParameter& parameter : *table) {
      EXPECT_TRUE(contains(manual.str(), "`" + parameter.name + "`")) << parameter.name << " is not in doc/ros.md";
    }
  }
}

}  // namespace
}  // namespace swarm_planner
