// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A UAV that is not seen, or not where it should be: the others must keep clear of wherever it may be, nobody else may
// be stopped, and it must come back without a jump.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "perfect_flight.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {
namespace {

using Tamper = std::function<void(Snapshot&)>;

void lose(Snapshot& snapshot) { snapshot.uavs[0].received = false; }

/// Two UAVs that hover side by side.
Mission hoveringPair(double distance) {
  const Vector3 first(0, 0, 10);
  const Vector3 second(distance, 0, 10);
  return makeTestMission({first, second}, {first, second}, 0.0);
}

// ---- Odometry that cannot be planned from (the kinds without a memory: test_odometry_faults.cpp)

/// UAV 1's odometry is spoilt for 15 cycles in flight: told each time from `after` cycles on, and nothing else changes.
void expectTold(const Tamper& spoil, Reason reason, int after) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(10);
  EXPECT_EQ(flight.planner().report().uavs[1].reason, Reason::kNone);
  for (int i = 0; i < 15; ++i) {
    const CycleReport& report = flight.cycle(spoil);
    EXPECT_EQ(report.uavs[0].state, UavState::kTracking) << i;
    if (i < after) continue;
    EXPECT_EQ(report.uavs[1].state, UavState::kLost) << i;
    EXPECT_EQ(report.uavs[1].reason, reason) << i;
    EXPECT_FALSE(report.uavs[1].planned) << i;
  }
  const Vector3 place = flight.vehicle(1).p;
  for (int i = 0; i < 2; ++i) flight.cycle();
  EXPECT_EQ(flight.planner().report().uavs[1].state, UavState::kTracking) << "it does not come back within two cycles";
  EXPECT_LT((flight.vehicle(1).p - place).norm(), 0.6 * 5.0);
}

TEST(Odometry, ThatIsFrozenIsTold) {
  std::optional<UavMeasurement> held;
  expectTold(
      [&held](Snapshot& snapshot) {
        if (!held) held = snapshot.uavs[1];
        held->stamp = snapshot.now;
        snapshot.uavs[1] = *held;
      },
      Reason::kOdometryFrozen, 1);
}

TEST(Odometry, ThatKeepsJumpingIsTold) {
  double side = 20.0;
  expectTold([&side](Snapshot& snapshot) { snapshot.uavs[1].p.y() += (side = -side); }, Reason::kOdometryJumps, 0);
}

// Carried elsewhere while it hovered without noise, and told to stay there: that is no frozen odometry.
TEST(Odometry, OfAUavThatWasCarriedElsewhereAndStaysIsUsed) {
  PerfectFlight flight(hoveringPair(20.0));
  flight.cycles(10);
  const Vector3 place(0, 0.8, 10);
  flight.planner().setReference(0, {place}, 0.0, 0.0);
  flight.cycle([&](Snapshot& snapshot) { snapshot.uavs[0].p = place; });
  for (int i = 0; i < 20; ++i) EXPECT_EQ(flight.cycle().uavs[0].state, UavState::kTracking) << i;
  EXPECT_LT((flight.vehicle(0).p - place).norm(), 0.01);
}

// ---- What the others do

/// UAV 0 is seen no more and drifts towards UAV 1 at 0.25 m/s, up to 1.8 m. Returns the least pair gauge of the two.
double leastGaugeWithDrift(double growth_rate) {
  Mission mission = hoveringPair(2.5);
  mission.parameters.input.lost_growth_rate = growth_rate;
  PerfectFlight flight(mission);
  flight.cycles(5);
  const double lost = flight.now();
  double least = 1e9;
  for (int i = 0; i < 50; ++i) {
    flight.cycle(lose);
    for (double t = flight.now(); t < flight.now() + 0.3; t += 0.05) {
      const Vector3 drift(std::min(0.25 * (t - lost), 1.8), 0, 0);
      const Vector3 apart = flight.vehicle(1, t).p - flight.vehicle(0, t).p - drift;
      least = std::min(least, pairGauge(apart, mission.parameters.limits));
    }
    EXPECT_FALSE(isAlarm(flight.planner().report().uavs[1].reason)) << i;
  }
  return least;
}

