// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The planner as whoever starts and directs it sees it. If these fail, a swarm does not start, flies an old reference
// or does not survive a jump of time.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "perfect_flight.hpp"
#include "support/flight_problem.hpp"

namespace swarm_planner {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Path = std::vector<Vector3>;

TEST(Start, WaitsForEveryUavsOdometryAndSaysWhy) {
  const Mission mission = twoAbreast();
  SwarmPlanner planner(mission);
  Snapshot snapshot = snapshotOf(mission, 10.0);
  snapshot.uavs[1].received = false;
  const CycleReport& report = planner.plan(snapshot, 10.3);
  EXPECT_FALSE(report.started);
  EXPECT_EQ(report.uavs[0].state, UavState::kHolding);
  EXPECT_EQ(report.uavs[0].reason, Reason::kWaitingForOthers);
  EXPECT_EQ(report.uavs[1].state, UavState::kHolding);
  EXPECT_EQ(report.uavs[1].reason, Reason::kWaitingForOdometry);
  for (const UavReport& uav : report.uavs) EXPECT_FALSE(uav.planned);
}

TEST(Start, WaitsWhileOdometryIsUnusable) {
  const Mission mission = twoAbreast();
  SwarmPlanner planner(mission);
  Snapshot snapshot = snapshotOf(mission, 10.0);
  snapshot.uavs[1].stamp = 9.0;
  const CycleReport& report = planner.plan(snapshot, 10.3);
  EXPECT_FALSE(report.started);
  EXPECT_EQ(report.uavs[1].state, UavState::kHolding);
  EXPECT_EQ(report.uavs[1].reason, Reason::kOdometryStale);
}

TEST(Start, WaitsForASnapshotOfAllUavs) {
  const Mission mission = twoAbreast();
  SwarmPlanner planner(mission);
  Snapshot snapshot = snapshotOf(mission, 10.0);
  snapshot.uavs.pop_back();
  EXPECT_FALSE(planner.plan(snapshot, 10.3).started);
  EXPECT_EQ(planner.report().uavs[1].reason, Reason::kWaitingForOdometry);
  snapshot.uavs.clear();
  EXPECT_FALSE(planner.plan(snapshot, 10.3).started);
}

TEST(Start, WaitsForTheOperatorWithoutAutostart) {
  Mission mission = twoAbreast();
  mission.parameters.input.autostart = false;
  SwarmPlanner planner(mission);
  for (int i = 0; i < 3; ++i) {
    const CycleReport& report = planner.plan(snapshotOf(mission, 10.0 + i), 10.3 + i);
    EXPECT_FALSE(report.started);
    for (const UavReport& uav : report.uavs) EXPECT_EQ(uav.reason, Reason::kWaitingForStart);
  }
}

TEST(Start, IsTheFirstEpochAfterAllOdometryHasArrived) {
  const Mission mission = twoAbreast();
  SwarmPlanner planner(mission);
  Snapshot snapshot = snapshotOf(mission, 10.0);
  snapshot.uavs[1].received = false;
  planner.plan(snapshot, 10.3);
  const CycleReport& report = planner.plan(snapshotOf(mission, 10.3), 10.6);
  EXPECT_TRUE(report.started);
  EXPECT_EQ(report.time_zero, 10.6);
  EXPECT_EQ(report.epoch, 10.6);
  EXPECT_EQ(report.cycle, 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(report.uavs[i].state, UavState::kTracking);
    EXPECT_EQ(report.uavs[i].reason, Reason::kNone);
    EXPECT_TRUE(report.uavs[i].planned);
    EXPECT_EQ(planner.committed(i).epoch(), 10.6);
    EXPECT_EQ(planner.committed(i).dt(), mission.parameters.time.sampling_time);
    EXPECT_LT((planner.committed(i).start() - mission.scenario.uavs[i].start).norm(), 1e-12);
    EXPECT_GT(planner.committed(i).restingPlace().x(), 5.0) << "it does not set off";
    EXPECT_LT((planner.target(i, 11.6).p - mission.scenario.uavs[i].start - Vector3(3, 0, 0)).norm(), 1e-9);
  }
  planner.plan(snapshotOf(mission, 10.6), 10.9);
  EXPECT_EQ(planner.report().time_zero, 10.6) << "the run's time zero stays";
}

TEST(Start, NamesTheUavsOfTheScenario) {
  const SwarmPlanner planner(twoAbreast());
  EXPECT_EQ(planner.uavCount(), 2U);
  EXPECT_EQ(planner.uavName(0), "uav1");
  EXPECT_EQ(planner.uavName(1), "uav2");
}

TEST(Start, TargetRestsAtItsStartBefore) {
  const SwarmPlanner planner(twoAbreast());
  for (const double t : {-5.0, 0.0, 100.0}) {
    EXPECT_EQ(planner.target(0, t).p, Vector3(0, 0, 10)) << t;
    EXPECT_EQ(planner.target(0, t).v, Vector3::Zero()) << t;
  }
}

TEST(Start, OnOneUavAloneFliesItsReference) {
  PerfectFlight flight(makeTestMission({Vector3(0, 0, 10)}, {Vector3(15, 0, 10)}, 3.0));
  flight.cycles(40);
  EXPECT_LT((flight.vehicle(0).p - Vector3(15, 0, 10)).norm(), 0.2);
  EXPECT_EQ(flight.planner().report().uavs[0].pair_distance, kInfinity);
  EXPECT_EQ(flight.planner().report().uavs[0].obstacle_clearance, kInfinity);
  EXPECT_NEAR(flight.planner().report().uavs[0].lag, 0.0, 0.2);
}

TEST(Start, OfAPlanIsTheMeasurementItselfWithoutLatencyCompensation) {
  for (const bool compensated : {true, false}) {
    Mission mission = twoAbreast();
    mission.parameters.limits.latency_compensation = compensated;
    SwarmPlanner planner(mission);
    planner.plan(snapshotOf(mission, 10.0), 10.3);
    const CommittedMotion before = planner.committed(0);
    Snapshot late = snapshotOf(mission, 10.3);
    late.uavs[0] = {true, 10.1, Vector3(0.5, 0.1, 10.0), Vector3(2.0, 0.0, 0.0)};
    planner.plan(late, 10.6);
    const KinematicState start = planner.committed(0).after(0.0);
    EXPECT_EQ((start.p - late.uavs[0].p).norm() < 1e-12, !compensated);
    EXPECT_EQ((start.v - late.uavs[0].v).norm() < 1e-12, !compensated) << "but for rounding in the motion's points";
    EXPECT_LT((start.a - before.at(10.6).a).norm(), 1e-12) << "odometry has no acceleration";
  }
}

// Time of day in seconds: what a real clock gives must fly as a simulation's does.
TEST(Start, AtALargeTimeFliesTheSame) {
  PerfectFlight small(twoAbreast());
  PerfectFlight large(twoAbreast(), 1.7e9);
  small.cycles(30);
  large.cycles(30);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((small.vehicle(i).p - large.vehicle(i).p).norm(), 1e-4);
  PerfectFlight crossing(crossingPair(), 1.7e9);
  crossing.cycles(30);
  EXPECT_GT(crossing.leastPairGauge(), 1.0);
}

TEST(Reset, ForgetsPlansAndStartsAnew) {
  const Mission mission = twoAbreast();
  PerfectFlight flight(mission);
  flight.cycles(20);
  SwarmPlanner& planner = flight.planner();
  planner.reset();
  EXPECT_FALSE(planner.report().started);
  // A bag played again: the same vehicles back at their starts, at an earlier time.
  Snapshot snapshot = snapshotOf(mission, 1.0);
  snapshot.uavs[0].received = false;
  EXPECT_FALSE(planner.plan(snapshot, 1.3).started) << "odometry from before does not count";
  const CycleReport& report = planner.plan(snapshotOf(mission, 1.3), 1.6);
  EXPECT_TRUE(report.started);
  EXPECT_EQ(report.time_zero, 1.6);
  SwarmPlanner fresh(mission);
  fresh.plan(snapshotOf(mission, 1.3), 1.6);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(identical(planner.committed(i), fresh.committed(i)));
}

TEST(Reset, KeepsReferencesThatWereSetLater) {
  PerfectFlight flight(twoAbreast());
  flight.planner().setReference(0, {Vector3(0, 0, 10), Vector3(0, 0, 30)}, 1.0, 2.0);
  flight.cycles(5);
  flight.planner().reset();
  EXPECT_EQ(flight.planner().reference(0).path.length(), 20.0);
  EXPECT_EQ(flight.planner().target(0, 99.0).p, Vector3(0, 0, 11)) << "its target waits for the next start";
}

TEST(SetReference, SendsTheUavThereFromTheNextEpochOn) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(5);
  flight.planner().setReference(0, {Vector3(0, -20, 10), Vector3(0, -20, 10), Vector3(20, -20, 10)}, 2.0, 1.0);
  EXPECT_EQ(flight.planner().target(0, flight.now() + 5.0).p, Vector3(2, -20, 10)) << "not before the next epoch";
  const double epoch = flight.cycle().epoch;
  EXPECT_LT((flight.planner().target(0, epoch + 3.0).p - Vector3(5, -20, 10)).norm(), 1e-9);
  EXPECT_EQ(flight.planner().reference(0).time_zero, epoch);
  flight.cycles(120);
  EXPECT_LT((flight.vehicle(0).p - Vector3(20, -20, 10)).norm(), 0.3);
  EXPECT_NEAR(flight.vehicle(1).p.y(), 10.0, 0.3) << "the other one's reference is its own";
}

