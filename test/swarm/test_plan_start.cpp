// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Every plan begins where the UAV will be. If that is wrong, setpoints jump at every epoch.
#include <gtest/gtest.h>

#include <cmath>

#include "support/flight_problem.hpp"
#include "swarm_planner/swarm/plan_start.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;
constexpr double kTrackingTime = 0.5;

UavMeasurement measured(double stamp, const Vector3& p, const Vector3& v) { return {true, stamp, p, v}; }

/// A plan and the state of a UAV that flies it perfectly.
Trajectory somePlan(Random& random, double epoch) {
  const KinematicState start{random.vector(-10.0, 10.0), random.vector(-3.0, 3.0), random.vector(-1.0, 1.0)};
  return wanderingPlan(random, start, 4.0, epoch, kDt);
}

TEST(PredictFromMeasurement, DriftsOnUntilTheEpoch) {
  const KinematicState start = predictFromMeasurement(measured(99.8, Vector3(1, 2, 3), Vector3(2, 0, -1)), 100.3);
  EXPECT_LT((start.p - Vector3(2, 2, 2.5)).norm(), 1e-12);
  EXPECT_EQ(start.v, Vector3(2, 0, -1));
  EXPECT_EQ(start.a, Vector3::Zero());
}

TEST(PredictFromPlan, OfAUavThatTracksPerfectlyIsItsPlan) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Trajectory plan = somePlan(random, 100.0);
    const double stamp = 100.0 + random.uniform(0.0, 1.0);
    const KinematicState now = plan.at(stamp);
    const KinematicState start = predictFromPlan(plan, plan, measured(stamp, now.p, now.v), stamp + 0.3, kTrackingTime);
    const KinematicState planned = plan.at(stamp + 0.3);
    EXPECT_LT((start.p - planned.p).norm(), 1e-12);
    EXPECT_LT((start.v - planned.v).norm(), 1e-12);
    EXPECT_LT((start.a - planned.a).norm(), 1e-12);
  }
}

TEST(PredictFromPlan, CarriesTheDeviationOnAndLetsItDecay) {
  Random random(2);
  const Trajectory plan = somePlan(random, 100.0);
  const Vector3 dp(0.3, -0.2, 0.1);
  const Vector3 dv(-0.1, 0.0, 0.4);
  const KinematicState expected = plan.at(100.4);
  const UavMeasurement measurement = measured(100.4, expected.p + dp, expected.v + dv);
  for (const double ahead : {0.0, 0.1, kTrackingTime, 1.0, 3.0}) {
    const KinematicState start = predictFromPlan(plan, plan, measurement, 100.4 + ahead, kTrackingTime);
    const KinematicState planned = plan.at(100.4 + ahead);
    const double left = std::exp(-ahead / kTrackingTime);
    EXPECT_LT((start.p - planned.p - left * dp).norm(), 1e-9);
    EXPECT_LT((start.v - planned.v - left * dv).norm(), 1e-9);
    EXPECT_LT((start.a - planned.a).norm(), 1e-9) << "attitude follows the plan's acceleration: no jump in it";
  }
}

// Odometry is older than the newest plan: the UAV was still flying the plan before, perfectly.
TEST(PredictFromPlan, ComparesOdometryWithThePlanThatWasFlownThen) {
  Random random(3);
  const Trajectory previous = somePlan(random, 100.0);
  Trajectory committed = wanderingPlan(random, previous.at(100.3), 4.0, 100.3, kDt);
  const KinematicState then = previous.at(100.25);
  const KinematicState start =
      predictFromPlan(committed, previous, measured(100.25, then.p, then.v), 100.6, kTrackingTime);
  EXPECT_LT((start.p - committed.at(100.6).p).norm(), 1e-9);
  EXPECT_LT((start.v - committed.at(100.6).v).norm(), 1e-9);
}

TEST(ShiftPlan, OnTheGridIsThePlanItself) {
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Trajectory committed = somePlan(random, 0.0);
    const int shift = random.integer(0, kHorizon - 1);
    Trajectory plan;
    shiftPlan(committed, committed.knots[static_cast<std::size_t>(shift)], shift * kDt, kDt, plan);
    EXPECT_EQ(plan.epoch, shift * kDt);
    EXPECT_EQ(plan.dt, kDt);
    // Without the last knot: whether its acceleration still belongs to the plan is for rounding to decide.
    for (int k = 0; k + shift < kHorizon; ++k) {
      const KinematicState& expected = committed.knots[static_cast<std::size_t>(k + shift)];
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].p - expected.p).norm(), 1e-9);
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].v - expected.v).norm(), 1e-9);
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].a - expected.a).norm(), 1e-9);
    }
  }
}

TEST(ShiftPlan, BeginsAtTheStartAndHasThePlansAccelerations) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Trajectory committed = somePlan(random, 10.0);
    const double epoch = 10.0 + random.uniform(0.0, 2.0);
    KinematicState start = committed.at(epoch);
    start.p += random.vector(-0.5, 0.5);
    start.v += random.vector(-0.5, 0.5);
    Trajectory plan;
    shiftPlan(committed, start, epoch, kDt, plan);
    EXPECT_EQ(plan.knots.front().p, start.p);
    EXPECT_EQ(plan.knots.front().v, start.v);
    EXPECT_EQ(plan.knots.front().a, start.a);
    for (int k = 1; k <= kHorizon; ++k) {
      const double t = epoch + k * kDt;
      if (t > committed.epoch + committed.duration() - 1e-6) break;
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].a - committed.at(t).a).norm(), 1e-9);
    }
  }
}

TEST(ShiftPlan, PastThePlansEndFliesOnWithoutAcceleration) {
  Random random(6);
  const Trajectory committed = somePlan(random, 0.0);
  const double epoch = 1.5 * committed.duration();
  Trajectory plan;
  shiftPlan(committed, {Vector3(1, 2, 3), Vector3(1, 0, 0), Vector3(0, 1, 0)}, epoch, kDt, plan);
  for (std::size_t k = 1; k <= kHorizon; ++k) EXPECT_LT(plan.knots[k].a.norm(), 1e-12);
}

TEST(CoastingPlan, KeepsItsVelocity) {
  Trajectory plan;
  coastingPlan({Vector3(1, 2, 3), Vector3(1, 0, 0), Vector3::Zero()}, 50.0, kDt, plan);
  EXPECT_EQ(plan.epoch, 50.0);
  EXPECT_EQ(plan.dt, kDt);
  for (int k = 0; k <= kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_LT((plan.knots[i].p - Vector3(1 + kDt * k, 2, 3)).norm(), 1e-12);
    EXPECT_EQ(plan.knots[i].v, Vector3(1, 0, 0));
  }
}

}  // namespace
}  // namespace swarm_planner
