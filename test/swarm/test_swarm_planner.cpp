// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The planner as whoever feeds it sees it. If these fail, a swarm does not start, one UAV's sensor grounds or endangers
// all others, or UAVs collide.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "perfect_flight.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"

namespace swarm_planner {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Path = std::vector<Vector3>;

/// Two UAVs on parallel lines, 10 m apart.
Mission twoAbreast() {
  return makeTestMission({Vector3(0, 0, 10), Vector3(0, 10, 10)}, {Vector3(90, 0, 10), Vector3(90, 10, 10)}, 3.0);
}

/// Two UAVs that meet at (0, 0, 10) at a right angle.
Mission crossingPair() {
  return makeTestMission({Vector3(-20, 0, 10), Vector3(0, -20, 10)}, {Vector3(20, 0, 10), Vector3(0, 20, 10)}, 3.0);
}

Snapshot snapshotOf(const Mission& mission, double now) {
  Snapshot snapshot;
  snapshot.now = now;
  for (const ScenarioUav& uav : mission.scenario.uavs) snapshot.uavs.push_back({true, now, uav.start, Vector3::Zero()});
  return snapshot;
}

bool identical(const Trajectory& a, const Trajectory& b) {
  bool same = a.epoch == b.epoch && a.dt == b.dt;
  for (std::size_t k = 0; k < kHorizon; ++k) same = same && a.jerks[k] == b.jerks[k];
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    same = same && a.knots[k].p == b.knots[k].p && a.knots[k].v == b.knots[k].v && a.knots[k].a == b.knots[k].a;
  }
  return same;
}

// ---- Start ----------------------------------------------------------------------------------------------------------

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
    EXPECT_EQ(planner.committed(i).epoch, 10.6);
    EXPECT_EQ(planner.committed(i).dt, mission.parameters.time.sampling_time);
    EXPECT_LT((planner.committed(i).knots.front().p - mission.scenario.uavs[i].start).norm(), 1e-12);
    EXPECT_GT(planner.committed(i).knots.back().p.x(), 5.0) << "it does not set off";
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

// ---- One UAV's odometry ---------------------------------------------------------------------------------------------

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
    EXPECT_TRUE(flight.planner().committed(0).knots.back().p.allFinite());
  }
  const CycleReport& report = flight.cycle();
  EXPECT_EQ(report.uavs[1].state, UavState::kTracking);
  EXPECT_TRUE(report.uavs[1].planned);
  EXPECT_LT((flight.planner().committed(1).knots.front().p - flight.vehicle(1).p).norm(), 1e-6) << "it jumps";
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
  PerfectFlight flight(twoAbreast());
  flight.cycles(3);
  for (const double shift : {-0.45, 0.04}) {
    const CycleReport& report = flight.cycle([&](Snapshot& snapshot) {
      snapshot.uavs[1].stamp += shift;
      snapshot.uavs[1].p += shift * snapshot.uavs[1].v;
    });
    EXPECT_EQ(report.uavs[1].state, UavState::kTracking) << shift;
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
      EXPECT_TRUE(flight.planner().committed(0).knots.back().p.allFinite()) << absurd;
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
  EXPECT_LT((flight.planner().committed(1).knots.front().p - rest).norm(), 1e-6);
  EXPECT_LT(flight.planner().committed(1).knots.front().v.norm(), 1e-6);
  flight.cycles(60);
  EXPECT_LT(flight.planner().report().uavs[1].lag, 5.0) << "it does not catch up";
}

// The others must know that a UAV without odometry rests at its plan's end, and not think it on its way for ever.
TEST(Odometry, LostForLongLeavesTheOthersAwareOfWhereTheUavRests) {
  Mission mission =
      makeTestMission({Vector3(0, 0, 10), Vector3(-12, 0, 10)}, {Vector3(90, 0, 10), Vector3(90, 0, 10)}, 3.0);
  PerfectFlight flight(mission);
  flight.cycles(15);
  for (int i = 0; i < 60; ++i) flight.cycle([](Snapshot& snapshot) { snapshot.uavs[0].received = false; });
  EXPECT_GT(flight.leastPairGauge(), 1.0) << "the follower flew into the UAV that had stopped";
  EXPECT_GT(flight.vehicle(1).p.x(), flight.vehicle(0).p.x() + 3.0) << "the follower never passed";
}

// ---- Time and references --------------------------------------------------------------------------------------------

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

