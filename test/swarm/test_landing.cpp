// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Landings and take-offs in closed loop. If these fail, UAVs come down upon each other, or not at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "perfect_flight.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"

namespace swarm_planner {
namespace {

/// Cycles until every UAV has landed; at most `most`.
int cyclesToGround(PerfectFlight& flight, int most) {
  for (int cycle = 1; cycle <= most; ++cycle) {
    flight.cycle();
    bool landed = true;
    for (std::size_t i = 0; i < flight.planner().uavCount(); ++i) {
      landed = landed && flight.planner().mode(i) == FlightMode::kLanded;
    }
    if (landed) return cycle;
  }
  return most + 1;
}

void commandAll(PerfectFlight& flight, FlightCommand command) {
  for (std::size_t i = 0; i < flight.planner().uavCount(); ++i) {
    const CommandAnswer answer = flight.planner().command(i, command);
    EXPECT_TRUE(answer.accepted) << answer.text;
  }
}

Mission stacked(const std::vector<double>& heights) {
  std::vector<Vector3> places;
  for (const double height : heights) places.emplace_back(0, 0, height);
  Mission mission = makeTestMission(places, places, 0.0);
  mission.parameters.landing.speed = 1.0;
  return mission;
}

TEST(Landing, EndsOnTheGroundBelowWhereTheUavStopped) {
  Mission mission = makeTestMission({Vector3(0, 0, 6)}, {Vector3(400, 0, 6)}, 4.0);
  mission.scenario.workspace = Workspace{Vector3(-10, -10, 0.5), Vector3(500, 10, 20)};
  PerfectFlight flight(mission);
  flight.cycles(20);
  flight.planner().command(0, FlightCommand::kLand);
  flight.cycle();
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kLanding);
  double x = 0.0;
  double worst = 0.0;  // off its column while it descends
  for (int cycle = 0; cycle < 120 && flight.planner().mode(0) == FlightMode::kLanding; ++cycle) {
    flight.cycle();
    if (flight.planner().mode(0) == FlightMode::kLanded) break;
    if (flight.planner().report().uavs[0].reason != Reason::kDescending) {
      x = flight.vehicle(0).p.x();
      EXPECT_NEAR(flight.vehicle(0).p.z(), 6.0, 0.3) << "not before it is above its site";
    } else {
      worst = std::max(worst, std::abs(flight.vehicle(0).p.x() - x));
    }
  }
  ASSERT_EQ(flight.planner().mode(0), FlightMode::kLanded);
  EXPECT_LT(worst, 0.3);
  flight.cycles(25);
  EXPECT_NEAR(flight.vehicle(0).p.z(), 0.0, 0.1) << "the workspace begins at 0.5 m";
  EXPECT_LT(flight.vehicle(0).v.norm(), 1e-6);
  const UavReport& report = flight.planner().report().uavs[0];
  EXPECT_EQ(report.state, UavState::kStopped);
  EXPECT_EQ(report.reason, Reason::kLanded);
  EXPECT_TRUE(report.planned);

  flight.planner().command(0, FlightCommand::kStart);
  flight.cycles(30);
  EXPECT_NEAR(flight.vehicle(0).p.z(), 6.0, 0.3) << "it takes off";
  EXPECT_GT(flight.vehicle(0).v.x(), 3.0) << "and goes on with its mission";
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kTracking);
}

TEST(Landing, DescendsWithItsSpeed) {
  Mission mission = stacked({20.0});
  mission.parameters.landing.speed = 1.0;
  PerfectFlight flight(mission);
  flight.cycles(3);
  flight.planner().command(0, FlightCommand::kLand);
  double fastest = 0.0;
  for (int cycle = 0; cycle < 60; ++cycle) {
    flight.cycle();
    fastest = std::max(fastest, flight.vehicle(0).v.norm());
  }
  EXPECT_NEAR(fastest, 1.0, 0.25);
  EXPECT_LE(cyclesToGround(flight, 40), 40);
}

TEST(Landing, OfUavsAboveEachOtherIsInColumnsOfTheirOwn) {
  PerfectFlight flight(stacked({4.0, 7.0, 10.0, 13.0}));
  flight.cycles(3);
  commandAll(flight, FlightCommand::kLand);
  EXPECT_LE(cyclesToGround(flight, 150), 150);
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  EXPECT_LT(flight.vehicle(0).p.head<2>().norm(), 0.3) << "the lowest goes straight down";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(flight.vehicle(i).p.z(), 0.0, 0.1);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((flight.vehicle(i).p - flight.vehicle(j).p).head<2>().norm(), LimitParameters().pair_distance);
    }
  }
}

// Negative control: sent straight down without sites of their own, only the lowest gets to the ground.
TEST(Landing, WithoutSitesUavsBlockEachOther) {
  PerfectFlight flight(stacked({4.0, 7.0}));
  flight.cycles(3);
  for (std::size_t i = 0; i < 2; ++i) {
    flight.planner().setReference(i, {flight.vehicle(i).p, Vector3(0, 0, 0)}, 0.0, 1.0);
  }
  flight.cycles(150);
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  EXPECT_GT(std::max(flight.vehicle(0).p.z(), flight.vehicle(1).p.z()), 1.0);
}

