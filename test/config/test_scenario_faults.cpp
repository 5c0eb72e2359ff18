// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A scenario author who makes a mistake must be told which key is wrong, what was found and what was expected.
// A fault that goes unseen starts UAVs with values that nobody wrote.
#include <gtest/gtest.h>

#include <vector>

#include "config/fault_table.hpp"
#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {
namespace {

constexpr const char* kGood = R"(name: example
frame_id: map
end: {target_x: 300.0}
uavs:
  - name: uav1
    start: [0.0, 100.0, 20.0]
    reference: [[0, 100, 20], [1000, 100, 20]]
    target: {start: 20.0, speed: 3.0}
  - name: uav2
    start: [0.0, 150.0, 20.0]
    reference: [[0, 150, 20], [1000, 150, 20]]
    target: {start: 10.0, speed: 2.0}
obstacles:
  - {id: 1, center: [60, 103, 22], radii: [12, 13, 30], exponents: [2, 4, 2.5], velocity: [0, 0, 0]}
  - {id: 2, center: [90, 153, 22], radii: [12, 12, 30], exponents: [2, 2, 2], velocity: [0, 1, 0], yaw: 0.5}
workspace: {min: [-50, -50, 0.5], max: [1050, 350, 120]}
overrides: {max_speed: 5.0, uav_radius: 0.3}
)";