TEST(LostUav, ThatDriftsOffWithinTheGrowthIsKeptClearOf) { EXPECT_GT(leastGaugeWithDrift(0.3), 1.0); }

TEST(LostUav, WithoutTheGrowthIsFlownInto) { EXPECT_LT(leastGaugeWithDrift(0.0), 1.0); }

// One that is seen is not: nobody moves.
TEST(LostUav, AloneMakesTheOthersGiveWay) {
  PerfectFlight flight(hoveringPair(2.5));
  flight.cycles(20);
  EXPECT_LT((flight.vehicle(1).p - Vector3(2.5, 0, 10)).norm(), 0.02);
  for (int i = 0; i < 50; ++i) flight.cycle(lose);
  EXPECT_GT((flight.vehicle(1).p - flight.vehicle(0).p).norm(), 4.0);
  flight.cycles(30);
  EXPECT_LT((flight.vehicle(1).p - Vector3(2.5, 0, 10)).norm(), 0.1) << "it does not come back once the other is seen";
}

// In the densest place: what is demanded more must not take away what flies.
TEST(LostUav, InACrowdRaisesNoAlarmAndGroundsNobody) {
  PerfectFlight flight(crossingPair());
  flight.cycles(14);  // just before they meet
  for (int i = 0; i < 40; ++i) {
    const CycleReport& report = flight.cycle(lose);
    EXPECT_FALSE(isAlarm(report.uavs[1].reason)) << i;
    EXPECT_NE(report.uavs[1].reason, Reason::kBraking) << i;
  }
  EXPECT_GT(flight.leastPairGauge(), 1.0);
  EXPECT_LT(flight.planner().report().uavs[1].lag, 1.0) << "it does not pass";
}

/// UAV 0 hovers and was measured `offset` m off its place when it was seen last; UAV 1 flies past there, 3 m from that
/// place. Returns how close it comes to 1.4 m off it.
double leastDistancePast(double offset) {
  const Vector3 place(20, 0, 10);
  Mission mission = makeTestMission({place, Vector3(0, 3, 10)}, {place, Vector3(60, 3, 10)}, 3.0);
  mission.parameters.input.lost_growth_rate = 0.0;
  PerfectFlight flight(mission);
  flight.cycles(3);
  flight.cycle([&](Snapshot& snapshot) { snapshot.uavs[0].p.y() += offset; });
  double least = 1e9;
  for (int i = 0; i < 50; ++i) {
    flight.cycle(lose);
    for (double t = flight.now(); t < flight.now() + 0.3; t += 0.05) {
      least = std::min(least, (flight.vehicle(1, t).p - place - Vector3(0, 1.4, 0)).norm());
    }
  }
  EXPECT_GT(flight.vehicle(1).p.x(), 30.0) << "it does not pass";
  return least;
}

TEST(LostUav, IsKeptClearOfWhereItWasSeenLastToo) {
  EXPECT_GT(leastDistancePast(1.4), 2.0);
  EXPECT_LT(leastDistancePast(0.0), 2.0) << "nothing was at stake";
}

/// UAV 0 flies 6 m ahead of UAV 1 and is seen no more, or on and on. Returns how close UAV 1 comes to where the other
/// would have stopped then.
double leastDistanceFromTheStop(const Tamper& tamper) {
  PerfectFlight flight(
      makeTestMission({Vector3(6, 0, 10), Vector3(0, 0, 10)}, {Vector3(60, 0, 10), Vector3(60, 0, 10)}, 3.0));
  flight.cycles(6);
  const Vector3 stop = flight.vehicle(0).p + 0.5 * flight.vehicle(0).v;
  EXPECT_GT(flight.vehicle(0).v.x(), 2.0);
  double least = 1e9;
  for (int i = 0; i < 20; ++i) {
    flight.cycle(tamper);
    for (double t = flight.now(); t < flight.now() + 0.3; t += 0.05) {
      least = std::min(least, (flight.vehicle(1, t).p - stop).norm());
    }
    EXPECT_FALSE(isAlarm(flight.planner().report().uavs[1].reason)) << i;
  }
  return least;
}