TEST(Landing, OfACrowdInFullFlightKeepsClear) {
  Scenario scenario = circleSwap(10, 10.0, 0);
  PerfectFlight flight(makeMission(scenario, {{"land_speed", 1.0}}, "circle_swap"));
  flight.cycles(static_cast<int>(2.5 / 0.3));
  commandAll(flight, FlightCommand::kLand);
  EXPECT_LE(cyclesToGround(flight, 200), 200);
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  commandAll(flight, FlightCommand::kStart);
  flight.cycles(100);
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LT((flight.vehicle(i).p - scenario.uavs[i].reference.back()).norm(), 0.5) << "the mission goes on";
  }
}

TEST(Landing, AvoidsAnObstacleBelow) {
  Mission mission = stacked({12.0});
  ScenarioObstacle obstacle;
  obstacle.center = Vector3(0.5, 0, 3);
  obstacle.radii = Vector3(2, 2, 3);
  mission.scenario.obstacles.push_back(obstacle);
  PerfectFlight flight(mission);
  flight.cycles(3);
  flight.planner().command(0, FlightCommand::kLand);
  EXPECT_LE(cyclesToGround(flight, 120), 120);
  EXPECT_GE(flight.leastObstacleDistance(), LimitParameters().uav_radius);
  EXPECT_NEAR(flight.vehicle(0).p.z(), 0.0, 0.1);
}

// Somebody who is no part of the landing hovers below.
TEST(Landing, AvoidsAUavThatHolds) {
  PerfectFlight flight(stacked({4.0, 10.0}));
  flight.cycles(3);
  flight.planner().command(0, FlightCommand::kHold);
  flight.planner().command(1, FlightCommand::kLand);
  for (int cycle = 0; cycle < 120 && flight.planner().mode(1) != FlightMode::kLanded; ++cycle) flight.cycle();
  EXPECT_EQ(flight.planner().mode(1), FlightMode::kLanded);
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  EXPECT_LT((flight.vehicle(0).p - Vector3(0, 0, 4)).norm(), 0.3) << "it need not give way";
}

TEST(Landing, GivesUpASiteThatSomebodyComesUpon) {
  Mission mission = makeTestMission({Vector3(0, 0, 25), Vector3(12, 0, 4)}, {Vector3(0, 0, 25), Vector3(0, 0, 4)}, 3.0);
  mission.parameters.landing.speed = 1.0;
  PerfectFlight flight(mission);
  flight.planner().command(0, FlightCommand::kLand);
  for (int cycle = 0; cycle < 200 && flight.planner().mode(0) != FlightMode::kLanded; ++cycle) flight.cycle();
  EXPECT_EQ(flight.planner().mode(0), FlightMode::kLanded);
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  EXPECT_GE((flight.vehicle(0).p - flight.vehicle(1).p).head<2>().norm(), LimitParameters().pair_distance);
}

TEST(Landing, CanBeBrokenOff) {
  for (const FlightCommand command : {FlightCommand::kHold, FlightCommand::kStop, FlightCommand::kStart}) {
    PerfectFlight flight(stacked({12.0}));
    flight.cycles(3);
    flight.planner().command(0, FlightCommand::kLand);
    flight.cycles(20);
    const double height = flight.vehicle(0).p.z();
    ASSERT_LT(height, 11.0);
    EXPECT_TRUE(flight.planner().command(0, command).accepted);
    flight.cycles(30);
    EXPECT_LT(flight.vehicle(0).v.norm(), 0.1);
    if (command == FlightCommand::kStart) {
      EXPECT_NEAR(flight.vehicle(0).p.z(), 12.0, 0.3) << "back to its mission";
    } else {
      EXPECT_NEAR(flight.vehicle(0).p.z(), height, 1.6);
    }
  }
}

TEST(Landing, OnTheGroundAlreadyIsLandedAtOnce) {
  PerfectFlight flight(makeTestMission({Vector3(0, 0, 0)}, {Vector3(0, 0, 10)}, 1.0));
  flight.planner().command(0, FlightCommand::kLand);
  flight.cycles(3);
  EXPECT_EQ(flight.planner().mode(0), FlightMode::kLanded);
  EXPECT_LT(flight.vehicle(0).p.norm(), 0.05);
  flight.planner().command(0, FlightCommand::kStart);
  flight.cycles(40);
  EXPECT_NEAR(flight.vehicle(0).p.z(), 10.0, 0.3);
}

// The ground is 1 m higher than it was said to be: the vehicle stays where it touches it.
TEST(Landing, OnHigherGroundIsNoticed) {
  const Mission mission = stacked({5.0});
  SwarmPlanner planner(mission);
  CommittedMotion flown;
  flown.assignRest(0.0, mission.scenario.uavs[0].start);
  double now = 0.0;
  planner.command(0, FlightCommand::kLand);
  for (int cycle = 0; cycle < 100 && planner.mode(0) != FlightMode::kLanded; ++cycle) {
    Snapshot snapshot;
    snapshot.now = now;
    KinematicState x = flown.at(now);
    if (x.p.z() < 1.0) {
      x.p.z() = 1.0;
      x.v.setZero();
    }
    snapshot.uavs.push_back({true, now, x.p, x.v});
    now += mission.parameters.time.cycle_period;
    planner.plan(snapshot, now);
    flown = planner.committed(0);
  }
  EXPECT_EQ(planner.mode(0), FlightMode::kLanded);
}

}  // namespace
}  // namespace swarm_planner
