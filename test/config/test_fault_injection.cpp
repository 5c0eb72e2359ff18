// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Who rehearses a fault must get the one that was asked for: a mistyped one that is not injected shows a swarm that
// copes with everything.
#include <gtest/gtest.h>

#include <limits>

#include "config/fault_table.hpp"
#include "swarm_planner/config/rehearsal.hpp"
#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {
namespace {

constexpr const char* kGood = R"(name: example
frame_id: map
end: {duration: 30}
uavs:
  - {name: uav1, start: [0, 0, 5], reference: [[0, 0, 5]], target: {start: 0, speed: 0}}
  - {name: uav2, start: [0, 9, 5], reference: [[0, 9, 5]], target: {start: 0, speed: 0}}
faults:
  - {uav: uav2, kind: odometry_jump, at: 12.5, duration: 3.0, magnitude: 4}
  - {uav: uav1, kind: push, at: 0}
  - {kind: tracks_lost, at: 7, duration: 2}
)";

bool isSame(const FaultInjection& a, const FaultInjection& b) {
  return a.kind == b.kind && a.uav == b.uav && a.at == b.at && a.duration == b.duration && a.magnitude == b.magnitude;
}

TEST(FaultKinds, AreInTheOrderOfTheEnumerationEachWithItsOwnName) {
  for (std::size_t i = 0; i < faultKinds().size(); ++i) {
    const FaultKindInfo& info = faultKinds()[i];
    EXPECT_EQ(static_cast<std::size_t>(info.kind), i);
    EXPECT_EQ(findFaultKind(info.name), &info);
    EXPECT_EQ(info.magnitude != nullptr, info.most_magnitude > 0.0) << info.name;
    EXPECT_EQ(info.magnitude != nullptr, info.default_magnitude > 0.0) << info.name;
    EXPECT_LE(info.default_magnitude, info.most_magnitude) << info.name;
  }
  EXPECT_EQ(faultKinds().back().kind, FaultKind::kPlannerDead);
  EXPECT_EQ(findFaultKind("odometry"), nullptr);
}

TEST(FaultInjections, ArriveAsTheFileSays) {
  Faults faults;
  const Scenario scenario = parseScenarioText(kGood, "file.yaml", faults);
  ASSERT_TRUE(faults.empty()) << faults.text();
  ASSERT_EQ(scenario.faults.size(), 3u);
  EXPECT_TRUE(isSame(scenario.faults[0], {FaultKind::kOdometryJump, "uav2", 12.5, 3.0, 4.0}));
  EXPECT_TRUE(isSame(scenario.faults[1], {FaultKind::kPush, "uav1", 0.0, 0.0, 2.0})) << "default magnitude";
  EXPECT_TRUE(isSame(scenario.faults[2], {FaultKind::kTracksLost, "", 7.0, 2.0, 0.0}));
}

class FaultyInjection : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultyInjection, IsTheOnlyFaultReported) {
  Faults faults;
  parseScenarioText(changed(kGood, GetParam().original, GetParam().replacement), "file.yaml", faults);
  expectOnlyFault(faults, "file.yaml", GetParam());
}

const FaultCase kCases[] = {
    {"NoList", kGood, changed(kGood, std::string(kGood).substr(std::string(kGood).find("faults:")), "faults: 3\n"),
     "faults", "found 3, expected a list of faults to inject"},
    {"UnknownKey", "magnitude: 4", "size: 4", "faults[0].size", "unknown key"},
    {"UnknownKind", "kind: push", "kind: pull", "faults[1].kind", "found \"pull\", expected one of odometry_lost, "},
    {"MissingKind", "kind: push, ", "", "faults[1].kind", "missing, expected text"},
    {"MissingTime", ", at: 0}", "}", "faults[1].at", "missing, expected a number >= 0"},
    {"NegativeTime", "at: 7", "at: -7", "faults[2].at", "found -7, expected a number >= 0 (line 10)"},
    {"NaNTime", "at: 7", "at: .nan", "faults[2].at", "found .nan, expected a number >= 0"},
    {"MissingDuration", ", duration: 2", "", "faults[2].duration", "missing, expected a number in (0, "},
    {"ZeroDuration", "duration: 2", "duration: 0", "faults[2].duration", "found 0, expected a number in (0, "},
    {"EndlessDuration", "duration: 2", "duration: .inf", "faults[2].duration", "found .inf, expected a number"},
    {"DurationOfAPush", "at: 0", "at: 0, duration: 1", "faults[1].duration", "does not go with push"},
    {"MissingUav", "uav: uav1, ", "", "faults[1].uav", "missing, expected text"},
    {"UnknownUav", "uav: uav1, ", "uav: uav3, ", "faults[1].uav", "found \"uav3\", expected the name of a UAV"},
    {"UavOfTracks", "at: 7", "uav: uav1, at: 7", "faults[2].uav", "does not go with tracks_lost"},
    {"MagnitudeOfLostTracks", "at: 7", "magnitude: 1, at: 7", "faults[2].magnitude", "does not go with tracks_lost"},
    {"NegativeMagnitude", "magnitude: 4", "magnitude: -4", "faults[0].magnitude", "found -4, expected a number in (0"},
    {"MagnitudeTooLarge", "at: 0", "at: 0, magnitude: 1e300", "faults[1].magnitude", "expected a number in (0, 20]"},
};
INSTANTIATE_TEST_SUITE_P(File, FaultyInjection, testing::ValuesIn(kCases), caseName);

