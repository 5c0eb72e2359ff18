// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The figures of a rehearsal: if these fail, a fault that nobody told of counts as told, or a UAV that stays on the
// ground as flying.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "swarm_planner/experiments/fault_report.hpp"
#include "swarm_planner/experiments/fault_watch.hpp"

namespace swarm_planner {
namespace {

constexpr double kPeriod = 0.3;  // of the cycles [s]

/// Three UAVs at rest whose reports the test writes.
class Scene : public CyclePlanner {
 public:
  explicit Scene(const std::vector<FaultInjection>& faults) : motions_(3) {
    report.uavs.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
      ScenarioUav uav;
      uav.name = "uav" + std::to_string(i + 1);
      uav.start = Vector3(10.0 * static_cast<double>(i), 0.0, 5.0);
      mission.scenario.uavs.push_back(uav);
      motions_[i].assignRest(-10.0, uav.start);
      vehicles.emplace_back(mission.parameters, uav.start, 0, i);
      report.uavs[i].planned = true;
      set(i, UavState::kTracking, Reason::kNone);
    }
    mission.scenario.faults = faults;
    watch.emplace(mission, *this);
  }

  const CycleReport& plan(const Snapshot&, double) override { return report; }
  const CommittedMotion& committed(std::size_t uav) const override { return motions_[uav]; }

  void set(std::size_t uav, UavState state, Reason reason) {
    report.uavs[uav].state = state;
    report.uavs[uav].reason = reason;
  }

  /// Cycles and samples until `t` [s].
  void flyTo(double t) {
    for (; kPeriod * cycle_ <= t; ++cycle_) {
      watch->onSample(kPeriod * cycle_, vehicles, {});
      watch->onCycle(kPeriod * (cycle_ + 1), report);
    }
  }

  FaultTally tally(FaultKind kind) const {
    for (const FaultTally& each : watch->summary().kinds) {
      if (each.kind == kind) return each;
    }
    return {};
  }

  Mission mission;
  CycleReport report;
  std::vector<QuadSimulator> vehicles;
  std::optional<FaultWatch> watch;

