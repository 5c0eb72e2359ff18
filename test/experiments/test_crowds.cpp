// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a crowd still flies safely, but the work of solving is thrown away, and UAVs brake for nothing.
#include <gtest/gtest.h>

#include "swarm_planner/config/tight_scenarios.hpp"
#include "swarm_planner/experiments/closed_loop_run.hpp"

namespace swarm_planner {
namespace {

RunResult flown(const Scenario& scenario) {
  const Mission mission = makeMission(scenario, {}, scenario.name);
  IterativePlanner planner(mission);
  return ClosedLoopRun(mission, planner, 0).fly();
}

// 4 to 6 of 100 plans of this swap stop where somebody else is going to.
TEST(Crowds, HardlyAnyPlanOfASwapIsRefusedAsPlansMayStopEarlier) {
  const Scenario scenario = swapInRoom(32, 0);
  const RunResult flight = flown(scenario);
  EXPECT_EQ(flight.flown.collisions.size(), 0u);
  EXPECT_EQ(flight.flown.arrived_uavs, 32);
  const auto plans = static_cast<double>(scenario.uavs.size() * flight.cycles);
  EXPECT_GT(static_cast<double>(flight.plans_stopped_early), 0.02 * plans);
  EXPECT_LT(static_cast<double>(flight.rejected_plans), 0.02 * plans);
}

// The first one is held 0.1 m from where all are sent by those that have come to stay around it.
TEST(Crowds, TheNearestOfThoseSentToOnePlaceGetsThere) {
  const RunResult flight = flown(sameGoal(8, 0.1, 1));
  EXPECT_EQ(flight.flown.collisions.size(), 0u);
  EXPECT_EQ(flight.flown.arrived_uavs, 8);
}

}  // namespace
}  // namespace swarm_planner
