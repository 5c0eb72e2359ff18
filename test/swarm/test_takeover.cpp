// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// How a planner begins in flight: what it takes UAVs to do, where their targets go on, and what it waits for.
#include <gtest/gtest.h>

#include "perfect_flight.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"
#include "swarm_planner/swarm/takeover.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {
namespace {

constexpr double kPeriod = 0.3;

/// A flight of `cycles` cycles and what is needed to replace its planner.
struct Interrupted {
  explicit Interrupted(int cycles, const Mission& given = twoAbreast()) : mission(given), flight(given) {
    flight.cycles(cycles);
    remember(flight.planner(), 0, memory);
  }
  /// Odometry `gap` seconds after the last cycle.
  Snapshot snapshot(double gap) const {
    Snapshot result;
    result.now = flight.now() + gap;
    for (std::size_t i = 0; i < mission.scenario.uavs.size(); ++i) {
      const KinematicState state = flight.vehicle(i, result.now);
      result.uavs.push_back({true, result.now, state.p, state.v});
    }
    return result;
  }
  Mission mission;
  PerfectFlight flight;
  FlightMemory memory;
};

TEST(Takeover, GoesOnWithTheMotionsOnRecordAtOnce) {
  const Interrupted before(20);
  SwarmPlanner planner(before.mission);
  planner.takeOver(before.memory);
  const Snapshot snapshot = before.snapshot(1.0);
  const CycleReport& report = planner.plan(snapshot, snapshot.now + kPeriod);
  EXPECT_TRUE(report.started);
  EXPECT_EQ(report.time_zero, before.memory.time_zero) << "it is the same run";
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(report.uavs[i].state, UavState::kTracking);
    const KinematicState wanted = before.memory.uavs[i].newest.at(snapshot.now + kPeriod);
    const KinematicState start = planner.committed(i).after(0.0);
    EXPECT_LT((start.p - wanted.p).norm(), 1e-9);
    EXPECT_LT((start.v - wanted.v).norm(), 1e-9);
    EXPECT_LT((start.a - wanted.a).norm(), 1e-9);
  }
}

TEST(Takeover, FliesWhatTheVehicleHasIfTheNewestMotionNeverReachedIt) {
  Interrupted before(20);
  UavMemory& uav = before.memory.uavs[0];
  uav.motions = 2;
  uav.older = uav.newest;
  // Sent nowhere: to the side.
  StopManoeuvre stop;
  KinematicState aside = uav.newest.after(0.3);
  aside.v += Vector3(0, 1, 0);
  rollOutStop(aside, 10, 0.3, stop);
  uav.newest.assignStop(before.flight.now(), stop);
  SwarmPlanner planner(before.mission);
  planner.takeOver(before.memory);
  const Snapshot snapshot = before.snapshot(1.0);
  planner.plan(snapshot, snapshot.now + kPeriod);
  EXPECT_LT((planner.committed(0).after(0.0).p - uav.older.at(snapshot.now + kPeriod).p).norm(), 1e-9);
}

TEST(Takeover, DoesNotBelieveARecordThatOdometryContradicts) {
  const Interrupted before(20);
  SwarmPlanner planner(before.mission);
  planner.takeOver(before.memory);
  Snapshot snapshot = before.snapshot(1.0);
  snapshot.uavs[0].p += Vector3(0, -3, 0);  // somebody else has flown it there
  snapshot.uavs[0].v.setZero();
  planner.plan(snapshot, snapshot.now + kPeriod);
  EXPECT_LT((planner.committed(0).start() - snapshot.uavs[0].p).norm(), 1e-9);
  EXPECT_LT((planner.committed(1).start() - before.memory.uavs[1].newest.at(snapshot.now + kPeriod).p).norm(), 1e-9);
}

TEST(Takeover, OfAUavWithoutOdometryWarnsTheOthersOfItsMotion) {
  const Interrupted before(20, crossingPair());
  SwarmPlanner planner(before.mission);
  planner.takeOver(before.memory);
  Snapshot snapshot = before.snapshot(0.3);
  snapshot.uavs[1] = UavMeasurement();
  const CycleReport& report = planner.plan(snapshot, snapshot.now + kPeriod);
  EXPECT_EQ(report.uavs[0].state, UavState::kTracking) << "it must not wait for the other";
  EXPECT_EQ(report.uavs[1].state, UavState::kLost);
  EXPECT_FALSE(report.uavs[1].planned);
  EXPECT_LT(report.uavs[0].pair_distance, 40.0) << "it does not know of the other";
}