TEST(ScenarioFaults, RightFileHasNone) {
  Faults faults;
  parseScenarioText(kGood, "file.yaml", faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
}

class ScenarioFault : public testing::TestWithParam<FaultCase> {};

TEST_P(ScenarioFault, IsTheOnlyOneReported) {
  Faults faults;
  parseScenarioText(changed(kGood, GetParam().original, GetParam().replacement), "file.yaml", faults);
  expectOnlyFault(faults, "file.yaml", GetParam());
}

const FaultCase kDocument[] = {
    {"EmptyFile", kGood, "", "", "found nothing, expected a YAML map"},
    {"OnlyComments", kGood, "# nothing\n", "", "found nothing, expected a YAML map"},
    {"NoMap", kGood, "- 1\n- 2\n", "", "found a list of 2, expected a map (line 1)"},
    {"OnlyText", kGood, "scenario", "", "found \"scenario\", expected a map (line 1)"},
    {"TwoDocuments", "overrides:", "---\noverrides:", "", "found text after the first YAML document"},
    {"TextAfterAMap", kGood, "{a: 1} b", "", "found text after the first YAML document"},
    {"StrayCommaBeforeTheMap", "name: example", ", 14\nname: example", "", "found text after the first YAML document"},
    {"SyntaxError", "[0.0, 100.0, 20.0]", "[0.0, 100.0, 20.0", "", "no legal YAML"},
    {"UndefinedAlias", "target: {start: 20.0", "target: {start: *x", "", "no legal YAML"},
    {"KeyIsAList", "frame_id: map", "frame_id: map\n? [a]\n: 1", "", "found a key that is not text (line 3)"},
    {"RepeatedRootKey", "frame_id: map", "frame_id: map\nframe_id: odom", "frame_id",
     "repeated key, first given in line 2 (line 3)"},
    {"MergeKey", "frame_id: map", "frame_id: map\n<<: {end: 1}", "<<", "unknown key"},
};
INSTANTIATE_TEST_SUITE_P(Document, ScenarioFault, testing::ValuesIn(kDocument), caseName);

const FaultCase kRoot[] = {
    {"UnknownKeyIsSuggested", "workspace:", "workspcae:", "workspcae",
     "unknown key, did you mean \"workspace\"? (line 16)"},
    {"UnknownKeyUnlikeAny", "frame_id: map", "frame_id: map\nwind: 3", "wind",
     "unknown key, expected one of: name, frame_id, end, uavs, obstacles, map, workspace, overrides, faults (line 3)"},
    {"MissingName", "name: example\n", "", "name", "missing, expected text (line 1)"},
    {"NameIsANumber", "name: example", "name: 16", "name", "found 16, expected text (put it in quotes) (line 1)"},
    {"NameIsEmpty", "name: example", "name: \"\"", "name", "found \"\", expected text"},
    {"NameIsAList", "name: example", "name: [a]", "name", "found a list of 1, expected text"},
    {"MissingFrame", "frame_id: map\n", "", "frame_id", "missing, expected text"},
    {"FrameWithLeadingSlash", "frame_id: map", "frame_id: /map", "frame_id", "found \"/map\", expected a tf2 frame"},
    {"ObstaclesIsNothing", "overrides:", "obstacles:\noverrides:", "obstacles", "repeated key"},
    {"MapOfNothing", "workspace:", "map: {}\nworkspace:", "map", "found neither octomap nor unknown_space"},
    {"MapWithoutFile", "workspace:", "map: {octomap: \"\"}\nworkspace:", "map.octomap", "found \"\", expected text"},
    {"MapIsAName", "workspace:", "map: some.bt\nworkspace:", "map", "found \"some.bt\", expected a map"},
    {"MapWithUnknownKey", "workspace:", "map: {octomap: a.bt, unknown: free}\nworkspace:", "map.unknown",
     "unknown key"},
    {"UnknownSpaceInOtherWords", "workspace:", "map: {unknown_space: full}\nworkspace:", "map.unknown_space",
     "found \"full\", expected free or occupied"},
};
INSTANTIATE_TEST_SUITE_P(Root, ScenarioFault, testing::ValuesIn(kRoot), caseName);

const FaultCase kEnd[] = {
    {"Missing", "end: {target_x: 300.0}\n", "", "end", "missing, expected one of target_x, duration, all_at_goal"},
    {"NoKind", "{target_x: 300.0}", "{}", "end",
     "found 0 of target_x, duration and all_at_goal, expected exactly one (line 3)"},
    {"TwoKinds", "{target_x: 300.0}", "{target_x: 300.0, duration: 60}", "end",
     "found 2 of target_x, duration and all_at_goal, expected exactly one"},
    {"ZeroDuration", "{target_x: 300.0}", "{duration: 0}", "end.duration", "found 0, expected a number > 0"},
    {"NotANumber", "{target_x: 300.0}", "{target_x: far}", "end.target_x", "found \"far\", expected a finite number"},
    {"GoalIsFalse", "{target_x: 300.0}", "{all_at_goal: false, timeout: 60, tolerance: 0.2}", "end.all_at_goal",
     "found false, expected true"},
    {"GoalIsNoBoolean", "{target_x: 300.0}", "{all_at_goal: yes, timeout: 60, tolerance: 0.2}", "end.all_at_goal",
     "found \"yes\", expected true or false"},
    {"GoalWithoutTimeout", "{target_x: 300.0}", "{all_at_goal: true, tolerance: 0.2}", "end.timeout",
     "missing, expected a number > 0"},
    {"GoalWithoutTolerance", "{target_x: 300.0}", "{all_at_goal: true, timeout: 60}", "end.tolerance",
     "missing, expected a number > 0"},
    {"TimeoutWithoutGoal", "{target_x: 300.0}", "{duration: 60, timeout: 60}", "end.timeout",
     "only goes with all_at_goal"},
};
INSTANTIATE_TEST_SUITE_P(End, ScenarioFault, testing::ValuesIn(kEnd), caseName);

const FaultCase kUav[] = {
    {"UnknownKey", "start: [0.0, 150.0, 20.0]", "start: [0.0, 150.0, 20.0]\n    payload: 2", "uavs[1].payload",
     "unknown key"},
    {"MissingName", "- name: uav1\n    start", "- start", "uavs[0].name", "missing, expected text (line 5)"},
    {"DuplicateName", "name: uav2", "name: uav1", "uavs[1].name",
     "found \"uav1\", expected another name than that of uavs[0]"},
    {"NameWithASpace", "name: uav1", "name: uav 1", "uavs[0].name", "found \"uav 1\", expected a relative ROS name"},
    {"NameStartsWithADigit", "name: uav1", "name: 1uav", "uavs[0].name", "expected a relative ROS name"},
    {"NameIsGlobal", "name: uav1", "name: /uav1", "uavs[0].name", "expected a relative ROS name"},
    {"NameWithAHyphen", "name: uav1", "name: uav-1", "uavs[0].name", "expected a relative ROS name"},
    {"NameEndsWithASlash", "name: uav1", "name: uav1/", "uavs[0].name", "expected a relative ROS name"},
    {"MissingStart", "    start: [0.0, 100.0, 20.0]\n", "", "uavs[0].start",
     "missing, expected a list of 3 finite numbers (line 5)"},
    {"StartOfTwoNumbers", "[0.0, 100.0, 20.0]", "[0.0, 100.0]", "uavs[0].start",
     "found a list of 2, expected a list of 3 finite numbers (line 6)"},
    {"StartIsNaN", "[0.0, 100.0, 20.0]", "[0.0, .nan, 20.0]", "uavs[0].start[1]",
     "found .nan, expected a finite number"},
    {"StartIsInfinite", "[0.0, 100.0, 20.0]", "[-.inf, 100.0, 20.0]", "uavs[0].start[0]",
     "found -.inf, expected a finite number"},
    {"StartIsTooLarge", "[0.0, 100.0, 20.0]", "[0.0, 100.0, 1e400]", "uavs[0].start[2]",
     "found 1e400, expected a finite number"},
    {"StartIsAbsurd", "[0.0, 100.0, 20.0]", "[0.0, 100.0, 1e8]", "uavs[0].start", "in magnitude"},
    {"StartInQuotes", "[0.0, 100.0, 20.0]", "[0.0, \"100.0\", 20.0]", "uavs[0].start[1]",
     "found \"100.0\", expected a finite number"},
    {"StartIsHexadecimal", "[0.0, 100.0, 20.0]", "[0.0, 0x64, 20.0]", "uavs[0].start[1]",
     "found \"0x64\", expected a finite number"},
    {"MissingReference", "    reference: [[0, 100, 20], [1000, 100, 20]]\n", "", "uavs[0].reference",
     "missing, expected a list of at least one point [x, y, z]"},
    {"EmptyReference", "[[0, 100, 20], [1000, 100, 20]]", "[]", "uavs[0].reference",
     "found an empty list, expected a list of at least one point"},
    {"ReferencePointOfTwo", "[1000, 100, 20]", "[1000, 100]", "uavs[0].reference[1]",
     "found a list of 2, expected a list of 3 finite numbers"},
    {"ReferenceIsAPoint", "[[0, 100, 20], [1000, 100, 20]]", "5", "uavs[0].reference",
     "found 5, expected a list of at least one point"},
    {"MissingTarget", "    target: {start: 20.0, speed: 3.0}\n", "", "uavs[0].target", "missing, expected a map"},
    {"MissingSpeed", "{start: 20.0, speed: 3.0}", "{start: 20.0}", "uavs[0].target.speed",
     "missing, expected a number >= 0"},
    {"NegativeSpeed", "speed: 2.0", "speed: -2.0", "uavs[1].target.speed",
     "found -2.0, expected a number >= 0 (line 12)"},
    {"NegativeArcLength", "start: 20.0", "start: -1", "uavs[0].target.start", "found -1, expected a number >= 0"},
    {"RepeatedKey", "{start: 20.0, speed: 3.0}", "{start: 20.0, speed: 3.0, speed: 4.0}", "uavs[0].target.speed",
     "repeated key, first given in line 8"},
    {"ExternalIsANumber", "{start: 20.0, speed: 3.0}", "{start: 20.0, speed: 3.0}\n    external: 1", "uavs[0].external",
     "found 1, expected true or false"},
    {"TargetIsANumber", "{start: 20.0, speed: 3.0}", "3.0", "uavs[0].target", "found 3.0, expected a map"},
};
INSTANTIATE_TEST_SUITE_P(Uav, ScenarioFault, testing::ValuesIn(kUav), caseName);

const FaultCase kObstacle[] = {
    {"UnknownKey", "exponents: [2, 2, 2]", "exponents: [2, 2, 2], color: red", "obstacles[1].color", "unknown key"},
    {"DuplicateId", "id: 2", "id: 1", "obstacles[1].id", "found 1, expected another id than that of obstacles[0]"},
    {"NegativeId", "id: 1", "id: -1", "obstacles[0].id", "found -1, expected a whole number >= 0"},
    {"FractionalId", "id: 1", "id: 1.5", "obstacles[0].id", "found 1.5, expected a whole number >= 0"},
    {"IdTooLarge", "id: 1", "id: 99999999999", "obstacles[0].id", "found 99999999999, expected a whole number >= 0"},
    {"ZeroRadius", "radii: [12, 13, 30]", "radii: [12, 0, 30]", "obstacles[0].radii[1]",
     "found 0, expected a number > 0"},
    {"NegativeRadius", "radii: [12, 13, 30]", "radii: [12, 13, -30]", "obstacles[0].radii[2]",
     "found -30, expected a number > 0 (line 14)"},
    {"ExponentBelowTwo", "exponents: [2, 4, 2.5]", "exponents: [2, 4, 1.9]", "obstacles[0].exponents[2]",
     "found 1.9, expected a number >= 2"},
    {"MissingExponents", "exponents: [2, 4, 2.5], ", "", "obstacles[0].exponents",
     "missing, expected a list of 3 numbers, each >= 2"},
    {"MissingVelocity", ", velocity: [0, 0, 0]", "", "obstacles[0].velocity",
     "missing, expected a list of 3 finite numbers"},
    {"NaNVelocity", "velocity: [0, 0, 0]", "velocity: [0, .NaN, 0]", "obstacles[0].velocity[1]",
     "found .NaN, expected a finite number"},
    {"YawIsNothing", "yaw: 0.5", "yaw:", "obstacles[1].yaw", "found nothing, expected a finite number"},
};
INSTANTIATE_TEST_SUITE_P(Obstacle, ScenarioFault, testing::ValuesIn(kObstacle), caseName);

const FaultCase kWorkspaceAndOverrides[] = {
    {"MinAboveMax", "min: [-50, -50, 0.5]", "min: [-50, 350, 0.5]", "workspace", "expected min < max"},
    {"MissingMax", ", max: [1050, 350, 120]", "", "workspace.max", "missing, expected a list of 3 finite numbers"},
    {"UnknownOverride", "max_speed: 5.0", "max_sped: 5.0", "overrides.max_sped",
     "unknown key, did you mean \"max_speed\"?"},
    {"OverrideOfSimulation", "max_speed: 5.0", "odometry_rate: 5.0", "overrides.odometry_rate",
     "cannot be set by a scenario"},
    {"OverrideIsABoolean", "max_speed: 5.0", "avoidance: false", "overrides.avoidance", "cannot be set by a scenario"},
    {"OverrideOutOfRange", "max_speed: 5.0", "max_speed: 0", "overrides.max_speed",
     "found 0, expected a number in (0, 100] [m/s] (line 17)"},
    {"OverrideIsText", "max_speed: 5.0", "sampling_time: auto", "overrides.sampling_time",
     "found \"auto\", expected a number in [0.05, 1] [s]"},
    {"OverrideIsInfinite", "max_speed: 5.0", "max_speed: .inf", "overrides.max_speed", "found .inf, expected a number"},
    {"OverrideTooLarge", "max_speed: 5.0", "max_acceleration: 1e400", "overrides.max_acceleration",
     "found 1e400, expected a number > 0 or .inf"},
    {"FractionalIterations", "max_speed: 5.0", "max_iterations: 2.5", "overrides.max_iterations",
     "found 2.5, expected a whole number in [1, 50]"},
    {"RepeatedOverride", "max_speed: 5.0", "uav_radius: 0.4", "overrides.uav_radius", "repeated key"},
    {"OverridesIsAList", "{max_speed: 5.0, uav_radius: 0.3}", "[5.0]", "overrides",
     "found a list of 1, expected a map"},
};
INSTANTIATE_TEST_SUITE_P(WorkspaceAndOverrides, ScenarioFault, testing::ValuesIn(kWorkspaceAndOverrides), caseName);

TEST(ScenarioFaults, NoUavsAtAll) {
  const std::string start = "name: a\nframe_id: map\nend: {duration: 1}\n";
  Faults empty, missing;
  parseScenarioText(start + "uavs: []\n", "file.yaml", empty);
  parseScenarioText(start, "file.yaml", missing);
  EXPECT_EQ(empty.text(), "file.yaml: uavs: found an empty list, expected a list of at least one UAV (line 4)");
  EXPECT_EQ(missing.text(), "file.yaml: uavs: missing, expected a list of at least one UAV (line 1)");
}

TEST(ScenarioFaults, EveryFaultIsListedAtOnce) {
  std::string text = changed(kGood, "speed: 3.0", "speed: -3.0");
  text = changed(text, "radii: [12, 13, 30]", "radii: [-12, 13, .nan]");
  text = changed(text, "uav_radius", "uav_radios");
  Faults faults;
  parseScenarioText(text, "file.yaml", faults);
  EXPECT_EQ(faults.text(),
            "file.yaml: uavs[0].target.speed: found -3.0, expected a number >= 0 (line 8)\n"
            "file.yaml: obstacles[0].radii[0]: found -12, expected a number > 0 (line 14)\n"
            "file.yaml: obstacles[0].radii[2]: found .nan, expected a number > 0 (line 14)\n"
            "file.yaml: overrides.uav_radios: unknown key, did you mean \"uav_radius\"? (line 17)");
  EXPECT_THROW(faults.throwIfAny(), ConfigError);
}

TEST(ScenarioFaults, UnreadableFileIsNamed) {
  for (const char* path : {"config/scenarios/no_such_scenario.yaml", "config/scenarios"}) {
    Faults faults;
    parseScenarioFile(path, faults);
    EXPECT_EQ(faults.text(), std::string(path) + ": cannot be read, expected a YAML file");
  }
}

}  // namespace
}  // namespace swarm_planner
