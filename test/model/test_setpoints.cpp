// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, drivers receive setpoints that are out of order, too few, or not those of the plan.
#include <gtest/gtest.h>

#include <limits>

#include "swarm_planner/model/setpoints.hpp"
#include "swarm_planner/model/trajectory.hpp"

namespace swarm_planner {
namespace {

constexpr double kWhole = std::numeric_limits<double>::infinity();

Trajectory curvedPlan(double epoch) {
  Trajectory plan;
  plan.epoch = epoch;
  plan.dt = 0.3;
  for (std::size_t k = 0; k < plan.jerks.size(); ++k) {
    plan.jerks[k] = Vector3(1.0, k < 10 ? 2.0 : -2.0, -0.5);
  }
  KinematicState start;
  start.v = Vector3(1.0, 0.0, 0.5);
  rollOut(start, plan);
  return plan;
}

void expectStrictlyIncreasing(const SetpointTrajectory& sampled) {
  ASSERT_FALSE(sampled.points.empty());
  EXPECT_EQ(sampled.points.front().time_from_start, 0.0);
  for (std::size_t i = 1; i < sampled.points.size(); ++i) {
    EXPECT_GT(sampled.points[i].time_from_start, sampled.points[i - 1].time_from_start + 1e-6) << "point " << i;
  }
}

TEST(Setpoints, CoverTheWholePlan) {
  const Trajectory plan = curvedPlan(1.7e9);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.05, kWhole, 0.7, sampled);
  EXPECT_EQ(sampled.epoch, plan.epoch);
  ASSERT_EQ(sampled.points.size(), 121U);
  expectStrictlyIncreasing(sampled);
  for (const Setpoint& point : sampled.points) {
    const KinematicState x = plan.after(point.time_from_start);
    EXPECT_EQ((point.p - x.p).norm(), 0.0);
    EXPECT_EQ((point.v - x.v).norm(), 0.0);
    EXPECT_EQ((point.a - x.a).norm(), 0.0);
    EXPECT_EQ(point.yaw, 0.7);
  }
  EXPECT_LT((sampled.points.back().p - plan.knots.back().p).norm(), 1e-9);
  EXPECT_LT((sampled.points.back().a - plan.knots.back().a).norm(), 1e-9);
}

TEST(Setpoints, EndAtTheHorizon) {
  const Trajectory plan = curvedPlan(0.0);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.1, 0.45, 0.0, sampled);
  ASSERT_EQ(sampled.points.size(), 6U);
  EXPECT_DOUBLE_EQ(sampled.points[4].time_from_start, 0.4);
  EXPECT_DOUBLE_EQ(sampled.points[5].time_from_start, 0.45);
}

TEST(Setpoints, NeverReachBeyondThePlan) {
  const Trajectory plan = curvedPlan(0.0);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.5, 100.0, 0.0, sampled);
  EXPECT_NEAR(sampled.points.back().time_from_start, plan.duration(), 1e-12);
}

TEST(Setpoints, DoNotRepeatTheLastPointWhenTheStepRounds) {
  const Trajectory plan = curvedPlan(0.0);
  SetpointTrajectory sampled;
  for (const double dt : {0.01, 0.02, 0.03, 0.05, 0.06, 0.07, 0.1, 0.15, 0.3, 0.7, 6.0, 7.0}) {
    sampleMotion(plan, plan.epoch, dt, kWhole, 0.0, sampled);
    expectStrictlyIncreasing(sampled);
    EXPECT_NEAR(sampled.points.back().time_from_start, plan.duration(), 1e-12) << "dt " << dt;
  }
}

TEST(Setpoints, ReuseTheirMemory) {
  const Trajectory plan = curvedPlan(0.0);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.05, kWhole, 0.0, sampled);
  const Setpoint* const memory = sampled.points.data();
  sampleMotion(plan, plan.epoch, 0.05, kWhole, 0.0, sampled);
  sampleMotion(plan, plan.epoch, 0.1, kWhole, 0.0, sampled);
  EXPECT_EQ(sampled.points.data(), memory);
}

}  // namespace
}  // namespace swarm_planner
