// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// One UAV's sensor must neither ground nor endanger the others, and its UAV must come back without a jump.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "perfect_flight.hpp"

namespace swarm_planner {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A way to spoil one UAV's odometry, and what the planner is to say of it.
struct Spoiling {
  std::string name;
  std::function<void(UavMeasurement&)> spoil;
  Reason reason;
};

class SpoiltOdometry : public ::testing::TestWithParam<Spoiling> {};

TEST_P(SpoiltOdometry, StopsThePlansOfThatUavAloneUntilItIsBack) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(10);
  const auto spoil = [](Snapshot& snapshot) { GetParam().spoil(snapshot.uavs[1]); };
  for (int i = 0; i < 5; ++i) {
    const CycleReport& report = flight.cycle(spoil);
    EXPECT_EQ(report.uavs[1].state, UavState::kLost);
    EXPECT_EQ(report.uavs[1].reason, GetParam().reason);
    EXPECT_FALSE(report.uavs[1].planned);
    EXPECT_EQ(report.uavs[0].state, UavState::kTracking);
    EXPECT_TRUE(report.uavs[0].planned);
    EXPECT_TRUE(flight.planner().committed(0).isFinite());
  }
  const CycleReport& report = flight.cycle();
  EXPECT_EQ(report.uavs[1].state, UavState::kTracking);
  EXPECT_TRUE(report.uavs[1].planned);
  EXPECT_LT((flight.planner().committed(1).start() - flight.vehicle(1).p).norm(), 1e-6) << "it jumps";
}

// It flies its last plan on: whoever crosses its way has to know.
TEST_P(SpoiltOdometry, LeavesTheOthersAwareOfItsLastPlan) {
  PerfectFlight flight(crossingPair());
  flight.cycles(10);
  const auto spoil = [](Snapshot& snapshot) { GetParam().spoil(snapshot.uavs[1]); };
  for (int i = 0; i < 20; ++i) flight.cycle(spoil);
  EXPECT_GT(flight.leastPairGauge(), 1.0);
  EXPECT_GT(flight.vehicle(0).p.x(), 3.0) << "it waits for good";
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, SpoiltOdometry,
    ::testing::Values(Spoiling{"Nan", [](UavMeasurement& m) { m.p.y() = kNan; }, Reason::kOdometryNotFinite},
                      Spoiling{"NanVelocity", [](UavMeasurement& m) { m.v.z() = kNan; }, Reason::kOdometryNotFinite},
                      Spoiling{"Infinite", [](UavMeasurement& m) { m.v.x() = -kInfinity; }, Reason::kOdometryNotFinite},
                      Spoiling{"NanStamp", [](UavMeasurement& m) { m.stamp = kNan; }, Reason::kOdometryNotFinite},
                      Spoiling{"Stale", [](UavMeasurement& m) { m.stamp -= 0.6; }, Reason::kOdometryStale},
                      Spoiling{"Future", [](UavMeasurement& m) { m.stamp += 1.0; }, Reason::kOdometryFromFuture},
                      Spoiling{"Gone", [](UavMeasurement& m) { m = UavMeasurement(); }, Reason::kWaitingForOdometry}),
    [](const auto& instance) { return instance.param.name; });

TEST(Odometry, SlightlyOldOrAheadIsUsed) {
  for (const double shift : {-0.45, 0.04}) {
    PerfectFlight flight(twoAbreast());
    for (int i = 0; i < 35; ++i) {
      const CycleReport& report = flight.cycle([&](Snapshot& snapshot) {
        snapshot.uavs[1].stamp += shift;
        snapshot.uavs[1].p += shift * snapshot.uavs[1].v;
      });
      // Once at a steady speed the velocity of then is that of now.
      if (i < 30) continue;
      EXPECT_EQ(report.uavs[1].state, UavState::kTracking) << shift << ": " << reasonText(report.uavs[1].reason);
    }
  }
}

