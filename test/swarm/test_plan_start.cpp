// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Every plan begins where the UAV will be. If that is wrong, setpoints jump at every epoch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/flight_problem.hpp"
#include "swarm_planner/swarm/plan_start.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;
constexpr double kTrackingTime = 0.5;
constexpr double kNoise = 0.15;

UavMeasurement measured(double stamp, const Vector3& p, const Vector3& v) { return {true, stamp, p, v}; }

InputParameters input() {
  InputParameters input;
  input.tracking_time = kTrackingTime;
  input.odometry_noise = kNoise;
  return input;
}

/// A plan that wanders, and its stop.
CommittedMotion someMotion(Random& random, double epoch) {
  const KinematicState start{random.vector(-10.0, 10.0), random.vector(-3.0, 3.0), random.vector(-1.0, 1.0)};
  const Trajectory plan = wanderingPlan(random, start, 4.0, epoch, kDt);
  StopManoeuvre stop;
  rollOutStop(plan.knots.back(), 12, kDt, stop);
  CommittedMotion motion;
  motion.assign(plan, stop);
  return motion;
}

TEST(PredictFromMeasurement, DriftsOnUntilTheEpoch) {
  const KinematicState start = predictFromMeasurement(measured(99.8, Vector3(1, 2, 3), Vector3(2, 0, -1)), 100.3);
  EXPECT_LT((start.p - Vector3(2, 2, 2.5)).norm(), 1e-12);
  EXPECT_EQ(start.v, Vector3(2, 0, -1));
  EXPECT_EQ(start.a, Vector3::Zero());
}

TEST(CarryDeviation, OfAUavThatTracksPerfectlyIsItsMotion) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const CommittedMotion motion = someMotion(random, 100.0);
    const double stamp = 100.0 + random.uniform(0.0, 1.0);
    const KinematicState now = motion.at(stamp);
    const KinematicState planned = motion.at(stamp + 0.3);
    const KinematicState start = carryDeviation(planned, now, measured(stamp, now.p, now.v), stamp + 0.3, input());
    EXPECT_EQ(start.p, planned.p);
    EXPECT_EQ(start.v, planned.v);
    EXPECT_EQ(start.a, planned.a);
  }
}

// Far above what noise can be, nearly all of a deviation is the vehicle's.
TEST(CarryDeviation, CarriesALargeOneOnAndLetsItDecay) {
  Random random(2);
  const KinematicState expected{random.vector(-9.0, 9.0), random.vector(-3.0, 3.0), random.vector(-1.0, 1.0)};
  const KinematicState planned{random.vector(-9.0, 9.0), random.vector(-3.0, 3.0), random.vector(-1.0, 1.0)};
  const Vector3 dp(30.0, -20.0, 10.0);
  const Vector3 dv(-1.0, 0.0, 4.0);
  const UavMeasurement measurement = measured(100.4, expected.p + dp, expected.v + dv);
  const double share = carriedShare(dp, dv, kNoise, kTrackingTime);
  EXPECT_GT(share, 0.9999);
  for (const double ahead : {0.0, 0.1, kTrackingTime, 1.0, 3.0}) {
    const KinematicState start = carryDeviation(planned, expected, measurement, 100.4 + ahead, input());
    const double left = share * std::exp(-ahead / kTrackingTime);
    EXPECT_LT((start.p - planned.p - left * dp).norm(), 1e-9);
    EXPECT_LT((start.v - planned.v - left * dv).norm(), 1e-9);
    EXPECT_EQ(start.a, planned.a) << "attitude follows the plan's acceleration: no jump in it";
  }
}

// Noise that went into every start whole would shake every plan.
TEST(CarryDeviation, CarriesAFifthOfWhatMayBeNoise) {
  const KinematicState state{Vector3(1, 2, 3), Vector3(1, 0, 0), Vector3::Zero()};
  const Vector3 noise(0.0, 0.6 * kNoise, 0.8 * kNoise);
  const UavMeasurement measurement = measured(5.0, state.p + noise, state.v);
  EXPECT_LT((carryDeviation(state, state, measurement, 5.0, input()).p - state.p - 0.2 * noise).norm(), 1e-12);
}

