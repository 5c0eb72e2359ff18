// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <array>
#include <atomic>

#include "perfect_flight.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"
#include "swarm_planner/swarm/thread_team.hpp"

namespace swarm_planner {
namespace {

TEST(ThreadTeam, CallsEveryItemOnce) {
  ThreadTeam team(4);
  std::array<std::atomic<int>, 1000> calls{};
  for (int loop = 0; loop < 200; ++loop) {
    team.forEach(10, calls.size(), [&](std::size_t item, std::size_t member) {
      EXPECT_LT(member, 4U);
      ++calls[item];
    });
  }
  for (std::size_t item = 0; item < calls.size(); ++item) EXPECT_EQ(calls[item], item < 10 ? 0 : 200);
}

TEST(ThreadTeam, AnEmptyLoopReturns) {
  ThreadTeam team(3);
  team.forEach(5, 5, [](std::size_t, std::size_t) { FAIL(); });
}

/// Flies by perfect tracking and returns the plans of the last cycle.
std::vector<CommittedMotion> plansAfter(const Scenario& scenario, int threads, int cycles) {
  const Mission mission = makeMission(scenario, {{"threads", threads}}, "test");
  SwarmPlanner planner(mission);
  const double period = mission.parameters.time.cycle_period;
  Snapshot snapshot;
  snapshot.uavs.resize(planner.uavCount());
  for (int cycle = 0; cycle < cycles; ++cycle) {
    snapshot.now = cycle * period;
    snapshot.obstacles.clear();
    for (const ScenarioObstacle& obstacle : scenario.obstacles) {
      snapshot.obstacles.push_back({makeObstacle(obstacle).movedBy(snapshot.now), snapshot.now, 0.0, 0.0});
    }
    for (std::size_t i = 0; i < planner.uavCount(); ++i) {
      UavMeasurement& measurement = snapshot.uavs[i];
      const KinematicState at_now =
          cycle < 2 ? KinematicState{scenario.uavs[i].start} : planner.committed(i).at(snapshot.now);
      measurement = {true, snapshot.now, at_now.p, at_now.v};
    }
    planner.plan(snapshot, snapshot.now + period);
  }
  std::vector<CommittedMotion> plans;
  for (std::size_t i = 0; i < planner.uavCount(); ++i) plans.push_back(planner.committed(i));
  return plans;
}

// A swarm whose plans depended on the machine's load could not be debugged.
TEST(SwarmPlannerThreads, GiveTheSamePlansToTheBit) {
  for (const Scenario& scenario : {circleSwap(12, 8.0, 3), paperScaling(32)}) {
    const std::vector<CommittedMotion> one = plansAfter(scenario, 1, 25);
    for (const int threads : {2, 5}) {
      const std::vector<CommittedMotion> several = plansAfter(scenario, threads, 25);
      for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_TRUE(identical(one[i], several[i])) << scenario.name << ", UAV " << i << ", " << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace swarm_planner