// Autopilots stop that do not know where they are.
TEST(LostUav, MayHaveStoppedOnItsOwnAndIsKeptClearOf) {
  const double distance = hoveringPair(5.0).parameters.limits.pair_distance;
  EXPECT_GT(leastDistanceFromTheStop(lose), distance);
  EXPECT_LT(leastDistanceFromTheStop(nullptr), 0.5 * distance) << "nothing was at stake";
}

// ---- Off its plan

/// UAV 1 is measured `offset` m beside where it is to be, whatever it is told: with so much noise that may be. Returns
/// how often that was told.
int timesOffPlan(double offset, int cycles) {
  Mission mission = twoAbreast();
  mission.parameters.input.odometry_noise = 0.5;
  PerfectFlight flight(mission);
  flight.cycles(10);
  int told = 0;
  for (int i = 0; i < cycles; ++i) {
    UavMeasurement seen;
    const CycleReport& report = flight.cycle([&](Snapshot& snapshot) {
      snapshot.uavs[1].p.y() += offset * std::min(0.25 * (i + 1), 1.0);
      snapshot.uavs[1].v.setZero();  // not known: it would have to fit an offset that no wind makes
      seen = snapshot.uavs[1];
    });
    EXPECT_EQ(report.uavs[0].state, UavState::kTracking) << i;
    if (report.uavs[1].reason != Reason::kOffPlan) continue;
    ++told;
    EXPECT_NEAR(report.uavs[1].deviation, offset, 0.1);
    const Vector3 place = seen.p + (report.epoch - seen.stamp) * seen.v;
    EXPECT_LT((flight.planner().committed(1).at(report.epoch).p - place).norm(), 1e-6) << "not planned from there";
  }
  return told;
}

TEST(OffPlan, IsToldWithTheDistanceAndPlannedFromWhereTheUavIs) { EXPECT_GE(timesOffPlan(2.0, 12), 1); }

TEST(OffPlan, IsNotToldOfAUavThatStraysALittleOrForAMoment) {
  EXPECT_EQ(timesOffPlan(0.8, 20), 0);
  EXPECT_EQ(timesOffPlan(2.0, 5), 0);
}

// ---- Coming back

/// UAV 1 is lost for `cycles` cycles in flight and found `offset` off its motion. Returns how far from where it is
/// measured, carried on at its velocity, its new plan starts [m].
double jumpOnReturn(const Vector3& offset, int cycles) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(10);
  for (int i = 0; i < cycles; ++i) flight.cycle([](Snapshot& snapshot) { snapshot.uavs[1].received = false; });
  UavMeasurement seen;
  const CycleReport& report = flight.cycle([&](Snapshot& snapshot) {
    snapshot.uavs[1].p += offset;
    seen = snapshot.uavs[1];
  });
  EXPECT_EQ(report.uavs[1].state, UavState::kTracking);
  EXPECT_TRUE(report.uavs[1].planned);
  const Vector3 expected = seen.p + (report.epoch - seen.stamp) * seen.v;
  return (flight.planner().committed(1).at(report.epoch).p - expected).norm();
}

TEST(Return, OnItsMotionStartsWhereTheUavIs) {
  // While it flies on at constant speed, and later, when it has begun to brake: what braking takes off the way is
  // small.
  EXPECT_LT(jumpOnReturn(Vector3::Zero(), 3), 0.05);
  EXPECT_LT(jumpOnReturn(Vector3::Zero(), 40), 0.01);
  const double error = makeTestMission({}, {}, 0.0).parameters.limits.tracking_error;
  EXPECT_LT(jumpOnReturn(Vector3(0, error, 0), 40), error + 0.01);
}