TEST(FaultInjections, ReadBackExactlyAsWritten) {
  for (const std::uint64_t seed : {0u, 1u}) {
    const Scenario written = rehearsal(4, 600.0, seed);
    Faults faults;
    const Scenario read = parseScenarioText(toYaml(written), "text", faults);
    ASSERT_TRUE(faults.empty()) << faults.text();
    ASSERT_EQ(read.faults.size(), written.faults.size());
    for (std::size_t i = 0; i < read.faults.size(); ++i) {
      EXPECT_TRUE(isSame(read.faults[i], written.faults[i])) << "fault " << i;
    }
  }
}

TEST(FaultInjections, AServiceGivesTheDefaultMagnitudeForZero) {
  std::string mistake;
  const auto fault = makeFaultInjection("wind", {{}, "uav1", 1.0, 4.0, 0.0}, {"uav1"}, mistake);
  ASSERT_TRUE(fault) << mistake;
  EXPECT_TRUE(isSame(*fault, {FaultKind::kWind, "uav1", 1.0, 4.0, faultKindInfo(FaultKind::kWind).default_magnitude}));
}

TEST(FaultInjections, AServiceIsToldEveryMistake) {
  const struct {
    const char* kind;
    FaultInjection given;
    const char* expected;
  } mistakes[] = {
      {"winds", {{}, "uav1", 0.0, 1.0, 0.0}, "kind: found \"winds\""},
      {"wind", {{}, "uav9", 0.0, 1.0, 0.0}, "uav: found \"uav9\""},
      {"wind", {{}, "", 0.0, 1.0, 0.0}, "uav: found \"\""},
      {"tracks_lost", {{}, "uav1", 0.0, 1.0, 0.0}, "uav: found \"uav1\", expected none"},
      {"wind", {{}, "uav1", -1.0, 1.0, 0.0}, "delay"},
      {"wind", {{}, "uav1", std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0}, "delay"},
      {"wind", {{}, "uav1", 0.0, 0.0, 0.0}, "duration"},
      {"push", {{}, "uav1", 0.0, 1.0, 0.0}, "duration: expected 0: push happens at one instant"},
      {"odometry_lost", {{}, "uav1", 0.0, 1.0, 2.0}, "magnitude: expected 0"},
      {"wind", {{}, "uav1", 0.0, 1.0, 1e300}, "magnitude: expected the wind [m/s], a number in (0, 30]"},
      {"wind", {{}, "uav1", 0.0, 1.0, std::numeric_limits<double>::infinity()}, "magnitude"},
  };
  for (const auto& each : mistakes) {
    std::string mistake;
    EXPECT_FALSE(makeFaultInjection(each.kind, each.given, {"uav1", "uav2"}, mistake));
    EXPECT_NE(mistake.find(each.expected), std::string::npos) << mistake;
  }
}

TEST(Rehearsal, HasEveryKindAndLeavesTheEndInPeace) {
  const Scenario scenario = rehearsal(6, 3600.0, 7);
  std::vector<int> count(faultKinds().size(), 0);
  for (const FaultInjection& fault : scenario.faults) {
    ++count[static_cast<std::size_t>(fault.kind)];
    EXPECT_LT(fault.at + fault.duration, 3600.0 - 10.0);
  }
  for (std::size_t i = 0; i < count.size(); ++i) EXPECT_GE(count[i], 20) << faultKinds()[i].name;
  EXPECT_EQ(toYaml(scenario), toYaml(rehearsal(6, 3600.0, 7)));
  EXPECT_NE(toYaml(scenario), toYaml(rehearsal(6, 3600.0, 8)));
  EXPECT_THROW(rehearsal(0, 3600.0, 7), std::invalid_argument);
  EXPECT_THROW(rehearsal(6, 0.0, 7), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
