// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Commands to UAVs in flight. If these fail, a UAV flies on after a stop, is not where the operator thinks, or never
// goes on again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "perfect_flight.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {
namespace {

constexpr double kPeriod = 0.3;  // of a cycle with the default parameters [s]

Mission oneUav(double speed = 4.0) { return makeTestMission({Vector3(0, 0, 10)}, {Vector3(400, 0, 10)}, speed); }

/// Cycles until every UAV is slower than 0.05 m/s; at most 100.
int cyclesToRest(PerfectFlight& flight) {
  for (int cycle = 1; cycle <= 100; ++cycle) {
    flight.cycle();
    bool rests = true;
    for (std::size_t i = 0; i < flight.planner().uavCount(); ++i) rests = rests && flight.vehicle(i).v.norm() < 0.05;
    if (rests) return cycle;
  }
  return 101;
}

TEST(Hold, BrakesWithinSecondsAndStays) {
  PerfectFlight flight(oneUav());
  flight.cycles(20);
  ASSERT_GT(flight.vehicle(0).v.norm(), 3.5);
  EXPECT_EQ(flight.planner().command(0, FlightCommand::kHold).text, "brakes and holds");
  EXPECT_LE(cyclesToRest(flight) * kPeriod, 5.0);
  const Vector3 place = flight.vehicle(0).p;
  flight.cycles(40);
  EXPECT_LT((flight.vehicle(0).p - place).norm(), 0.1);
  const UavReport& report = flight.planner().report().uavs[0];
  EXPECT_EQ(report.state, UavState::kHolding);
  EXPECT_EQ(report.reason, Reason::kHeld);
  EXPECT_TRUE(report.planned) << "it still gets setpoints";
}

TEST(Hold, PausesTheMissionThatStartGoesOnWith) {
  PerfectFlight flight(oneUav());
  flight.cycles(20);
  const double paused = flight.planner().target(0, flight.now()).arc_length;
  ASSERT_GT(paused, 10.0);
  flight.planner().command(0, FlightCommand::kHold);
  flight.cycles(30);
  EXPECT_NEAR(flight.planner().target(0, flight.now()).arc_length, paused, 1e-9);
  EXPECT_EQ(flight.planner().command(0, FlightCommand::kStart).text, "goes on with its mission");
  flight.cycle();
  EXPECT_NEAR(flight.planner().target(0, flight.now()).arc_length, paused, 1e-9) << "from the next epoch on";
  flight.cycles(20);
  EXPECT_NEAR(flight.planner().target(0, flight.now()).arc_length, paused + 20 * kPeriod * 4.0, 1e-6);
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kTracking);
  EXPECT_LT(std::abs(flight.planner().report().uavs[0].lag), 2.0) << "it caught up";
}

// A sphere comes at the UAV. `avoidance` off: the negative control.
double leastDistanceWhileHolding(bool avoidance, FlightCommand command) {
  Mission mission = makeTestMission({Vector3(0, 0, 10)}, {Vector3(30, 0, 10)}, 3.0);
  mission.parameters.limits.avoidance = avoidance;
  ScenarioObstacle obstacle;
  obstacle.center = Vector3(55, 0.3, 10);
  obstacle.radii = Vector3(1, 1, 1);
  obstacle.velocity = Vector3(-3, 0, 0);
  mission.scenario.obstacles.push_back(obstacle);
  PerfectFlight flight(mission);
  flight.cycles(5);
  flight.planner().command(0, command);
  flight.cycles(90);
  EXPECT_LT(flight.vehicle(0).v.norm(), 0.05) << "it comes to rest again";
  return flight.leastObstacleDistance();
}

TEST(Hold, GivesWayToWhatComesAndOnlyByAvoidance) {
  EXPECT_GE(leastDistanceWhileHolding(true, FlightCommand::kHold), LimitParameters().uav_radius);
  EXPECT_LT(leastDistanceWhileHolding(false, FlightCommand::kHold), 0.0);
}

TEST(Stop, GivesWayToWhatComesAndOnlyByAvoidance) {
  EXPECT_GE(leastDistanceWhileHolding(true, FlightCommand::kStop), LimitParameters().uav_radius);
  EXPECT_LT(leastDistanceWhileHolding(false, FlightCommand::kStop), 0.0);
}