TEST(SetReference, RefusesWhatCannotBeFlown) {
  SwarmPlanner planner(twoAbreast());
  const Path good{Vector3(0, 0, 10), Vector3(9, 0, 10)};
  const double length = planner.reference(0).path.length();
  EXPECT_THROW(planner.setReference(2, good, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(planner.setReference(0, {}, 0.0, 1.0), std::invalid_argument);
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

// ---- Many UAVs ------------------------------------------------------------------------------------------------------

TEST(Swarm, UavsOnTopOfEachOtherPart) {
  PerfectFlight flight(
      makeTestMission({Vector3(0, 0, 10), Vector3(0, 0, 10)}, {Vector3(0, 0, 10), Vector3(0, 0, 10)}, 0.0));
  const CycleReport& first = flight.cycle();
  for (const UavReport& uav : first.uavs) {
    EXPECT_EQ(uav.state, UavState::kFallback);
    EXPECT_EQ(uav.reason, Reason::kConstraintsViolated);
    EXPECT_GT(uav.max_slack, 1.0);
  }
  flight.cycles(30);
  EXPECT_GT((flight.vehicle(0).p - flight.vehicle(1).p).norm(), 2.0);
}

TEST(Swarm, CrossesWithoutCollisionAndOnlyByAvoidance) {
  PerfectFlight avoiding(makeMission(crossing(), {}, "crossing"));
  avoiding.cycles(110);
  EXPECT_GT(avoiding.leastPairGauge(), 1.0);
  for (const UavReport& uav : avoiding.planner().report().uavs) EXPECT_LT(std::abs(uav.lag), 1.0) << "stuck";

  PerfectFlight heedless(makeMission(crossing(), {{"avoidance", false}}, "crossing"));
  heedless.cycles(110);
  EXPECT_LT(heedless.leastPairGauge(), 0.5) << "nothing there to avoid: the test above shows nothing";
}

TEST(Swarm, MeetingHeadOnPassEachOther) {
  const Path west_east{Vector3(-15, 0, 10), Vector3(15, 0, 10)};
  const Path up_down{Vector3(0, 0, 10), Vector3(0, 0, 40)};
  const Path oblique{Vector3(-10, 4, 5), Vector3(10, -4, 17)};
  for (const Path& way : {west_east, up_down, oblique}) {
    PerfectFlight flight(makeTestMission({way[0], way[1]}, {way[1], way[0]}, 3.0));
    flight.cycles(70);
    EXPECT_GT(flight.leastPairGauge(), 1.0) << way[0].transpose();
    EXPECT_LT((flight.vehicle(0).p - way[1]).norm(), 0.5) << way[0].transpose();
    EXPECT_LT((flight.vehicle(1).p - way[0]).norm(), 0.5) << way[0].transpose();
  }
}

TEST(Swarm, AFasterUavOvertakesASlowerOne) {
  Mission mission =
      makeTestMission({Vector3(0, 0, 10), Vector3(8, 0, 10)}, {Vector3(100, 0, 10), Vector3(100, 0, 10)}, 4.0);
  mission.scenario.uavs[1].target.speed = 1.0;
  PerfectFlight flight(mission);
  flight.cycles(70);
  EXPECT_GT(flight.leastPairGauge(), 1.0);
  EXPECT_GT(flight.vehicle(0).p.x(), flight.vehicle(1).p.x() + 10.0) << "it stays behind";
}

/// A flight along x with an obstacle that crosses its way and is there when the UAV is.
Mission obstacleCrossing(bool avoidance) {
  Mission mission = makeTestMission({Vector3(0, 0, 10)}, {Vector3(60, 0, 10)}, 3.0);
  ScenarioObstacle obstacle;
  obstacle.center = Vector3(24, -16, 10);
  obstacle.radii = Vector3(2, 2, 4);
  obstacle.exponents = Vector3(2, 3, 4.5);
  obstacle.velocity = Vector3(0, 2, 0);
  mission.scenario.obstacles.push_back(obstacle);
  mission.parameters.limits.avoidance = avoidance;
  return mission;
}

TEST(Swarm, AvoidsAnObstacleInMotionAndOnlyByAvoidance) {
  PerfectFlight avoiding(obstacleCrossing(true));
  avoiding.cycles(60);
  EXPECT_GT(avoiding.leastObstacleDistance(), LimitParameters().uav_radius);
  EXPECT_GT(avoiding.vehicle(0).p.x(), 35.0);
  PerfectFlight heedless(obstacleCrossing(false));
  heedless.cycles(60);
  EXPECT_LT(heedless.leastObstacleDistance(), 0.0);
}

TEST(Swarm, ReportsClearancesOfItsPlans) {
  Mission mission = twoAbreast();
  ScenarioObstacle obstacle;
  obstacle.center = Vector3(10, -6, 10);
  obstacle.radii = Vector3::Constant(2.0);
  mission.scenario.obstacles.push_back(obstacle);
  PerfectFlight flight(mission);
  const CycleReport& report = flight.cycle();
  EXPECT_NEAR(report.uavs[0].pair_distance, 10.0, 0.2);
  EXPECT_NEAR(report.uavs[0].obstacle_clearance, 4.0 - LimitParameters().uav_radius, 0.3);
}

// The same inputs give the same plans, bit by bit: a run can be repeated to find out what happened.
TEST(Swarm, IsDeterministic) {
  const Mission mission = makeMission(circleSwap(6, 8.0, 1), {}, "circle_swap");
  PerfectFlight first(mission);
  PerfectFlight second(mission);
  for (int cycle = 0; cycle < 25; ++cycle) {
    first.cycle();
    second.cycle();
    for (std::size_t i = 0; i < 6; ++i) {
      ASSERT_TRUE(identical(first.planner().committed(i), second.planner().committed(i))) << cycle << " " << i;
    }
  }
}

// Without avoidance every plan is that of the UAV alone: the order or number of the others must not matter.
TEST(Swarm, UavsFarApartDoNotInfluenceEachOther) {
  PerfectFlight together(
      makeTestMission({Vector3(0, 0, 10), Vector3(0, 500, 10)}, {Vector3(30, 5, 10), Vector3(30, 500, 10)}, 3.0));
  PerfectFlight alone(makeTestMission({Vector3(0, 0, 10)}, {Vector3(30, 5, 10)}, 3.0));
  for (int cycle = 0; cycle < 10; ++cycle) {
    together.cycle();
    alone.cycle();
    ASSERT_TRUE(identical(together.planner().committed(0), alone.planner().committed(0)));
  }
}

TEST(Swarm, CanBeMoved) {
  const Mission mission = twoAbreast();
  SwarmPlanner planner(mission);
  planner.plan(snapshotOf(mission, 0.0), 0.3);
  SwarmPlanner moved = std::move(planner);
  EXPECT_TRUE(moved.plan(snapshotOf(mission, 0.3), 0.6).uavs[0].planned);
}

}  // namespace
}  // namespace swarm_planner
