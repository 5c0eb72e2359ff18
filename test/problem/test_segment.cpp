// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a UAV may fly through what its control points clear, or the others plan around a motion that it does
// not make.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/flight_problem.hpp"
#include "support/random.hpp"
#include "support/resting_prediction.hpp"
#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;

KinematicState randomState(Random& random) {
  return {random.vector(-50.0, 50.0), random.vector(-5.0, 5.0), random.vector(-3.0, 3.0)};
}

/// The Bernstein polynomial of four control points at s in [0, 1].
Vector3 bernstein(const Vector3& b0, const Vector3& b1, const Vector3& b2, const Vector3& b3, double s) {
  const double r = 1.0 - s;
  return r * r * r * b0 + 3.0 * r * r * s * b1 + 3.0 * r * s * s * b2 + s * s * s * b3;
}

/// Largest distance of a prediction from the plan that it predicts, sampled within every stage [m].
double predictionError(const Trajectory& plan, double epoch, double dt, const PredictedMotion& motion) {
  double error = 0.0;
  for (int k = 0; k < kHorizon; ++k) {
    for (double s = 0.0; s <= 1.0; s += 0.05) {
      const Vector3 predicted =
          bernstein(motion.point(k, 0), motion.point(k, 1), motion.point(k, 2), motion.point(k, 3), s);
      error = std::max(error, (predicted - plan.at(epoch + (k + s) * dt).p).norm());
    }
  }
  return error;
}

TEST(Segment, IsTheBernsteinPolynomialOfItsControlPoints) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const double dt = random.uniform(0.05, 1.0);
    const KinematicState begin = randomState(random);
    const Vector3 jerk = random.vector(-20.0, 20.0);
    const SegmentPoints points = segmentPoints(begin, propagate(begin, jerk, dt), dt);
    for (double s = 0.0; s <= 1.0; s += 0.1) {
      const Vector3 p = propagate(begin, jerk, s * dt).p;
      EXPECT_LT((bernstein(points[0], points[1], points[2], points[3], s) - p).norm(), 1e-12 * (1.0 + p.norm()));
    }
  }
}

// Half-spaces are imposed on the control points only: this is what makes the segment between them safe.
TEST(Segment, LiesInEveryHalfSpaceThatHoldsItsControlPoints) {
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const KinematicState begin = randomState(random);
    const Vector3 jerk = random.vector(-20.0, 20.0);
    const SegmentPoints points = segmentPoints(begin, propagate(begin, jerk, kDt), kDt);
    const Vector3 n = random.direction();
    double least = n.dot(points[0]);
    for (const Vector3& point : points) least = std::min(least, n.dot(point));
    for (double s = 0.0; s <= 1.0; s += 0.02) EXPECT_GE(n.dot(propagate(begin, jerk, s * kDt).p), least - 1e-12);
  }
}

TEST(Box, HoldsWhatItIncludesAndKnowsWhatIsNear) {
  Box box;
  box.include(Vector3(1, 2, 3));
  box.include(Vector3(-1, 4, 0));
  EXPECT_EQ(box.min, Vector3(-1, 2, 0));
  EXPECT_EQ(box.max, Vector3(1, 4, 3));
  Box other;
  other.include(Vector3(3, 3, 1));
  EXPECT_TRUE(box.near(other, 2.0));
  EXPECT_TRUE(other.near(box, 2.0));
  EXPECT_FALSE(box.near(other, 1.9));
  EXPECT_FALSE(other.near(box, 1.9));
  EXPECT_TRUE(box.near(box, 0.0));
  EXPECT_FALSE(box.near(Box(), 1e6)) << "an empty box is near nothing";
}