TEST(Stop, IsShorterThanAHoldAndStays) {
  PerfectFlight holding(oneUav());
  PerfectFlight stopping(oneUav());
  holding.cycles(20);
  stopping.cycles(20);
  const double from = holding.vehicle(0).p.x();
  holding.planner().command(0, FlightCommand::kHold);
  stopping.planner().command(0, FlightCommand::kStop);
  const int hold_cycles = cyclesToRest(holding);
  const int stop_cycles = cyclesToRest(stopping);
  EXPECT_LT(stop_cycles, hold_cycles);
  EXPECT_LE(stop_cycles * kPeriod, 2.5);
  EXPECT_LT(stopping.vehicle(0).p.x() - from, holding.vehicle(0).p.x() - from - 0.5);
  const Vector3 place = stopping.vehicle(0).p;
  stopping.cycles(40);
  EXPECT_LT((stopping.vehicle(0).p - place).norm(), 1e-6);
  EXPECT_EQ(stopping.planner().report().uavs[0].state, UavState::kStopped);
  EXPECT_EQ(stopping.planner().report().uavs[0].reason, Reason::kStopped);
  EXPECT_EQ(stopping.planner().command(0, FlightCommand::kHold).text, "is stopped and stays so");
  stopping.planner().command(0, FlightCommand::kStart);
  stopping.cycles(20);
  EXPECT_GT(stopping.vehicle(0).v.norm(), 3.0);
}

// The quickest stop ends where an obstacle will be: something else has to fly, and the operator is not told a lie.
TEST(Stop, DoesNotEndInTheWayOfAnObstacle) {
  Mission mission = oneUav();
  ScenarioObstacle obstacle;
  obstacle.center = Vector3(26, -36, 10);
  obstacle.radii = Vector3(2.5, 2.5, 4);
  obstacle.velocity = Vector3(0, 3, 0);
  mission.scenario.obstacles.push_back(obstacle);
  PerfectFlight flight(mission);
  flight.cycles(20);
  StopManoeuvre quickest;
  planStop(flight.planner().committed(0).at(flight.now() + kPeriod), kPeriod, FlightBounds(mission.parameters, nullptr),
           quickest);
  double least = 1.0;
  for (double t = flight.now(); t < flight.now() + 15.0; t += 0.1) {
    least = std::min(least, flight.obstacle(0, t).signedDistance(quickest.restingPlace()));
  }
  ASSERT_LT(least, 0.0) << "the quickest stop would do: this shows nothing";
  flight.planner().command(0, FlightCommand::kStop);
  flight.cycles(80);
  EXPECT_GE(flight.leastObstacleDistance(), LimitParameters().uav_radius);
  EXPECT_LT(flight.vehicle(0).v.norm(), 0.05);
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kStopped);
}

TEST(Leave, EndsPlanningAndJoinTakesItUpAgain) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(5);
  EXPECT_EQ(flight.planner().command(0, FlightCommand::kLeave).text, "gets no more setpoints; others avoid it");
  flight.cycles(20);
  EXPECT_FALSE(flight.planner().report().uavs[0].planned);
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kHolding);
  EXPECT_EQ(flight.planner().report().uavs[0].reason, Reason::kForeign);
  EXPECT_TRUE(flight.planner().report().uavs[1].planned);
  EXPECT_FALSE(flight.planner().command(0, FlightCommand::kHold).accepted);
  const Vector3 place = flight.vehicle(0).p;
  flight.planner().command(0, FlightCommand::kJoin);
  flight.cycle();
  EXPECT_EQ(flight.planner().mode(0), FlightMode::kFlying) << "as the other one does";
  EXPECT_LT((flight.planner().committed(0).start() - place).norm(), 0.1) << "from its odometry";
  flight.cycles(30);
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kTracking);
}

