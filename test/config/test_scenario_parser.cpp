// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What a scenario file says must arrive in the struct as it stands, and what a program writes must read back as
// exactly the same scenario: otherwise the ROS nodes and the experiment program would fly different runs.
#include <gtest/gtest.h>

#include <limits>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {
namespace {

Scenario parsed(const std::string& text) {
  Faults faults;
  Scenario scenario = parseScenarioText(text, "text", faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  return scenario;
}

void expectSame(const Scenario& a, const Scenario& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.frame_id, b.frame_id);
  EXPECT_EQ(a.end.target_x, b.end.target_x);
  EXPECT_EQ(a.end.duration, b.end.duration);
  EXPECT_EQ(a.end.all_at_goal, b.end.all_at_goal);
  EXPECT_EQ(a.end.timeout, b.end.timeout);
  EXPECT_EQ(a.end.tolerance, b.end.tolerance);
  EXPECT_EQ(a.overrides, b.overrides);
  ASSERT_EQ(a.workspace.has_value(), b.workspace.has_value());
  if (a.workspace) {
    EXPECT_EQ(a.workspace->min, b.workspace->min);
    EXPECT_EQ(a.workspace->max, b.workspace->max);
  }
  ASSERT_EQ(a.uavs.size(), b.uavs.size());
  for (std::size_t i = 0; i < a.uavs.size(); ++i) {
    EXPECT_EQ(a.uavs[i].name, b.uavs[i].name);
    EXPECT_EQ(a.uavs[i].start, b.uavs[i].start);
    EXPECT_EQ(a.uavs[i].reference, b.uavs[i].reference);
    EXPECT_EQ(a.uavs[i].target.start, b.uavs[i].target.start);
    EXPECT_EQ(a.uavs[i].target.speed, b.uavs[i].target.speed);
    EXPECT_EQ(a.uavs[i].external, b.uavs[i].external);
  }
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].id, b.obstacles[i].id);
    EXPECT_EQ(a.obstacles[i].center, b.obstacles[i].center);
    EXPECT_EQ(a.obstacles[i].radii, b.obstacles[i].radii);
    EXPECT_EQ(a.obstacles[i].exponents, b.obstacles[i].exponents);
    EXPECT_EQ(a.obstacles[i].velocity, b.obstacles[i].velocity);
    EXPECT_EQ(a.obstacles[i].yaw, b.obstacles[i].yaw);
  }
}

TEST(ScenarioParser, EveryKeyArrives) {
  const Scenario scenario = parsed(R"(
name: paper_six
frame_id: odom
end: {all_at_goal: true, timeout: 61.0, tolerance: 0.25}
uavs:
  - name: team/uav_1
    start: [1, -2.5, +3e1]
    reference: [[0, 100, 20], [0, 100, 20], [1000, 100, .5]]
    target: {start: 20.0, speed: 3.0}
obstacles:
  - {id: 7, center: [60, 103, 22], radii: [12, 13, 30], exponents: [2, 10, 2.5], velocity: [1, -2, 0.5], yaw: -0.5}
  - {id: 0, center: [0, 0, 0], radii: [1, 1, 1], exponents: [2, 2, 2], velocity: [0, 0, 0]}
workspace: {min: [-50, -51, 0.5], max: [1050, 350, 120]}
overrides: {max_speed: 4.5, max_acceleration: .inf, tracking_margin: 0.1, mass: 0.5, max_iterations: 3}
)");
  EXPECT_EQ(scenario.name, "paper_six");
  EXPECT_EQ(scenario.frame_id, "odom");
  EXPECT_TRUE(scenario.end.all_at_goal);
  EXPECT_FALSE(scenario.end.duration || scenario.end.target_x);
  EXPECT_EQ(scenario.end.timeout, 61.0);
  EXPECT_EQ(scenario.end.tolerance, 0.25);
  ASSERT_EQ(scenario.uavs.size(), 1u);
  EXPECT_EQ(scenario.uavs[0].name, "team/uav_1");
  EXPECT_EQ(scenario.uavs[0].start, Vector3(1.0, -2.5, 30.0));
  const std::vector<Vector3> reference = {{0.0, 100.0, 20.0}, {0.0, 100.0, 20.0}, {1000.0, 100.0, 0.5}};
  EXPECT_EQ(scenario.uavs[0].reference, reference);
  EXPECT_EQ(scenario.uavs[0].target.start, 20.0);
  EXPECT_EQ(scenario.uavs[0].target.speed, 3.0);
  ASSERT_EQ(scenario.obstacles.size(), 2u);
  EXPECT_EQ(scenario.obstacles[0].id, 7);
  EXPECT_EQ(scenario.obstacles[0].center, Vector3(60.0, 103.0, 22.0));
  EXPECT_EQ(scenario.obstacles[0].radii, Vector3(12.0, 13.0, 30.0));
  EXPECT_EQ(scenario.obstacles[0].exponents, Vector3(2.0, 10.0, 2.5));
  EXPECT_EQ(scenario.obstacles[0].velocity, Vector3(1.0, -2.0, 0.5));
  EXPECT_EQ(scenario.obstacles[0].yaw, -0.5);
  EXPECT_EQ(scenario.obstacles[1].yaw, 0.0);
  ASSERT_TRUE(scenario.workspace);
  EXPECT_EQ(scenario.workspace->min, Vector3(-50.0, -51.0, 0.5));
  EXPECT_EQ(scenario.workspace->max, Vector3(1050.0, 350.0, 120.0));
  const std::map<std::string, double> overrides = {{"max_speed", 4.5},
                                                   {"max_acceleration", std::numeric_limits<double>::infinity()},
                                                   {"tracking_margin", 0.1},
                                                   {"mass", 0.5},
                                                   {"max_iterations", 3.0}};
  EXPECT_EQ(scenario.overrides, overrides);
}