TEST(Predict, IsExactForPlansOnTheGridAtAnyShiftByWholeStages) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    // Times as small as a simulation's and as large as a real clock's, whose rounding moves a UAV by micrometres.
    const double epoch = trial % 2 == 0 ? random.uniform(0.0, 100.0) : 1.7e9 + random.uniform(0.0, 100.0);
    const Trajectory plan = wanderingPlan(random, randomState(random), 5.0, epoch, kDt);
    for (int shift = 0; shift <= kHorizon; ++shift) {
      PredictedMotion motion;
      predict(plan, epoch + shift * kDt, kDt, motion);
      for (int k = 0; k + shift < kHorizon; ++k) {
        const auto i = static_cast<std::size_t>(k + shift);
        const SegmentPoints exact = segmentPoints(plan.knots[i], plan.knots[i + 1], kDt);
        for (int j = 0; j < 4; ++j) {
          EXPECT_LT((motion.point(k, j) - exact[static_cast<std::size_t>(j)]).norm(), epoch < 1e6 ? 1e-9 : 2e-5);
        }
      }
    }
  }
}

TEST(Predict, StaysWithinItsBoundOffTheGrid) {
  Random random(4);
  double worst = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    std::array<Vector3, kHorizon> jerks;
    for (Vector3& jerk : jerks) jerk = random.vector(-10.0, 10.0);
    const Trajectory plan = makePlan(randomState(random), jerks, 0.0, kDt);
    const double epoch = random.uniform(0.0, 1.0) * kDt;
    double change = 0.0;
    for (std::size_t k = 1; k < kHorizon; ++k) change = std::max(change, (jerks[k] - jerks[k - 1]).norm());
    PredictedMotion motion;
    // Within the plan: the stages beyond its end, where the acceleration jumps, are the next test's.
    predict(plan, epoch, kDt, motion);
    double error = 0.0;
    for (int k = 0; k + 1 < kHorizon; ++k) {
      for (double s = 0.0; s <= 1.0; s += 0.02) {
        const Vector3 p = bernstein(motion.point(k, 0), motion.point(k, 1), motion.point(k, 2), motion.point(k, 3), s);
        error = std::max(error, (p - plan.at(epoch + (k + s) * kDt).p).norm());
      }
    }
    const double bound = change * kDt * kDt * kDt / 192.0;
    EXPECT_LE(error, bound + 1e-12) << "epoch " << epoch;
    worst = std::max(worst, error / bound);
  }
  EXPECT_GT(worst, 0.3) << "the bound says nothing: it is far from what happens";
}

TEST(Predict, GoesOnAtConstantVelocityPastThePlansEnd) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Trajectory plan = wanderingPlan(random, randomState(random), 5.0, 10.0, kDt);
    for (const int shift : {5, kHorizon - 1, kHorizon, 2 * kHorizon, 100 * kHorizon}) {
      PredictedMotion motion;
      predict(plan, 10.0 + shift * kDt, kDt, motion);
      EXPECT_LT(predictionError(plan, 10.0 + shift * kDt, kDt, motion), 1e-9);
      const KinematicState& end = plan.knots.back();
      const Vector3 last = end.p + shift * kDt * end.v;
      EXPECT_LT((motion.point(kHorizon - 1, 3) - last).norm(), 1e-9);
    }
  }
}

TEST(Predict, BoxHoldsTheWholeMotion) {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Trajectory plan = wanderingPlan(random, randomState(random), 5.0, 0.0, kDt);
    const double epoch = random.uniform(0.0, 8.0);
    PredictedMotion motion;
    predict(plan, epoch, kDt, motion);
    for (int k = 0; k < kHorizon; ++k) {
      for (double s = 0.0; s <= 1.0; s += 0.1) {
        const Vector3 p = bernstein(motion.point(k, 0), motion.point(k, 1), motion.point(k, 2), motion.point(k, 3), s);
        EXPECT_TRUE((p.array() >= motion.box.min.array() - 1e-12).all());
        EXPECT_TRUE((p.array() <= motion.box.max.array() + 1e-12).all());
      }
    }
  }
}

TEST(Predict, AgainForgetsTheMotionBefore) {
  PredictedMotion motion;
  predict(straightPlan(Vector3(100, 100, 100), Vector3(1, 0, 0), 0.0, kDt), 0.0, kDt, motion);
  predictResting(Vector3(1, 2, 3), motion);
  for (const Vector3& point : motion.points) EXPECT_EQ(point, Vector3(1, 2, 3));
  EXPECT_EQ(motion.box.min, Vector3(1, 2, 3));
  EXPECT_EQ(motion.box.max, Vector3(1, 2, 3));
}

}  // namespace
}  // namespace swarm_planner
