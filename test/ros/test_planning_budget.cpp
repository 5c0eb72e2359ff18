// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: plans that come out after their epoch when a simulator runs fast, or a planner that is given no
// time, or all the time in the world, because the clock was slow or paused.
#include <gtest/gtest.h>

#include "swarm_planner/ros/planning_budget.hpp"

namespace swarm_planner {
namespace {

constexpr double kShare = 0.8;
constexpr double kPeriod = 0.3;

// The budget after cycles one period of ROS time and `wall_period` of wall time apart.
double budgetAtPace(double wall_period) {
  PlanningBudget budget(kShare);
  for (int cycle = 0; cycle < 4; ++cycle) budget.noteCycle(100.0 + cycle * kPeriod, 7.0 + cycle * wall_period);
  return budget.forPlansDueIn(kPeriod);
}

TEST(PlanningBudget, IsAShareOfWhatIsLeft) {
  const PlanningBudget budget(kShare);
  EXPECT_DOUBLE_EQ(budget.forPlansDueIn(0.3), 0.24);
  EXPECT_DOUBLE_EQ(budget.forPlansDueIn(0.1), 0.08);
}

TEST(PlanningBudget, IsNothingForPlansThatAreLate) { EXPECT_EQ(PlanningBudget(kShare).forPlansDueIn(-0.2), 0.0); }

TEST(PlanningBudget, ShrinksAsSimulatedTimeRunsFaster) {
  EXPECT_NEAR(budgetAtPace(kPeriod / 5.0), 0.24 / 5.0, 1e-9);
  EXPECT_NEAR(budgetAtPace(kPeriod / 100.0), 0.24 / 100.0, 1e-9);
}

TEST(PlanningBudget, IsNotMoreThanInRealTimeWhereSimulatedTimeIsSlower) {
  EXPECT_NEAR(budgetAtPace(kPeriod), 0.24, 1e-9);
  EXPECT_NEAR(budgetAtPace(10.0 * kPeriod), 0.24, 1e-9);
}

TEST(PlanningBudget, FollowsThePaceSinceTheCycleBefore) {
  PlanningBudget budget(kShare);
  budget.noteCycle(100.0, 7.0);
  EXPECT_DOUBLE_EQ(budget.forPlansDueIn(kPeriod), 0.24) << "no pace is known yet";
  budget.noteCycle(100.3, 7.03);
  EXPECT_NEAR(budget.forPlansDueIn(kPeriod), 0.024, 1e-9);
  budget.noteCycle(100.6, 3607.0);
  EXPECT_NEAR(budget.forPlansDueIn(kPeriod), 0.24, 1e-9) << "the clock was paused for an hour";
  budget.noteCycle(100.9, 3607.06);
  EXPECT_NEAR(budget.forPlansDueIn(kPeriod), 0.24 / 5.0, 1e-9);
}

TEST(PlanningBudget, JumpsOfTimeLeaveItFinite) {
  PlanningBudget budget(kShare);
  budget.noteCycle(100.0, 7.0);
  budget.noteCycle(20.0, 7.3);
  EXPECT_DOUBLE_EQ(budget.forPlansDueIn(kPeriod), 0.24);
  budget.noteCycle(20.3, 7.3);
  EXPECT_GT(budget.forPlansDueIn(kPeriod), 0.0);
  budget.noteCycle(20.6, 7.6);
  EXPECT_NEAR(budget.forPlansDueIn(kPeriod), 0.24, 1e-9);
}

}  // namespace
}  // namespace swarm_planner