TEST(ScenarioParser, OptionalKeysMayBeLeftOut) {
  const Scenario scenario = parsed(R"(
name: stay
frame_id: map
end: {duration: 5}
uavs:
  - {name: a, start: [0, 0, 1], reference: [[0, 0, 1]], target: {start: 0, speed: 0}}
)");
  EXPECT_EQ(scenario.end.duration, 5.0);
  EXPECT_TRUE(scenario.obstacles.empty());
  EXPECT_FALSE(scenario.workspace);
  EXPECT_TRUE(scenario.overrides.empty());
  EXPECT_FALSE(scenario.uavs[0].external);
}

TEST(ScenarioParser, AUavMayBelongToAnotherSystem) {
  Scenario scenario = crossing();
  scenario.uavs[1].external = true;
  const Scenario read = parsed(toYaml(scenario));
  EXPECT_FALSE(read.uavs[0].external);
  EXPECT_TRUE(read.uavs[1].external);
  expectSame(read, scenario);
}

TEST(ScenarioParser, AMapMayBeNamedAndUnknownSpaceBeOccupied) {
  Scenario scenario = crossing();
  EXPECT_TRUE(parsed(toYaml(scenario)).map_file.empty());
  EXPECT_FALSE(parsed(toYaml(scenario)).unknown_is_occupied);
  for (const char* file : {"", "maps/some.bt", "with space \"and\".ot"}) {
    for (const bool occupied : {false, true}) {
      scenario.map_file = file;
      scenario.unknown_is_occupied = occupied;
      const Scenario read = parsed(toYaml(scenario));
      EXPECT_EQ(read.map_file, file);
      EXPECT_EQ(read.unknown_is_occupied, occupied);
      expectSame(read, scenario);
    }
  }
}

TEST(ScenarioWriter, ReadsBackExactly) {
  for (const Scenario& scenario : {paperSix(), paperScaling(32), paperMonteCarlo(6, 1), paperMonteCarlo(16, 77),
                                   crossing(), circleSwap(7, 3.3, 5)}) {
    expectSame(parsed(toYaml(scenario)), scenario);
  }
}

TEST(ScenarioWriter, AwkwardTextAndNumbersReadBackExactly) {
  for (const char* name : {"true", "No", "5", "with space", "quote \" and \\", "line\nbreak", "# hash", "~", "1e5"}) {
    Scenario scenario = crossing();
    scenario.name = name;
    scenario.uavs[0].start = Vector3(1.0 / 3.0, -1e-300, 1.2345678901234e6);
    scenario.uavs[0].target.start = std::numeric_limits<double>::denorm_min();
    scenario.overrides["max_acceleration"] = std::numeric_limits<double>::infinity();
    scenario.overrides["force_constant"] = 1e-5;
    expectSame(parsed(toYaml(scenario)), scenario);
  }
}

TEST(ScenarioWriter, NumbersAreReadableByPeopleAndByYaml11) {
  Scenario scenario = circleSwap(1, 10.0, 0);
  scenario.overrides = {{"force_constant", 1e-5}, {"max_rotor_speed", 120000.0}};
  EXPECT_EQ(toYaml(scenario), R"(name: circle_swap
frame_id: map
end: {all_at_goal: true, timeout: 60, tolerance: 0.2}
uavs:
  - name: uav1
    start: [10, 0, 10]
    reference: [[10, 0, 10], [-10, 0, 10]]
    target: {start: 0, speed: 4}
obstacles: []
overrides:
  force_constant: 1.0e-05
  max_rotor_speed: 120000
)");
}

}  // namespace
}  // namespace swarm_planner