TEST(Takeover, WaitsForTheObstaclesThatWereKnown) {
  Interrupted before(20);
  before.memory.obstacles = 1;
  SwarmPlanner planner(before.mission);
  planner.takeOver(before.memory);
  Snapshot snapshot = before.snapshot(0.3);
  const CycleReport& report = planner.plan(snapshot, snapshot.now + kPeriod);
  EXPECT_EQ(report.uavs[0].reason, Reason::kTakingOver);
  EXPECT_EQ(report.uavs[0].state, UavState::kFallback);
  EXPECT_FALSE(report.uavs[0].planned) << "the vehicle knows better what it flies";
  // They come; or they do not, and it waits no longer.
  SwarmPlanner patient = std::move(planner);
  snapshot = before.snapshot(0.4 + Takeover::kPatience);
  EXPECT_EQ(patient.plan(snapshot, snapshot.now + kPeriod).uavs[0].state, UavState::kTracking);

  SwarmPlanner seeing(before.mission);
  seeing.takeOver(before.memory);
  snapshot = before.snapshot(0.3);
  TrackedObstacle track{
      Superellipsoid(1, Vector3(50, 50, 10), Vector3(1, 1, 1), Vector3(2, 2, 2), 0.0, Vector3(0, 0, 0))};
  track.stamp = snapshot.now;
  snapshot.obstacles.push_back(track);
  EXPECT_EQ(seeing.plan(snapshot, snapshot.now + kPeriod).uavs[0].state, UavState::kTracking);
}

TEST(Takeover, TargetsGoOnFromWhereTheUavsAre) {
  const Interrupted before(30);
  for (const bool memory : {true, false}) {
    SwarmPlanner planner(before.mission);
    if (memory) planner.takeOver(before.memory);
    double gap = 4.0;
    do {
      const Snapshot snapshot = before.snapshot(gap);
      planner.plan(snapshot, snapshot.now + kPeriod);
      gap += kPeriod;
    } while (!planner.report().uavs[0].planned && gap < 10.0);
    const double epoch = planner.report().epoch;
    const double foot = before.flight.vehicle(0, epoch).p.x();
    ASSERT_GT(foot, 20.0);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_GT(planner.target(i, epoch).arc_length, foot - 1.0) << "it flies back";
      EXPECT_LT(planner.target(i, epoch).arc_length, 3.0 * epoch + 1e-6) << "it jumps ahead";
      EXPECT_LT(planner.target(i, epoch).arc_length, foot + 5.0) << "it jumps ahead";
    }
  }
}

// The negative control: UAVs that hover where the scenario has them start are not in flight, and targets start where it
// says.
TEST(Takeover, TargetsStartAsTheScenarioSaysForUavsThatAreAtTheirStart) {
  Mission mission = twoAbreast();
  mission.scenario.uavs[0].reference = {Vector3(-30, 0, 10), Vector3(90, 0, 10)};
  SwarmPlanner planner(mission);
  const CycleReport& report = planner.plan(snapshotOf(mission, 1.0), 1.0 + kPeriod);
  EXPECT_EQ(report.uavs[0].state, UavState::kTracking) << "nothing to wait for";
  EXPECT_DOUBLE_EQ(planner.target(0, 1.0 + kPeriod).arc_length, 0.0);
}

TEST(Takeover, WithoutARecordTakesUavsInFlightToBrake) {
  const Interrupted before(10);
  SwarmPlanner planner(before.mission);
  double waited = 0.0;
  while (waited < 5.0) {
    const Snapshot snapshot = before.snapshot(waited);
    if (planner.plan(snapshot, snapshot.now + kPeriod).started) break;
    EXPECT_EQ(planner.report().uavs[0].reason, Reason::kTakingOver);
    waited += kPeriod;
  }
  EXPECT_GE(waited, Takeover::kPatience);
  EXPECT_LT(waited, Takeover::kPatience + 2 * kPeriod);
  const double epoch = planner.report().epoch;
  EXPECT_LT((planner.committed(0).at(epoch).p - before.flight.vehicle(0, epoch).p).norm(), 0.03);
  EXPECT_LT((planner.committed(0).at(epoch).v - before.flight.vehicle(0, epoch).v).norm(), 0.2);
}