TEST(Return, OffItsMotionStartsWhereTheUavIs) {
  for (const int cycles : {1, 5, 40}) EXPECT_LT(jumpOnReturn(Vector3(0, 0.9, 0.3), cycles), 1e-6) << cycles;
}

// It has stopped while its target flew 60 m on: what it is asked for then is within its limits.
TEST(Return, FarBehindItsTargetAsksForNothingWild) {
  const Mission mission = twoAbreast();
  PerfectFlight flight(mission);
  flight.cycles(10);
  for (int i = 0; i < 80; ++i) flight.cycle([](Snapshot& snapshot) { snapshot.uavs[1].received = false; });
  double fastest = 0.0;
  double least_lag = 1e9;
  for (int i = 0; i < 60; ++i) {
    const CycleReport& report = flight.cycle();
    if (i == 0) {
      EXPECT_GT(report.uavs[1].lag, 50.0);
    }
    EXPECT_EQ(report.uavs[1].state, UavState::kTracking) << i;
    const CommittedMotion& motion = flight.planner().committed(1);
    for (double t = 0.0; t < motion.duration(); t += 0.05) {
      const KinematicState x = motion.after(t);
      fastest = std::max(fastest, x.v.norm());
      EXPECT_LE(x.v.norm(), mission.parameters.limits.max_speed + 1e-6);
      EXPECT_LE((x.a + 9.81 * Vector3::UnitZ()).norm(), 2.0 * 9.81 + 1.0);
    }
    for (int k = 0; k < motion.pieces(); ++k) EXPECT_LE(motion.jerk(k).norm(), mission.parameters.limits.max_jerk);
    least_lag = std::min(least_lag, report.uavs[1].lag);
  }
  EXPECT_GT(fastest, 4.0) << "it does not hurry";
  EXPECT_LT(least_lag, 30.0) << "it does not catch up";
}

// ---- What it does itself

/// A ball of 2 m that comes along x at 1 m/s and is at `passing` at 15 s.
ScenarioObstacle ballPast(const Vector3& passing) {
  ScenarioObstacle ball;
  ball.id = 1;
  ball.center = passing - Vector3(15, 0, 0);
  ball.radii = Vector3::Constant(2.0);
  ball.velocity = Vector3(1, 0, 0);
  return ball;
}

/// UAV 0 hovers, and its odometry is lost after a second; then the ball is seen that passes `aside` of it.
/// Returns how far it goes from its place, and the least room between it and the ball in `room` [m].
double dodges(double aside, double& room) {
  const Vector3 place(0, 0, 10);
  Mission mission = makeTestMission({place}, {place}, 0.0);
  mission.scenario.obstacles = {ballPast(place + Vector3(0, aside, 0))};
  PerfectFlight flight(mission);
  flight.cycles(4);
  double farthest = 0.0;
  for (int i = 0; i < 90; ++i) {
    const CycleReport& report = flight.cycle(lose);
    EXPECT_EQ(report.uavs[0].state, UavState::kLost) << i;
    EXPECT_FALSE(isAlarm(report.uavs[0].reason)) << i;
    EXPECT_TRUE(report.uavs[0].planned || report.uavs[0].reason != Reason::kEvadesUnseen) << "its vehicle has to know";
    farthest = std::max(farthest, (flight.vehicle(0).p - place).norm());
  }
  room = flight.leastObstacleDistance() - mission.parameters.limits.uav_radius;
  return farthest;
}

TEST(LostUav, GivesWayToWhatComesWhereItRests) {
  double room = 0.0;
  EXPECT_GT(dodges(0.5, room), 0.5);
  EXPECT_GT(room, 0.0) << "it has been hit where it was to rest";
  EXPECT_EQ(dodges(6.0, room), 0.0) << "nothing comes: its motion stays as it is";
}

}  // namespace
}  // namespace swarm_planner