TEST(Leave, OthersStillAvoidTheUav) {
  // The first one rests in the way of the second.
  Mission mission =
      makeTestMission({Vector3(0, 0, 10), Vector3(-20, 0.2, 10)}, {Vector3(0, 0, 10), Vector3(20, 0.2, 10)}, 3.0);
  PerfectFlight flight(mission);
  flight.planner().setForeign(0, true);
  flight.cycles(70);
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  EXPECT_GT(flight.vehicle(1).p.x(), 19.0);
  mission.parameters.limits.avoidance = false;
  PerfectFlight heedless(mission);
  heedless.planner().setForeign(0, true);
  heedless.cycles(70);
  EXPECT_LT(heedless.leastPairGauge(), 0.5);
}

TEST(Join, HoldsInASwarmThatHolds) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(5);
  flight.planner().command(0, FlightCommand::kLeave);
  flight.planner().command(1, FlightCommand::kHold);
  flight.cycles(10);
  EXPECT_EQ(flight.planner().command(0, FlightCommand::kJoin).mode, FlightMode::kHolding);
}

TEST(Commands, AreKeptWhileOdometryIsLost) {
  PerfectFlight flight(oneUav());
  flight.cycles(20);
  const auto lose = [](Snapshot& snapshot) { snapshot.uavs[0].stamp -= 5.0; };
  flight.cycle(lose);
  ASSERT_EQ(flight.planner().report().uavs[0].state, UavState::kLost);
  const CommandAnswer answer = flight.planner().command(0, FlightCommand::kHold);
  EXPECT_TRUE(answer.accepted);
  EXPECT_EQ(answer.text, "brakes and holds; its odometry is lost: once that is back");
  for (int cycle = 0; cycle < 3; ++cycle) flight.cycle(lose);
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kLost);
  EXPECT_LE(cyclesToRest(flight) * kPeriod, 5.0);
  EXPECT_EQ(flight.planner().report().uavs[0].reason, Reason::kHeld);
}

TEST(Commands, WaitForTheStartOfTheRun) {
  Mission mission = twoAbreast();
  mission.parameters.input.autostart = false;
  PerfectFlight flight(mission);
  flight.cycles(3);
  EXPECT_FALSE(flight.planner().report().started);
  EXPECT_EQ(flight.planner().report().uavs[0].reason, Reason::kWaitingForStart);
  // One of two: the other waits on, without setpoints.
  EXPECT_TRUE(flight.planner().command(0, FlightCommand::kStart).accepted);
  flight.cycles(10);
  EXPECT_TRUE(flight.planner().report().started);
  EXPECT_GT(flight.vehicle(0).v.norm(), 1.0);
  EXPECT_FALSE(flight.planner().report().uavs[1].planned);
  EXPECT_EQ(flight.planner().report().uavs[1].reason, Reason::kWaitingForStart);
  flight.planner().command(1, FlightCommand::kStart);
  EXPECT_EQ(flight.planner().target(1, flight.now()).arc_length, 0.0);
  flight.cycles(10);
  EXPECT_GT(flight.vehicle(1).v.norm(), 1.0);
}

// Broken off near the ground a landing leaves the UAV below the workspace: it holds there all the same.
TEST(Hold, BelowTheWorkspaceIsNoFault) {
  Mission mission = makeTestMission({Vector3(0, 0, 5)}, {Vector3(0, 0, 5)}, 0.0);
  mission.scenario.workspace = Workspace{Vector3(-10, -10, 2), Vector3(10, 10, 20)};
  PerfectFlight flight(mission);
  flight.planner().command(0, FlightCommand::kLand);
  while (flight.vehicle(0).p.z() > 1.2 && flight.now() < 30.0) flight.cycle();
  flight.planner().command(0, FlightCommand::kHold);
  flight.cycles(30);
  EXPECT_EQ(flight.planner().report().uavs[0].reason, Reason::kHeld);
  EXPECT_NEAR(flight.vehicle(0).p.z(), 0.6, 0.6);
  EXPECT_LT(flight.vehicle(0).v.norm(), 0.05);
}

