// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, the planner predicts motions that no vehicle makes: the discretisation of (2) would not be exact.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "swarm_planner/model/kinematics.hpp"

namespace swarm_planner {
namespace {

KinematicState randomState(Random& random) {
  KinematicState x;
  x.p = random.vector(-100.0, 100.0);
  x.v = random.vector(-5.0, 5.0);
  x.a = random.vector(-10.0, 10.0);
  return x;
}

TEST(Kinematics, AgreesWithNumericalIntegration) {
  Random random(1);
  for (int n = 0; n < 100; ++n) {
    const KinematicState start = randomState(random);
    const Vector3 jerk = random.vector(-20.0, 20.0);
    const double dt = random.uniform(0.05, 0.5);

    // Leapfrog on p and the trapezoidal rule on v: second order, independent of the polynomials in the code.
    constexpr int kSteps = 2000;
    const double h = dt / kSteps;
    KinematicState x = start;
    for (int i = 0; i < kSteps; ++i) {
      const Vector3 half_velocity = x.v + 0.5 * h * x.a;
      x.p += h * half_velocity;
      x.a += h * jerk;
      x.v = half_velocity + 0.5 * h * x.a;
    }
    const KinematicState exact = propagate(start, jerk, dt);
    EXPECT_LT((exact.p - x.p).norm(), 1e-6);
    EXPECT_LT((exact.v - x.v).norm(), 1e-6);
    EXPECT_LT((exact.a - x.a).norm(), 1e-9);
  }
}

TEST(Kinematics, StepsAdd) {
  Random random(2);
  for (int n = 0; n < 100; ++n) {
    const KinematicState start = randomState(random);
    const Vector3 jerk = random.vector(-20.0, 20.0);
    const KinematicState once = propagate(start, jerk, 0.3);
    const KinematicState twice = propagate(propagate(start, jerk, 0.1), jerk, 0.2);
    EXPECT_LT((once.p - twice.p).norm(), 1e-12 * 100.0);
    EXPECT_LT((once.v - twice.v).norm(), 1e-12);
    EXPECT_LT((once.a - twice.a).norm(), 1e-12);
  }
}

TEST(Kinematics, NegativeTimeGoesBack) {
  Random random(3);
  const KinematicState start = randomState(random);
  const Vector3 jerk = random.vector(-20.0, 20.0);
  const KinematicState back = propagate(propagate(start, jerk, 0.3), jerk, -0.3);
  EXPECT_LT((back.p - start.p).norm(), 1e-11);
  EXPECT_LT((back.v - start.v).norm(), 1e-12);
  EXPECT_LT((back.a - start.a).norm(), 1e-12);
}

}  // namespace
}  // namespace swarm_planner
