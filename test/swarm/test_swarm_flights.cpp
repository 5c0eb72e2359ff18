// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Small swarms in closed loop. If these fail, UAVs collide or get stuck; each has its negative control.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "perfect_flight.hpp"
#include "support/flight_problem.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Path = std::vector<Vector3>;

TEST(Swarm, UavsOnTopOfEachOtherPart) {
  PerfectFlight flight(
      makeTestMission({Vector3(0, 0, 10), Vector3(0, 0, 10)}, {Vector3(0, 0, 10), Vector3(0, 0, 10)}, 0.0));
  const CycleReport& first = flight.cycle();
  for (const UavReport& uav : first.uavs) {
    EXPECT_EQ(uav.state, UavState::kFallback);
    EXPECT_EQ(uav.reason, Reason::kNoSafePlan);
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

// The target runs ahead to the path's end: the last leg's end is nearest to the middle of the first leg.
TEST(Swarm, ArrivesAroundSharpCornersBehindATargetThatIsFarAhead) {
  const Path hairpin{Vector3(-9, 14, 10), Vector3(5, -22, 10), Vector3(20, 5, 10)};
  const Path there_and_back{Vector3(0, 0, 10), Vector3(25, 0, 10), Vector3(0, 0, 10)};
  const Path lawnmower{Vector3(0, 0, 10), Vector3(30, 0, 10), Vector3(30, 3, 10), Vector3(0, 3, 10), Vector3(0, 6, 10)};
  for (const Path& way : {hairpin, there_and_back, lawnmower}) {
    PerfectFlight flight(makeTestMission({way.front()}, {way.back()}, 0.0));
    double length = 0.0;
    for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
    flight.planner().setReference(0, way, length, 0.0);
    std::vector<double> least(way.size(), kInfinity);
    for (int cycle = 0; cycle < 100; ++cycle) {
      flight.cycle();
      for (std::size_t i = 0; i < way.size(); ++i) least[i] = std::min(least[i], (flight.vehicle(0).p - way[i]).norm());
    }
    EXPECT_LT((flight.vehicle(0).p - way.back()).norm(), 0.2) << way.back().transpose();
    for (std::size_t i = 0; i < way.size(); ++i) EXPECT_LT(least[i], 2.5) << "corner left out: " << way[i].transpose();
  }
}

/// Least gauge of the two newest motions, sampled densely.
double leastPairGaugeOfPlans(const SwarmPlanner& planner) {
  const CommittedMotion& first = planner.committed(0);
  const CommittedMotion& second = planner.committed(1);
  double least = kInfinity;
  for (double t = 0.0; t <= first.duration(); t += 0.02) {
    least = std::min(least, pairGauge(first.after(t).p - second.after(t).p, LimitParameters()));
  }
  return least;
}

// Problem 2 solves one UAV after the other. Around the plans of the cycle before, both would give way, or neither.
TEST(Swarm, EachUavPlansAroundTheNewPlansOfThoseBefore) {
  const Mission mission =
      makeTestMission({Vector3(-6, 0, 10), Vector3(0, -6, 10)}, {Vector3(20, 0, 10), Vector3(0, 20, 10)}, 3.0);
  SwarmPlanner planner(mission);
  planner.plan(snapshotOf(mission, 0.0), 0.3);
  EXPECT_GT(leastPairGaugeOfPlans(planner), 1.0);
  SwarmPlanner alone(makeTestMission({Vector3(0, -6, 10)}, {Vector3(0, 20, 10)}, 3.0));
  Snapshot snapshot = snapshotOf(mission, 0.0);
  snapshot.uavs.erase(snapshot.uavs.begin());
  alone.plan(snapshot, 0.3);
  EXPECT_GT((alone.committed(0).restingPlace() - planner.committed(1).restingPlace()).norm(), 0.1)
      << "the second need not give way at all: this shows nothing";
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

// Plans depend on whom one can meet, not on who else there is.
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
