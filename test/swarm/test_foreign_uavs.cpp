// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A UAV that another system flies goes where it likes: nobody may plan for it, everybody must keep clear of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "perfect_flight.hpp"
#include "support/random.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"
#include "swarm_planner/swarm/foreign_body.hpp"

namespace swarm_planner {
namespace {

/// Two UAVs that fly along x 10 m apart, and a third that another system flies, at rest at `place`.
Mission withExternal(const Vector3& place) {
  Mission mission = makeTestMission({Vector3(0, 0, 10), Vector3(0, 10, 10), place},
                                    {Vector3(90, 0, 10), Vector3(90, 10, 10), place}, 3.0);
  mission.scenario.uavs[2].external = true;
  return mission;
}

/// Flies the mission, UAV 2 from its start at `velocity`, seen unless `hidden`. Returns the least pair gauge of UAV 2
/// with the others.
double leastGauge(PerfectFlight& flight, const Mission& mission, const Vector3& velocity, int cycles, bool hidden) {
  double least = 1e9;
  for (int i = 0; i < cycles; ++i) {
    const double begin = flight.now();
    const auto where = [&](double t) { return Vector3(mission.scenario.uavs[2].start + t * velocity); };
    flight.cycle([&](Snapshot& snapshot) {
      snapshot.uavs[2] = {!hidden, snapshot.now, where(snapshot.now), velocity};
    });
    for (double t = begin + 0.3; t < begin + 0.6; t += 0.02) {
      for (const std::size_t uav : {0U, 1U}) {
        least = std::min(least, pairGauge(flight.vehicle(uav, t).p - where(t), mission.parameters.limits));
      }
    }
  }
  return least;
}

TEST(ForeignUav, IsNeitherPlannedForNorWaitedFor) {
  PerfectFlight flight(withExternal(Vector3(40, 5, 10)));
  const CycleReport& waiting = flight.cycle([](Snapshot& snapshot) { snapshot.uavs[2].received = false; });
  EXPECT_TRUE(waiting.started);
  EXPECT_EQ(waiting.uavs[2].reason, Reason::kWaitingForOdometry);
  for (int i = 0; i < 5; ++i) {
    const CycleReport& report = flight.cycle();
    EXPECT_FALSE(report.uavs[2].planned);
    EXPECT_EQ(report.uavs[2].state, UavState::kHolding);
    EXPECT_EQ(report.uavs[2].reason, Reason::kForeign);
    EXPECT_EQ(report.uavs[0].state, UavState::kTracking);
    EXPECT_EQ(report.uavs[1].state, UavState::kTracking);
  }
  EXPECT_TRUE(flight.planner().isForeign(2));
  EXPECT_FALSE(flight.planner().isForeign(0));
  EXPECT_THROW(flight.planner().setForeign(3, true), std::invalid_argument);
}

TEST(ForeignUav, OthersAreStillWaitedFor) {
  PerfectFlight flight(withExternal(Vector3(40, 5, 10)));
  EXPECT_FALSE(flight.cycle([](Snapshot& snapshot) { snapshot.uavs[1].received = false; }).started);
}

// Head on, at the closing speed of both.
TEST(ForeignUav, IsKeptClearOfWhereverItFlies) {
  for (const Vector3& velocity : {Vector3(-3, 0, 0), Vector3(-3, 0.5, 0), Vector3(-1, 0, 0.1)}) {
    const Mission mission = withExternal(Vector3(45, 0, 10));
    PerfectFlight flight(mission);
    EXPECT_GT(leastGauge(flight, mission, velocity, 60, false), 1.0) << velocity.transpose();
    EXPECT_GT(flight.vehicle(0).p.x(), 35.0) << "it does not pass";
  }
}

TEST(ForeignUav, ThatIsNotToldOfIsFlownInto) {
  Mission mission = withExternal(Vector3(45, 0, 10));
  mission.parameters.limits.avoidance = false;
  PerfectFlight flight(mission);
  EXPECT_LT(leastGauge(flight, mission, Vector3(-3, 0, 0), 60, false), 1.0);
}

// Its odometry has never come: the scenario says where it stands.
TEST(ForeignUav, IsAtItsStartUntilItIsSeen) {
  const Mission mission = withExternal(Vector3(30, 0.5, 10));
  PerfectFlight flight(mission);
  EXPECT_GT(leastGauge(flight, mission, Vector3::Zero(), 60, true), 1.0);
  EXPECT_GT(flight.vehicle(0).p.x(), 35.0) << "it does not pass";
}

TEST(ForeignUav, ContainsThePairEllipsoid) {
  Parameters parameters;
  parameters.limits.pair_distance_vertical = 3.0;
  const double reach = parameters.limits.uav_radius + parameters.limits.tracking_error;
  const UavMeasurement seen{true, 5.0, Vector3(1, 2, 3), Vector3(1, 0, 0)};
  const ForeignBody body = seenForeign(4, seen, parameters);
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 scaled = random.uniform(0.9, 1.0) * random.direction();
    const Vector3 d(2.0 * scaled.x(), 2.0 * scaled.y(), 3.0 * scaled.z());
    ASSERT_LT(body.shape.signedDistance(seen.p + d), reach + body.inflation.at(0.0)) << i;
  }
  // And no more than it has to: half a metre farther out is free.
  EXPECT_GT(body.shape.signedDistance(seen.p + Vector3(2.5, 0, 0)), reach + body.inflation.at(0.0));
  EXPECT_GT(body.shape.signedDistance(seen.p + Vector3(0, 0, 3.5)), reach + body.inflation.at(0.0));
}

TEST(ForeignUav, GrowsInDoubtUpToTheLimit) {
  const Parameters parameters;
  const UavMeasurement seen{true, 5.0, Vector3(1, 2, 3), Vector3(2, 0, 0)};
  const TrackInflation flying = seenForeign(0, seen, parameters).inflation;
  EXPECT_NEAR(flying.at(2.0) - flying.at(0.0), 2.0 * parameters.input.lost_growth_rate, 1e-12);
  EXPECT_NEAR(flying.at(1e6) - flying.at(0.0), parameters.input.lost_growth_limit, 1e-12);

  // Lost it stands, where it was to be when that was noticed, and may have flown on as fast as it did.
  const ForeignBody lost = unseenForeign(0, seen, parameters);
  EXPECT_EQ(lost.shape.velocity(), Vector3::Zero());
  EXPECT_LT((lost.shape.center() - Vector3(2, 2, 3)).norm(), 1e-12);
  EXPECT_NEAR(lost.inflation.at(0.5) - lost.inflation.at(0.0), 0.5 * (parameters.input.lost_growth_rate + 2.0), 1e-12);
  EXPECT_NEAR(lost.inflation.at(1e6) - lost.inflation.at(0.0), parameters.input.lost_growth_limit, 1e-12);
}

TEST(ForeignUav, WithoutGrowthOrRoomIsStillABody) {
  Parameters parameters;
  parameters.input.lost_growth_rate = 0.0;
  parameters.limits.pair_distance = parameters.limits.pair_distance_vertical = 0.2;
  const ForeignBody body = seenForeign(0, {true, 5.0, Vector3::Zero(), Vector3::Zero()}, parameters);
  EXPECT_EQ(body.inflation.at(1e6), body.inflation.at(0.0));
  EXPECT_GT(body.shape.radii().minCoeff(), 0.0);
}

// It hovers in the way and is lost there: it is not forgotten, and its doubt does not close the way for good.
TEST(ForeignUav, ThatIsLostIsNotForgotten) {
  const Mission mission = withExternal(Vector3(40, 0.5, 10));
  PerfectFlight flight(mission);
  leastGauge(flight, mission, Vector3::Zero(), 5, false);
  EXPECT_GT(leastGauge(flight, mission, Vector3::Zero(), 80, true), 1.5);
  EXPECT_EQ(flight.planner().report().uavs[2].state, UavState::kLost);
  EXPECT_GT(flight.vehicle(0).p.x(), 45.0) << "it does not pass";
}

// ---- Leaving and joining in flight

TEST(Leaving, KeepsWhatTheUavWasToFlyUntilItIsSeenElsewhere) {
  PerfectFlight flight(crossingPair());
  flight.cycles(10);
  flight.planner().setForeign(1, true);
  // It flies its last trajectory to its end.
  for (int i = 0; i < 30; ++i) {
    const CycleReport& report = flight.cycle();
    EXPECT_FALSE(report.uavs[1].planned);
    EXPECT_EQ(report.uavs[1].reason, Reason::kForeign);
    EXPECT_FALSE(isAlarm(report.uavs[0].reason)) << i;
  }
  EXPECT_GT(flight.leastPairGauge(), 1.0);
  EXPECT_GT(flight.vehicle(0).p.x(), 15.0);
}

/// UAV 1 of two abreast has left, or not, and turns to where UAV 0's target will be in 5 s. Returns the least gauge.
double leastGaugeWithTurn(bool leaves) {
  Mission mission = twoAbreast();
  if (!leaves) mission.parameters.input.lost_growth_rate = 0.0;
  PerfectFlight flight(mission);
  flight.cycles(10);
  if (leaves) flight.planner().setForeign(1, true);
  UavMeasurement left{true, flight.now(), flight.vehicle(1).p, Vector3::Zero()};
  left.v = (Vector3(3.0 * (flight.now() + 5.0), 0, 10) - left.p) / 5.0;
  double least = 1e9;
  for (int i = 0; i < 40; ++i) {
    const auto where = [&](double t) { return Vector3(left.p + (t - left.stamp) * left.v); };
    flight.cycle([&](Snapshot& snapshot) { snapshot.uavs[1] = {leaves, snapshot.now, where(snapshot.now), left.v}; });
    for (double t = flight.now(); t < flight.now() + 0.3; t += 0.02) {
      least = std::min(least, pairGauge(flight.vehicle(0, t).p - where(t), mission.parameters.limits));
    }
  }
  return least;
}

TEST(Leaving, LetsTheOthersGiveWayToWhatTheUavDoesThen) { EXPECT_GT(leastGaugeWithTurn(true), 1.0); }

TEST(Leaving, UntoldAndUnseenEndsInACollision) { EXPECT_LT(leastGaugeWithTurn(false), 1.0); }

TEST(Joining, IsPlannedForFromWhereItIsInTheNextCycle) {
  Mission mission = withExternal(Vector3(0, 20, 10));
  mission.scenario.uavs[2].reference = {Vector3(0, 20, 10), Vector3(90, 20, 10)};
  PerfectFlight flight(mission);
  const Vector3 velocity(2, 0, 0);
  leastGauge(flight, mission, velocity, 10, false);
  flight.planner().setForeign(2, false);
  const Vector3 place = mission.scenario.uavs[2].start + flight.now() * velocity;
  const CycleReport& report = flight.cycle([&](Snapshot& snapshot) {
    snapshot.uavs[2] = {true, snapshot.now, place, velocity};
  });
  EXPECT_EQ(report.uavs[2].state, UavState::kTracking);
  EXPECT_TRUE(report.uavs[2].planned);
  const KinematicState start = flight.planner().committed(2).at(report.epoch);
  EXPECT_LT((start.p - place - 0.3 * velocity).norm(), 1e-6) << "it jumps";
  EXPECT_LT((start.v - velocity).norm(), 1e-6);
  flight.cycles(40);
  EXPECT_EQ(flight.planner().report().uavs[2].reason, Reason::kNone);
  EXPECT_LT(flight.planner().report().uavs[2].lag, 5.0);
}

// Nobody knows where it is then but from before: that is kept clear of.
TEST(Joining, WithoutOdometryIsKeptClearOf) {
  const Mission mission = withExternal(Vector3(40, 0, 10));
  PerfectFlight flight(mission);
  leastGauge(flight, mission, Vector3::Zero(), 5, false);
  flight.planner().setForeign(2, false);
  EXPECT_GT(leastGauge(flight, mission, Vector3::Zero(), 80, true), 1.0);
  EXPECT_EQ(flight.planner().report().uavs[2].state, UavState::kLost);
}

}  // namespace
}  // namespace swarm_planner