// Odometry of one UAV never comes: without it nobody would ever start.
TEST(Commands, AUavThatIsNotThereCanLeave) {
  PerfectFlight flight(twoAbreast());
  const auto lose = [](Snapshot& snapshot) { snapshot.uavs[1].received = false; };
  for (int cycle = 0; cycle < 5; ++cycle) flight.cycle(lose);
  EXPECT_FALSE(flight.planner().report().started);
  flight.planner().command(1, FlightCommand::kLeave);
  flight.cycle(lose);
  EXPECT_TRUE(flight.planner().report().started);
  EXPECT_TRUE(flight.planner().report().uavs[0].planned);
}

TEST(Commands, SurviveABackwardJumpOfTime) {
  PerfectFlight flight(oneUav());
  flight.cycles(20);
  flight.planner().command(0, FlightCommand::kHold);
  flight.cycles(20);
  const Vector3 place = flight.vehicle(0).p;
  flight.planner().reset();
  flight.cycles(20);
  EXPECT_EQ(flight.planner().mode(0), FlightMode::kHolding);
  EXPECT_LT((flight.vehicle(0).p - place).norm(), 0.1);
  flight.planner().command(0, FlightCommand::kStart);
  flight.cycle();
  const double foot = flight.planner().progress(0);
  EXPECT_GT(foot, 10.0);
  EXPECT_NEAR(flight.planner().target(0, flight.now()).arc_length, foot, 1.5) << "targets go on where the UAVs are";
}

TEST(Commands, ANewReferenceIsKeptUntilTheUavFlies) {
  PerfectFlight flight(oneUav());
  flight.cycles(10);
  flight.planner().command(0, FlightCommand::kHold);
  flight.cycles(10);
  const Vector3 place = flight.vehicle(0).p;
  flight.planner().setReference(0, {place, place + Vector3(0, 30, 0)}, 0.0, 3.0);
  flight.cycles(15);
  EXPECT_LT((flight.vehicle(0).p - place).norm(), 0.5);
  flight.planner().command(0, FlightCommand::kStart);
  flight.cycles(20);
  EXPECT_GT(flight.vehicle(0).p.y(), place.y() + 10.0);
}

// Where the UAV would have come to rest without the stop nobody will be: another one may go there.
TEST(Stop, KeepsNobodyOffWhereTheUavWasToGo) {
  PerfectFlight flight(
      makeTestMission({Vector3(0, 0, 10), Vector3(40, 12, 10)}, {Vector3(400, 0, 10), Vector3(40, 12, 10)}, 4.0));
  flight.cycles(20);
  const Vector3 free_place = flight.planner().committed(0).restingPlace();
  flight.planner().command(0, FlightCommand::kStop);
  flight.planner().setReference(1, {Vector3(40, 12, 10), free_place}, 0.0, 4.0);
  flight.cycles(60);
  ASSERT_GT((flight.vehicle(0).p - free_place).norm(), 4.0) << "it is taken: this shows nothing";
  EXPECT_LT((flight.vehicle(1).p - free_place).norm(), 0.3);
  EXPECT_EQ(flight.planner().report().uavs[1].state, UavState::kTracking);
}

// What did not reach the vehicle is sent again, from where the vehicle is.
TEST(Stop, IsMadeAnewWhereItWasLost) {
  const Mission mission = oneUav();
  SwarmPlanner planner(mission);
  CommittedMotion flown;
  flown.assignRest(0.0, mission.scenario.uavs[0].start);
  double now = 0.0;
  const auto cycle = [&](bool arrives) {
    Snapshot snapshot;
    snapshot.now = now;
    const KinematicState x = flown.at(now);
    snapshot.uavs.push_back({true, now, x.p, x.v});
    now += kPeriod;
    planner.plan(snapshot, now);
    if (arrives) flown = planner.committed(0);
  };
  for (int i = 0; i < 20; ++i) cycle(true);
  planner.command(0, FlightCommand::kStop);
  cycle(false);
  cycle(false);
  cycle(false);
  EXPECT_GT(flown.at(now).v.norm(), 3.0) << "nothing has arrived: this shows nothing";
  for (int i = 0; i < 10; ++i) cycle(true);
  EXPECT_LT(flown.at(now).v.norm(), 0.01);
  EXPECT_LT((flown.at(now).p - planner.committed(0).at(now).p).norm(), 1e-6);
}

}  // namespace
}  // namespace swarm_planner