TEST(CarriedShare, IsLeastWithinTheBandAndGrowsToAll) {
  const Vector3 zero = Vector3::Zero();
  const auto of = [&](double size) { return carriedShare(Vector3(0.0, -size, 0.0), zero, kNoise, kTrackingTime); };
  EXPECT_EQ(of(0.0), kLeastCarried);
  EXPECT_EQ(of(kNoise), kLeastCarried);
  EXPECT_EQ(of(1.1 * kNoise), kLeastCarried) << "it must not jump where the band ends";
  EXPECT_NEAR(of(2.0 * kNoise), 0.75, 1e-12);
  EXPECT_NEAR(of(100.0 * kNoise), 1.0, 1e-3);
  for (double size = 0.0; size < 10.0 * kNoise; size += 0.01 * kNoise) {
    EXPECT_GE(of(size + 0.01 * kNoise), of(size));
    EXPECT_LT(of(size + 0.01 * kNoise) - of(size), 0.02) << size;
  }
}

TEST(CarriedShare, KnowsAVelocityByTheWayItMakes) {
  const Vector3 zero = Vector3::Zero();
  const auto of = [&](double speed) { return carriedShare(zero, Vector3(speed, 0.0, 0.0), kNoise, kTrackingTime); };
  EXPECT_EQ(of(kNoise / kTrackingTime), kLeastCarried);
  EXPECT_NEAR(of(2.0 * kNoise / kTrackingTime), 0.75, 1e-12);
  EXPECT_EQ(carriedShare(Vector3(2.0 * kNoise, 0, 0), Vector3(0.1, 0, 0), kNoise, kTrackingTime),
            of(2.0 * kNoise / kTrackingTime))
      << "the larger one of the two counts";
}

TEST(CarriedShare, IsAllWithoutNoise) {
  EXPECT_EQ(carriedShare(Vector3(1e-6, 0.0, 0.0), Vector3::Zero(), 0.0, kTrackingTime), 1.0);
}

TEST(ShiftPlan, OnTheGridIsThePlanItself) {
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const CommittedMotion committed = someMotion(random, 0.0);
    const int shift = random.integer(0, committed.pieces());
    Trajectory plan;
    shiftPlan(committed, committed.after(shift * kDt), shift * kDt, kDt, plan);
    EXPECT_EQ(plan.epoch, shift * kDt);
    EXPECT_EQ(plan.dt, kDt);
    for (int k = 0; k <= kHorizon; ++k) {
      const KinematicState expected = committed.after((k + shift) * kDt);
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].p - expected.p).norm(), 1e-9);
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].v - expected.v).norm(), 1e-9);
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].a - expected.a).norm(), 1e-9);
    }
  }
}

TEST(ShiftPlan, BeginsAtTheStartAndHasThePlansAccelerations) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const CommittedMotion committed = someMotion(random, 10.0);
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
      EXPECT_LT((plan.knots[static_cast<std::size_t>(k)].a - committed.at(t).a).norm(), 1e-9);
    }
  }
}

TEST(ShiftPlan, OfAMotionThatRestsFliesOnWithoutAcceleration) {
  Random random(6);
  const CommittedMotion committed = someMotion(random, 0.0);
  const double epoch = committed.duration();
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

TEST(ShareWithinJerk, IsTheLargestThatKeepsTheLimit) {
  Random random(11);
  for (int n = 0; n < 300; ++n) {
    Trajectory from = straightPlan(Vector3::Zero(), Vector3::Zero(), 0.0, kDt);
    Trajectory to = from;
    for (std::size_t k = 0; k < kHorizon; ++k) {
      from.jerks[k] = random.vector(-5.0, 5.0);
      to.jerks[k] = random.vector(-40.0, 40.0);
    }
    const double share = shareWithinJerk(from, to, 10.0);
    ASSERT_GT(share, 0.0);
    ASSERT_LT(share, 1.0);
    const auto longest = [&](double s) {
      double jerk = 0.0;
      for (std::size_t k = 0; k < kHorizon; ++k) {
        jerk = std::max(jerk, (from.jerks[k] + s * (to.jerks[k] - from.jerks[k])).norm());
      }
      return jerk;
    };
    EXPECT_NEAR(longest(share), 10.0, 1e-9);
    EXPECT_GT(longest(share + 1e-3), 10.0);
    EXPECT_EQ(shareWithinJerk(from, from, 10.0), 1.0);
    EXPECT_EQ(shareWithinJerk(to, from, 10.0), 1.0) << "the first one is too long already";
  }
}

}  // namespace
}  // namespace swarm_planner