// Who stands in another one's way may not fly what was planned: waiting is not safe then.
TEST(Takeover, DoesNotWaitWhileOneFliesIntoAnother) {
  const Mission mission = twoAbreast();
  for (const double ahead : {4.0, 12.0}) {
    SwarmPlanner planner(mission);
    Snapshot snapshot = snapshotOf(mission, 100.0);
    snapshot.uavs[0].p = Vector3(30, 0, 10);
    snapshot.uavs[0].v = Vector3(3, 0, 0);
    snapshot.uavs[1].p = Vector3(30 + ahead, 0.5, 10);
    snapshot.uavs[1].v.setZero();
    const CycleReport& report = planner.plan(snapshot, 100.0 + kPeriod);
    const bool is_urgent = ahead < 3.0 * Takeover::kUrgent;
    EXPECT_EQ(report.started, is_urgent);
    EXPECT_EQ(report.uavs[0].planned, is_urgent);
    if (!is_urgent) continue;
    for (double t = 0.0; t < 10.0; t += 0.1) {
      const Vector3 apart = planner.committed(0).after(t).p - planner.committed(1).after(t).p;
      EXPECT_GT(pairGauge(apart, mission.parameters.limits), 1.0) << t;
    }
  }
}

TEST(Takeover, DoesNotWaitForGoodForAUavThatIsLost) {
  const Interrupted before(10);
  SwarmPlanner planner(before.mission);
  for (double waited = 0.0; waited <= Takeover::kPatience + kPeriod; waited += kPeriod) {
    Snapshot snapshot = before.snapshot(waited);
    snapshot.uavs[1] = UavMeasurement();
    planner.plan(snapshot, snapshot.now + kPeriod);
  }
  EXPECT_EQ(planner.report().uavs[0].state, UavState::kTracking);
  EXPECT_EQ(planner.report().uavs[1].state, UavState::kLost);
  // On the ground, at their starts, all are waited for.
  SwarmPlanner grounded(before.mission);
  for (double now = 0.0; now < 5.0; now += kPeriod) {
    Snapshot snapshot = snapshotOf(before.mission, now);
    snapshot.uavs[1] = UavMeasurement();
    EXPECT_FALSE(grounded.plan(snapshot, now + kPeriod).started);
  }
}

TEST(Takeover, SeesAccelerationInThreeMeasurements) {
  const KinematicState x{Vector3(1, 2, 3), Vector3(2, -1, 0.5), Vector3(0.3, 1.0, -0.2)};
  const Vector3 j(1.0, -2.0, 0.5);
  ObservedFlight flight;
  const LimitParameters limits;
  for (const double t : {0.0, 0.3, 0.55}) {
    const KinematicState at = propagate(x, j, t);
    EXPECT_TRUE(flight.count() == 3 || flight.jerk(limits).isZero());
    flight.add({true, t, at.p, at.v});
    flight.add({true, t, Vector3(9, 9, 9), at.v});  // not newer
  }
  EXPECT_LT((flight.state(limits).a - propagate(x, j, 0.55).a).norm(), 1e-12);
  EXPECT_LT((flight.state(limits).p - propagate(x, j, 0.55).p).norm(), 1e-12);
  EXPECT_LT((flight.jerk(limits) - j).norm(), 1e-12);
}

// One that starts smoothly is as far on before it is as fast.
TEST(ObservedFlight, DoesNotTakeAPushForAFlightThatGoesOn) {
  const LimitParameters limits;
  for (const double before : {0.1, 0.4}) {
    ObservedFlight flight;
    flight.add({true, 0.0, Vector3::Zero(), Vector3::Zero()});
    flight.add({true, 0.3, Vector3::Zero(), Vector3(before, 0, 0)});
    flight.add({true, 0.6, Vector3(0.3, 0, 0), Vector3(1.2, 0, 0)});
    EXPECT_EQ(flight.state(limits).a.isZero(0.0), before < 0.25);
    EXPECT_EQ(flight.jerk(limits).isZero(0.0), before < 0.25);
    EXPECT_EQ(flight.state(limits).v, Vector3(1.2, 0, 0));
  }
}

}  // namespace
}  // namespace swarm_planner
