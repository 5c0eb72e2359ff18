// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Guides in closed loop. If these fail, UAVs wait for good behind what they could fly round; each flight has its
// negative control.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "perfect_flight.hpp"
#include "swarm_planner/swarm/guide_thread.hpp"

namespace swarm_planner {
namespace {

ScenarioObstacle box(int id, const Vector3& center, const Vector3& radii) {
  ScenarioObstacle obstacle;
  obstacle.id = id;
  obstacle.center = center;
  obstacle.radii = radii;
  obstacle.exponents = Vector3::Constant(10.0);
  return obstacle;
}

/// A flight of 40 m along x at 3 m/s, at 10 m of height.
Mission flightAlongX(bool guide) {
  Mission mission = makeTestMission({Vector3(0, 0, 10)}, {Vector3(40, 0, 10)}, 3.0);
  mission.parameters.limits.guide = guide;
  return mission;
}

Mission boxHeadOn(bool guide) {
  Mission mission = flightAlongX(guide);
  mission.scenario.obstacles.push_back(box(1, Vector3(20, 0, 10), Vector3(3, 6, 9)));
  return mission;
}

Mission deadEnd(bool guide) {
  Mission mission = flightAlongX(guide);
  mission.scenario.obstacles.push_back(box(1, Vector3(25, 0, 10), Vector3(1, 6, 20)));
  mission.scenario.obstacles.push_back(box(2, Vector3(19, 5.5, 10), Vector3(7, 0.5, 20)));
  mission.scenario.obstacles.push_back(box(3, Vector3(19, -5.5, 10), Vector3(7, 0.5, 20)));
  return mission;
}

/// From the end after so many cycles [m].
double missed(PerfectFlight& flight, int cycles, const Vector3& end = Vector3(40, 0, 10)) {
  flight.cycles(cycles);
  return (flight.vehicle(0).p - end).norm();
}

TEST(Guides, LeadRoundABoxMetHeadOnAndOnlyGuidesDo) {
  PerfectFlight guided(boxHeadOn(true));
  EXPECT_LT(missed(guided, 80), 0.3);
  EXPECT_GT(guided.leastObstacleDistance(), LimitParameters().uav_radius);
  PerfectFlight alone(boxHeadOn(false));
  EXPECT_GT(missed(alone, 160), 10.0);
}

TEST(Guides, LeadOutOfADeadEndAndOnlyGuidesDo) {
  PerfectFlight guided(deadEnd(true));
  EXPECT_LT(missed(guided, 110), 0.3);
  EXPECT_GT(guided.leastObstacleDistance(), LimitParameters().uav_radius);
  PerfectFlight alone(deadEnd(false));
  EXPECT_GT(missed(alone, 160), 10.0);
}

TEST(Guides, TellOfThemselvesWhileTheyLeadAndLagStaysThatOnTheReference) {
  PerfectFlight flight(boxHeadOn(true));
  bool was_guided = false;
  double greatest_lag = 0.0;
  for (int cycle = 0; cycle < 80; ++cycle) {
    const UavReport& report = flight.cycle().uavs[0];
    was_guided = was_guided || flight.planner().guide(0) != nullptr;
    greatest_lag = std::max(greatest_lag, report.lag);
    EXPECT_EQ(report.state, UavState::kTracking);
    const double target = flight.planner().target(0, flight.planner().report().epoch).arc_length;
    EXPECT_NEAR(report.lag, target - flight.planner().progress(0), 1e-9);
  }
  EXPECT_TRUE(was_guided);
  EXPECT_LT(greatest_lag, 20.0);
  EXPECT_EQ(flight.planner().guide(0), nullptr) << "the reference is clear";
}

// One that hovers where another one's reference leads is gone round; the two do not wait for each other.
TEST(Guides, LeadRoundAUavThatHoversInANarrowPassage) {
  const auto mission = [](bool guide) {
    Mission hovering =
        makeTestMission({Vector3(0, 0, 10), Vector3(20, 0, 10)}, {Vector3(40, 0, 10), Vector3(20, 0, 10)}, 3.0);
    hovering.parameters.limits.guide = guide;
    hovering.scenario.obstacles.push_back(box(1, Vector3(20, 5.5, 10), Vector3(2, 3.5, 30)));
    hovering.scenario.obstacles.push_back(box(2, Vector3(20, -5.5, 10), Vector3(2, 3.5, 30)));
    return hovering;
  };
  PerfectFlight guided(mission(true));
  EXPECT_LT(missed(guided, 110), 0.3);
  EXPECT_GT(guided.leastPairGauge(), 1.0);
}

TEST(Guides, WaitCalmlyBesideAnEndInsideAnObstacleAndGoOnWhenItLeaves) {
  Mission mission = flightAlongX(true);
  mission.scenario.obstacles.push_back(box(1, Vector3(40, 0, 10), Vector3(3, 6, 9)));
  PerfectFlight flight(mission);
  flight.cycles(80);
  const Vector3 place = flight.vehicle(0).p;
  for (int cycle = 0; cycle < 20; ++cycle) {
    EXPECT_EQ(flight.cycle().uavs[0].reason, Reason::kEndNotClear);
    EXPECT_LT((flight.vehicle(0).p - place).norm(), 0.1);
  }
  EXPECT_GT(flight.leastObstacleDistance(), LimitParameters().uav_radius);
  const auto gone = [](Snapshot& snapshot) { snapshot.obstacles.clear(); };
  for (int cycle = 0; cycle < 40; ++cycle) flight.cycle(gone);
  EXPECT_LT((flight.vehicle(0).p - Vector3(40, 0, 10)).norm(), 0.3);
}

TEST(Guides, SayThatThereIsNoWay) {
  Mission mission = flightAlongX(true);
  mission.scenario.workspace = Workspace{Vector3(-5, -10, 5), Vector3(60, 10, 15)};
  mission.scenario.obstacles.push_back(box(1, Vector3(20, 0, 10), Vector3(1, 14, 14)));
  PerfectFlight flight(mission);
  flight.cycles(60);
  EXPECT_EQ(flight.cycle().uavs[0].reason, Reason::kNoWayRound);
  EXPECT_GT(flight.leastObstacleDistance(), LimitParameters().uav_radius);
}

TEST(Guides, EndWithWhatTheyWereMadeFor) {
  PerfectFlight flight(boxHeadOn(true));
  for (int cycle = 0; cycle < 30 && flight.planner().guide(0) == nullptr; ++cycle) flight.cycle();
  ASSERT_NE(flight.planner().guide(0), nullptr);
  flight.planner().setReference(0, {Vector3(0, 0, 10), Vector3(0, 30, 10)}, 0.0, 3.0);
  flight.cycle();
  EXPECT_EQ(flight.planner().guide(0), nullptr);
  EXPECT_LT(missed(flight, 60, Vector3(0, 30, 10)), 0.3);
}

TEST(Guides, AreTheSameForAnyNumberOfThreads) {
  std::vector<Vector3> starts, ends;
  for (int i = 0; i < 6; ++i) {
    starts.emplace_back(0, 3.0 * i - 7.5, 10);
    ends.emplace_back(40, 7.5 - 3.0 * i, 10);
  }
  Mission mission = makeTestMission(starts, ends, 3.0);
  mission.scenario.obstacles.push_back(box(1, Vector3(20, 0, 10), Vector3(3, 8, 9)));
  Mission threaded = mission;
  threaded.parameters.compute.threads = 3;
  PerfectFlight one(mission);
  PerfectFlight three(threaded);
  int guided = 0;
  for (int cycle = 0; cycle < 50; ++cycle) {
    one.cycle();
    three.cycle();
    for (std::size_t i = 0; i < 6; ++i) {
      guided += one.planner().guide(i) != nullptr ? 1 : 0;
      ASSERT_TRUE(identical(one.planner().committed(i), three.planner().committed(i))) << cycle << " " << i;
    }
  }
  EXPECT_GT(guided, 10);
}

// As in the node: the search runs whenever it does, and no cycle waits for it.
TEST(Guides, AreFoundByAThreadBesideTheCycle) {
  const Mission mission = boxHeadOn(true);
  SwarmPlanner planner(mission);
  GuideThread thread(planner);
  Snapshot snapshot = snapshotOf(mission, 0.0);
  TrackedObstacle track;
  track.shape = makeObstacle(mission.scenario.obstacles[0]);
  KinematicState x;
  x.p = mission.scenario.uavs[0].start;
  for (int cycle = 0; cycle < 100; ++cycle) {
    snapshot.now = 0.3 * cycle;
    track.stamp = snapshot.now;
    snapshot.obstacles = {track};
    snapshot.uavs[0] = {true, snapshot.now, x.p, x.v};
    planner.plan(snapshot, snapshot.now + 0.3);
    thread.wake();
    x = planner.committed(0).at(snapshot.now + 0.3);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_LT((x.p - Vector3(40, 0, 10)).norm(), 0.3);
}

}  // namespace
}  // namespace swarm_planner