 private:
  std::vector<CommittedMotion> motions_;
  int cycle_ = -1;
};

const FaultInjection kLost = {FaultKind::kOdometryLost, "uav2", 3.0, 3.0, 0.0};

TEST(FaultWatch, TimesTheReportAndTheRecovery) {
  Scene scene({kLost});
  scene.flyTo(3.65);
  scene.set(1, UavState::kLost, Reason::kOdometryStale);
  scene.flyTo(7.25);
  scene.set(1, UavState::kTracking, Reason::kNone);
  scene.flyTo(20.0);
  const FaultTally tally = scene.tally(FaultKind::kOdometryLost);
  EXPECT_EQ(tally.injected, 1u);
  EXPECT_EQ(tally.noticeable, 1u);
  EXPECT_EQ(tally.reported, 1u);
  EXPECT_NEAR(tally.report_delay, 0.9, 1e-9);  // the cycle at 3.9 s
  EXPECT_EQ(tally.recovered, 1u);
  EXPECT_NEAR(tally.recovery_time, 1.8, 1e-9);  // planned at 7.5 s, flown from 7.8 s on
  EXPECT_TRUE(scene.watch->summary().misses.empty());
}

TEST(FaultWatch, MissesAFaultThatNobodyTellsOf) {
  Scene scene({kLost});
  scene.flyTo(20.0);
  const FaultSummary summary = scene.watch->summary();
  ASSERT_EQ(summary.misses.size(), 1u);
  EXPECT_TRUE(summary.misses[0].unreported);
  EXPECT_EQ(summary.misses[0].uav, "uav2");
  EXPECT_EQ(scene.tally(FaultKind::kOdometryLost).reported, 0u);
}

TEST(FaultWatch, AReportOfAnotherUavOrOfPlanningAloneOrTooLateIsNone) {
  for (const int what : {0, 1, 2}) {
    Scene scene({kLost});
    scene.flyTo(4.0);
    if (what == 0) scene.set(0, UavState::kLost, Reason::kOdometryStale);
    if (what == 1) scene.set(1, UavState::kFallback, Reason::kPlanRefused);
    if (what == 2) scene.flyTo(7.3);
    if (what == 2) scene.set(1, UavState::kLost, Reason::kOdometryStale);
    scene.flyTo(20.0);
    EXPECT_EQ(scene.tally(FaultKind::kOdometryLost).reported, 0u) << what;
  }
}

TEST(FaultWatch, TellsAUavThatNeverFliesAgain) {
  Scene scene({kLost});
  scene.flyTo(4.0);
  scene.set(1, UavState::kLost, Reason::kOdometryStale);
  scene.flyTo(60.0);
  const FaultSummary summary = scene.watch->summary();
  EXPECT_EQ(scene.tally(FaultKind::kOdometryLost).recovered, 0u);
  EXPECT_TRUE(std::isinf(summary.recovery_time));
  ASSERT_EQ(summary.misses.size(), 1u);
  EXPECT_FALSE(summary.misses[0].unreported);
}

TEST(FaultWatch, CountsFromTheEndOfTheLastOfOverlappingFaults) {
  Scene scene({kLost, {FaultKind::kWind, "uav2", 5.0, 4.0, 3.0}, {FaultKind::kWind, "uav1", 5.0, 8.0, 3.0}});
  scene.flyTo(4.0);
  scene.set(1, UavState::kLost, Reason::kOdometryStale);
  scene.flyTo(9.1);
  scene.set(1, UavState::kTracking, Reason::kNone);
  scene.flyTo(30.0);
  EXPECT_NEAR(scene.tally(FaultKind::kOdometryLost).recovery_time, 0.6, 1e-9);
  EXPECT_NEAR(scene.tally(FaultKind::kWind).recovery_time, 0.6, 0.2);
}

TEST(FaultWatch, WaitsForAllUavsAfterAFaultOfTheSwarm) {
  Scene scene({{FaultKind::kPlannerDead, "", 3.0, 3.0, 0.0}});
  scene.flyTo(4.0);
  for (std::size_t i = 0; i < 3; ++i) scene.set(i, UavState::kHolding, Reason::kWaitingForOthers);
  scene.flyTo(6.1);
  for (std::size_t i = 0; i < 2; ++i) scene.set(i, UavState::kTracking, Reason::kNone);
  scene.flyTo(20.0);
  EXPECT_EQ(scene.tally(FaultKind::kPlannerDead).recovered, 0u);
  scene.set(2, UavState::kTracking, Reason::kNone);
  scene.flyTo(21.0);
  EXPECT_EQ(scene.tally(FaultKind::kPlannerDead).recovered, 1u);
  EXPECT_GT(scene.tally(FaultKind::kPlannerDead).recovery_time, 14.0);
}

TEST(FaultWatch, DoesNotWaitForAUavThatAnObstacleStoppedBefore) {
  Scene scene({{FaultKind::kTracksLost, "", 3.0, 3.0, 0.0}});
  scene.set(2, UavState::kFallback, Reason::kPlanRefused);
  scene.flyTo(20.0);
  EXPECT_EQ(scene.tally(FaultKind::kTracksLost).recovered, 1u);
  EXPECT_LT(scene.tally(FaultKind::kTracksLost).recovery_time, 1.0);
}

TEST(FaultWatch, CountsAUavThatWaitsForAnObstacleByItself) {
  for (const bool waits : {true, false}) {
    Scene scene({{FaultKind::kTracksLost, "", 3.0, 3.0, 0.0}});
    scene.flyTo(5.0);
    scene.set(1, UavState::kFallback, Reason::kPlanRefused);
    scene.report.uavs[1].refusal = waits ? CheckReason::kRestingPlace : CheckReason::kUav;
    scene.flyTo(20.0);
    EXPECT_EQ(scene.watch->summary().waited, waits ? 1u : 0u);
    EXPECT_EQ(scene.tally(FaultKind::kTracksLost).recovered, waits ? 1u : 0u);
  }
}

TEST(FaultWatch, AVehicleHasToStrayForTwoCyclesToBeNoticeable) {
  for (const double away : {0.3, 3.0}) {
    for (const int cycles : {1, 2}) {
      Scene scene({{FaultKind::kWind, "uav1", 3.0, 4.0, 3.0}});
      scene.flyTo(3.1);
      scene.vehicles[0] = QuadSimulator(scene.mission.parameters, Vector3(away, 0.0, 5.0), 0, 0);
      scene.flyTo(3.1 + kPeriod * cycles);
      scene.vehicles[0] = QuadSimulator(scene.mission.parameters, Vector3(0.0, 0.0, 5.0), 0, 0);
      scene.flyTo(6.5);
      const bool noticeable = away > 1.0 && cycles > 1;
      EXPECT_EQ(scene.tally(FaultKind::kWind).noticeable, noticeable ? 1u : 0u) << away << ", " << cycles;
    }
  }
}

TEST(FaultReport, ShowsCountsAndMisses) {
  Scene scene({kLost});
  scene.flyTo(20.0);
  RunResult run;
  run.faults = scene.watch->summary();
  const std::string table = faultTable(scene.mission.scenario, run);
  EXPECT_NE(table.find("odometry_lost"), std::string::npos) << table;
  EXPECT_NE(table.find("odometry_lost of uav2 at 3.00 s: not reported"), std::string::npos) << table;
  JsonObject object;
  addFaults(run, object);
  EXPECT_NE(object.text().find("\"kind\": \"odometry_lost\", \"injected\": 1"), std::string::npos) << object.text();
  EXPECT_TRUE(faultTable(scene.mission.scenario, RunResult()).empty());
}

TEST(FaultReport, NamesWhatWentBeforeACollision) {
  Scene scene({kLost, {FaultKind::kPush, "uav3", 3.0, 0.0, 2.0}});
  EXPECT_EQ(faultsBefore({4.0, 0, false, 1}, scene.mission.scenario), ", after odometry_lost of uav2 at 3.00 s");
  EXPECT_EQ(faultsBefore({2.0, 0, false, 1}, scene.mission.scenario), "");
}

}  // namespace
}  // namespace swarm_planner