// Odometry is always a little older than the newest plan's epoch: it shows how the plan before was flown. A UAV that
// tracks perfectly must not be believed to deviate.
TEST(Odometry, FromBeforeTheNewestPlanIsHeldAgainstTheOneBefore) {
  constexpr double kAge = 0.1;
  PerfectFlight flight(twoAbreast());
  flight.planner().setReference(0, {Vector3(0, 0, 10), Vector3(6, 0, 10), Vector3(6, 30, 10)}, 0.0, 3.0);
  flight.cycles(2);
  CommittedMotion before = flight.planner().committed(0);
  flight.cycle();
  for (int i = 0; i < 20; ++i) {
    const CommittedMotion newest = flight.planner().committed(0);
    const double epoch = flight
                             .cycle([&](Snapshot& snapshot) {
                               const double stamp = snapshot.now - kAge;
                               snapshot.uavs[0] = {true, stamp, before.at(stamp).p, before.at(stamp).v};
                             })
                             .epoch;
    const KinematicState start = flight.planner().committed(0).after(0.0);
    EXPECT_LT((start.p - newest.at(epoch).p).norm(), 1e-9);
    EXPECT_LT((start.v - newest.at(epoch).v).norm(), 1e-9);
    before = newest;
  }
}

// Finite and impossible: a state estimator that diverges.
TEST(Odometry, OfAbsurdSizeDoesNotTouchTheOthers) {
  for (const double absurd : {1e9, 1e30, 1e300}) {
    PerfectFlight flight(twoAbreast());
    flight.cycles(5);
    for (int i = 0; i < 5; ++i) {
      const CycleReport& report = flight.cycle([&](Snapshot& snapshot) {
        snapshot.uavs[1].p.x() = absurd;
        snapshot.uavs[1].v.y() = -absurd;
      });
      EXPECT_EQ(report.uavs[0].state, UavState::kTracking) << absurd;
      EXPECT_EQ(report.uavs[1].reason, Reason::kOdometryNotFinite) << absurd;
      EXPECT_TRUE(flight.planner().committed(0).isFinite()) << absurd;
    }
    EXPECT_NEAR(flight.vehicle(0).p.y(), 0.0, 0.5) << absurd;
  }
}

// Longer than its plan: it has come to rest at the plan's end by then.
TEST(Odometry, BackAfterALongTimeIsPlannedFromWhereTheUavIs) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(10);
  for (int i = 0; i < 50; ++i) flight.cycle([](Snapshot& snapshot) { snapshot.uavs[1].received = false; });
  const Vector3 rest = flight.vehicle(1).p;
  flight.cycle();
  EXPECT_LT((flight.planner().committed(1).start() - rest).norm(), 1e-6);
  EXPECT_LT(flight.planner().committed(1).after(0.0).v.norm(), 1e-6);
  flight.cycles(60);
  EXPECT_LT(flight.planner().report().uavs[1].lag, 5.0) << "it does not catch up";
}

// The others must know that a UAV without odometry rests at its plan's end, and not think it on its way for ever.
TEST(Odometry, LostForLongLeavesTheOthersAwareOfWhereTheUavRests) {
  Mission mission =
      makeTestMission({Vector3(0, 0, 10), Vector3(-12, 0, 10)}, {Vector3(90, 0, 10), Vector3(90, 0, 10)}, 3.0);
  PerfectFlight flight(mission);
  flight.cycles(15);
  // Exactly in line, and kept ever farther off, the follower waits until its target is far enough beyond.
  for (int i = 0; i < 100; ++i) flight.cycle([](Snapshot& snapshot) { snapshot.uavs[0].received = false; });
  EXPECT_GT(flight.leastPairGauge(), 1.0) << "the follower flew into the UAV that had stopped";
  EXPECT_GT(flight.vehicle(1).p.x(), flight.vehicle(0).p.x() + 3.0) << "the follower never passed";
}

}  // namespace
}  // namespace swarm_planner
