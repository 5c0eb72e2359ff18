// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, vehicles are sent to places that the planner did not check: a plan would not be evaluated as planned.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "swarm_planner/model/trajectory.hpp"

namespace swarm_planner {
namespace {

Trajectory randomPlan(Random& random, double epoch) {
  Trajectory plan;
  plan.epoch = epoch;
  plan.dt = 0.3;
  for (Vector3& jerk : plan.jerks) jerk = random.vector(-5.0, 5.0);
  KinematicState start;
  start.p = random.vector(-10.0, 10.0);
  start.v = random.vector(-3.0, 3.0);
  start.a = random.vector(-3.0, 3.0);
  rollOut(start, plan);
  return plan;
}

void expectNear(const KinematicState& x, const KinematicState& y, double tolerance) {
  EXPECT_LT((x.p - y.p).norm(), tolerance);
  EXPECT_LT((x.v - y.v).norm(), tolerance);
  EXPECT_LT((x.a - y.a).norm(), tolerance);
}

TEST(Trajectory, PassesThroughItsKnots) {
  Random random(1);
  const Trajectory plan = randomPlan(random, 12.0);
  for (std::size_t k = 0; k < plan.knots.size(); ++k) {
    expectNear(plan.after(static_cast<double>(k) * plan.dt), plan.knots[k], 1e-9);
  }
}

TEST(Trajectory, IsContinuousAcrossKnots) {
  Random random(2);
  const Trajectory plan = randomPlan(random, 0.0);
  for (int k = 1; k < kHorizon; ++k) expectNear(plan.at(k * plan.dt - 1e-9), plan.at(k * plan.dt + 1e-9), 1e-6);
}

TEST(Trajectory, FollowsItsSegmentsBetweenKnots) {
  Random random(3);
  const Trajectory plan = randomPlan(random, 5.0);
  for (std::size_t k = 0; k < plan.jerks.size(); ++k) {
    const double into = 0.4 * plan.dt;
    expectNear(plan.at(5.0 + static_cast<double>(k) * plan.dt + into), propagate(plan.knots[k], plan.jerks[k], into),
               1e-9);
  }
}

TEST(Trajectory, ExtendsTheFirstSegmentBackwards) {
  Random random(4);
  const Trajectory plan = randomPlan(random, 5.0);
  expectNear(plan.at(4.8), propagate(plan.knots[0], plan.jerks[0], -0.2), 1e-12);
}

TEST(Trajectory, CoastsAfterItsEnd) {
  Random random(5);
  const Trajectory plan = randomPlan(random, 5.0);
  const KinematicState x = plan.at(5.0 + plan.duration() + 2.0);
  EXPECT_LT((x.p - plan.knots.back().p - 2.0 * plan.knots.back().v).norm(), 1e-12);
  EXPECT_LT((x.v - plan.knots.back().v).norm(), 1e-12);
  EXPECT_EQ(x.a.norm(), 0.0);
}

TEST(Trajectory, SurvivesTimesFarFromItsEpoch) {
  Random random(6);
  const Trajectory plan = randomPlan(random, 1.7e9);
  EXPECT_TRUE(plan.at(-1e15).p.allFinite());
  EXPECT_TRUE(plan.at(1e15).p.allFinite());
}

TEST(Trajectory, KeepsItsLastAccelerationAtWallClockEpochs) {
  // A double holds wall clock time to 2e-7 s only: the end must not depend on how the sum rounds.
  Random random(7);
  for (int n = 0; n < 100; ++n) {
    const Trajectory plan = randomPlan(random, 1.7e9 + random.uniform(0.0, 100.0));
    expectNear(plan.after(plan.duration()), plan.knots.back(), 1e-12);
  }
}

}  // namespace
}  // namespace swarm_planner