TEST(SetReference, FindsItsPlaceOnTheNewReference) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(40);
  const Vector3 here = flight.vehicle(0).p;
  ASSERT_GT(here.x(), 20.0);
  flight.planner().setReference(0, {here, here + Vector3(-80, 0, 0)}, 0.0, 1.0);
  EXPECT_LT(std::abs(flight.cycle().uavs[0].lag), 2.0) << "it is held against a far part of the new reference";
}

TEST(SetReference, RefusesWhatCannotBeFlown) {
  SwarmPlanner planner(twoAbreast());
  const Path good{Vector3(0, 0, 10), Vector3(9, 0, 10)};
  const double length = planner.reference(0).path.length();
  EXPECT_THROW(planner.setReference(2, good, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(planner.setReference(0, {}, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(planner.setReference(0, {Vector3(0, 1e8, 0)}, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(planner.setReference(0, good, 0.0, 1e300), std::invalid_argument);
  const std::vector<Vector3> long_path(10001, Vector3(1, 2, 3));
  EXPECT_THROW(planner.setReference(0, long_path, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(planner.setReference(0, {Vector3(0, kNan, 0)}, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(planner.setReference(0, {Vector3(0, 0, 0), Vector3(kInfinity, 0, 0)}, 0.0, 1.0), std::invalid_argument);
  for (const double bad : {-1.0, kNan, kInfinity}) {
    EXPECT_THROW(planner.setReference(0, good, bad, 1.0), std::invalid_argument) << bad;
    EXPECT_THROW(planner.setReference(0, good, 0.0, bad), std::invalid_argument) << bad;
  }
  EXPECT_EQ(planner.reference(0).path.length(), length) << "a refused reference must change nothing";
  EXPECT_NO_THROW(planner.setReference(0, good, 0.0, 0.0));
}

TEST(SetReference, OfLengthZeroMeansStay) {
  PerfectFlight flight(makeTestMission({Vector3(0, 0, 10)}, {Vector3(0, 0, 10)}, 3.0));
  flight.cycles(20);
  EXPECT_LT((flight.vehicle(0).p - Vector3(0, 0, 10)).norm(), 1e-3);
  flight.planner().setReference(0, {Vector3(5, 5, 12)}, 0.0, 3.0);
  flight.cycles(40);
  EXPECT_LT((flight.vehicle(0).p - Vector3(5, 5, 12)).norm(), 0.1);
}

}  // namespace
}  // namespace swarm_planner
