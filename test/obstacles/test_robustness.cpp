// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, UAVs are pushed the wrong way near obstacles, or the QP is not convex and has no answer.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "obstacles/random_bodies.hpp"
#include "support/central_difference.hpp"
#include "swarm_planner/obstacles/robustness.hpp"

namespace swarm_planner {
namespace {

RobustnessParameters randomParameters(Random& random) {
  RobustnessParameters parameters;
  parameters.gain = random.logUniform(0.1, 10.0);
  parameters.inner = random.uniform(1.05, 1.5);
  parameters.outer = parameters.inner + random.uniform(0.5, 2.0);
  parameters.epsilon = random.uniform(0.0, 0.1);
  return parameters;
}

/// The summand of (8) as printed, with f of (12).
double robustnessAsPrinted(const Superellipsoid& body, const Vector3& point, const RobustnessParameters& parameters) {
  const auto f = [](double t) { return t > 0.0 ? std::exp(-1.0 / t) : 0.0; };
  const Vector3 u = point - body.center();
  const double t = body.sum(u);
  const double g = f(parameters.outer - t) / (f(parameters.outer - t) + f(t - parameters.inner));
  const double r = body.radii().maxCoeff();
  const double h = std::log((u / r).squaredNorm());
  return parameters.gain * g * std::exp(parameters.epsilon - h);
}

/// A point whose sum S is between the surface and a little beyond r_b, spread over the values in between.
Vector3 pointInBand(Random& random, const Superellipsoid& body, const RobustnessParameters& parameters) {
  const Vector3 surface = randomOffset(random, body, 1.0);
  const double level = random.uniform(0.9, parameters.outer);
  return body.center() + surface / body.gauge(surface, level).value;
}

TEST(Robustness, IsEquationsEightToTwelve) {
  Random random(1);
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.5, 5.0);
    const RobustnessParameters parameters = randomParameters(random);
    const Vector3 point = pointInBand(random, body, parameters);
    const double expected = robustnessAsPrinted(body, point, parameters);
    EXPECT_NEAR(robustness(body, point, parameters).value, expected, 1e-11 * (1.0 + expected));
    EXPECT_NEAR(robustnessValue(body, point, parameters), expected, 1e-11 * (1.0 + expected));
  }
}

TEST(Robustness, HasItsDerivatives) {
  Random random(2);
  int in_transition = 0;
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.5, 5.0);
    const double p = body.exponents().maxCoeff();
    const RobustnessParameters parameters = randomParameters(random);
    const Vector3 point = pointInBand(random, body, parameters);
    const Robustness at_point = robustness(body, point, parameters);

    const double s = body.sum(point - body.center());
    if (s > parameters.inner && s < parameters.outer) ++in_transition;
    const double scale = 0.1 * body.radii().minCoeff() / p;
    const auto value = [&](const Vector3& x) { return robustness(body, x, parameters).value; };
    const auto slope = [&](const Vector3& x) { return robustness(body, x, parameters).gradient; };
    const double radius = body.radii().maxCoeff();
    const double size = parameters.gain * radius * radius / (point - body.center()).squaredNorm() * (10.0 + p);
    EXPECT_LT((at_point.gradient - centralGradient(value, point, scale)).norm() * scale, 1e-9 * size);
    EXPECT_LT((at_point.hessian - centralJacobian(slope, point, scale)).norm() * scale * scale, 1e-9 * size);
  }
  EXPECT_GT(in_transition, 2000);
}

TEST(Robustness, PushesAwayFromTheObstacle) {
  Random random(3);
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.5, 5.0);
    const RobustnessParameters parameters = randomParameters(random);
    const Vector3 point = pointInBand(random, body, parameters);
    const Robustness at_point = robustness(body, point, parameters);
    if (at_point.value == 0.0) continue;
    EXPECT_LT(at_point.gradient.dot(point - body.center()), 0.0);
  }
}

TEST(Robustness, IsExactlyZeroOutside) {
  Random random(4);
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const RobustnessParameters parameters = randomParameters(random);
    const Vector3 surface = randomOffset(random, body, 1.0);
    const double factor = random.logUniform(1.0 + 1e-9, 1e6) / body.gauge(surface, parameters.outer).value;
    const Robustness far = robustness(body, body.center() + factor * surface, parameters);
    EXPECT_EQ(far.value, 0.0);
    EXPECT_EQ(far.gradient.norm(), 0.0);
    EXPECT_EQ(far.hessian.norm(), 0.0);
    EXPECT_EQ(far.projected.norm(), 0.0);
  }
}

TEST(Robustness, WithoutGainIsZero) {
  RobustnessParameters parameters;
  parameters.gain = 0.0;
  const Superellipsoid body;
  EXPECT_EQ(robustness(body, Vector3(1.01, 0, 0), parameters).value, 0.0);
  EXPECT_EQ(robustness(body, Vector3(1.01, 0, 0), parameters).hessian.norm(), 0.0);
}

TEST(Robustness, ProjectedHessianIsTheNearestConvexOne) {
  Random random(5);
  for (int n = 0; n < 3000; ++n) {
    const Superellipsoid body = randomBody(random, 0.5, 5.0);
    const RobustnessParameters parameters = randomParameters(random);
    const Vector3 point = pointInBand(random, body, parameters);
    const Robustness at_point = robustness(body, point, parameters);
    const double size = at_point.hessian.norm();
    if (size < 1e-100) continue;  // its square, used below, would underflow
    EXPECT_LT((at_point.projected - at_point.projected.transpose()).norm(), 1e-13 * size);
    const Vector3 kept = Eigen::SelfAdjointEigenSolver<Matrix3>(at_point.projected).eigenvalues();
    const Vector3 removed = Eigen::SelfAdjointEigenSolver<Matrix3>(at_point.projected - at_point.hessian).eigenvalues();
    EXPECT_GE(kept.minCoeff(), -1e-13 * size);
    EXPECT_GE(removed.minCoeff(), -1e-13 * size);
    // Nearest: what was removed is orthogonal to what was kept.
    EXPECT_LT((at_point.projected * (at_point.projected - at_point.hessian)).norm(), 1e-12 * size * size);
  }
}

/// Second largest eigenvalue of the Hessian over the largest absolute one.
double secondCurvature(const Superellipsoid& body, const Vector3& point, const RobustnessParameters& parameters) {
  const Vector3 eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix3>(robustness(body, point, parameters).hessian).eigenvalues();
  return eigenvalues[1] / eigenvalues.cwiseAbs().maxCoeff();
}

TEST(Robustness, HasOnePositiveCurvatureWithTheDefaultBand) {
  // A solver may take the default function's curvature as one row per obstacle and stage.
  Random random(6);
  const RobustnessParameters parameters{CostParameters()};
  for (int n = 0; n < 100000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const Vector3 point = pointInBand(random, body, parameters);
    if (robustness(body, point, parameters).value < 1e-6) continue;
    EXPECT_LT(secondCurvature(body, point, parameters), 1e-6) << body.exponents().transpose();
  }
}

TEST(Robustness, HasASecondPositiveCurvatureInAWideBand) {
  // Why no rank is promised: beside the flank of a long body the second curvature is a quarter of the first.
  RobustnessParameters parameters{CostParameters()};
  parameters.inner = 1.01;
  parameters.outer = 20.0;
  const Superellipsoid body(1, Vector3::Zero(), Vector3(13.13, 0.5577, 1.381), Vector3(41.7, 2.0, 17.2), 0.0,
                            Vector3::Zero());
  EXPECT_GT(secondCurvature(body, Vector3(7.845, 1.554, 0.4304), parameters), 0.2);
}

TEST(Robustness, StaysFiniteInTheObstaclesCore) {
  const RobustnessParameters parameters{CostParameters()};
  Random random(7);
  for (int n = 0; n < 1000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const double away = n == 0 ? 0.0 : random.logUniform(1e-300, 1e-1);
    const Robustness at_point = robustness(body, body.center() + away * random.direction(), parameters);
    EXPECT_TRUE(std::isfinite(at_point.value));
    EXPECT_TRUE(at_point.gradient.allFinite());
    EXPECT_TRUE(at_point.projected.allFinite());
  }
}

TEST(SmoothStep, IsEquationElevenWithItsDerivatives) {
  const auto f = [](double t) { return t > 0.0 ? std::exp(-1.0 / t) : 0.0; };
  Random random(8);
  for (int n = 0; n < 5000; ++n) {
    const double inner = random.uniform(1.0, 2.0);
    const double width = random.uniform(0.3, 3.0);
    const double outer = inner + width;
    const double t = random.uniform(inner - 0.2, outer + 0.2);
    const SmoothStep step = smoothStep(t, inner, outer);
    EXPECT_NEAR(step.value, f(outer - t) / (f(outer - t) + f(t - inner)), 1e-13);

    const double h = 0.1 * differenceStep() * width;
    const SmoothStep before = smoothStep(t - h, inner, outer);
    const SmoothStep after = smoothStep(t + h, inner, outer);
    const double slope = (after.value - before.value) / (2.0 * h);
    const double curvature = (after.first - before.first) / (2.0 * h);
    const double steepness = 1.0 + 1.0 / (width * width);
    EXPECT_NEAR(step.first, slope, 1e-8 * std::pow(steepness, 2));
    EXPECT_NEAR(step.second, curvature, 1e-8 * std::pow(steepness, 3));
  }
}

TEST(SmoothStep, IsExactAndFiniteAtItsEnds) {
  for (const double width : {1e-6, 1e-3, 1.0, 100.0}) {
    for (const double from_end : {0.0, 1e-300, 1e-16, 1e-9, 1e-4, 1e-3, 1e-2}) {
      if (from_end > 0.1 * width) continue;
      const SmoothStep inside = smoothStep(1.2 + from_end, 1.2, 1.2 + width);
      EXPECT_NEAR(inside.value, 1.0, 1e-12);
      EXPECT_TRUE(std::isfinite(inside.first) && std::isfinite(inside.second));
      const SmoothStep outside = smoothStep(1.2 + width - from_end, 1.2, 1.2 + width);
      EXPECT_NEAR(outside.value, 0.0, 1e-12);
      EXPECT_TRUE(std::isfinite(outside.first) && std::isfinite(outside.second));
    }
    EXPECT_EQ(smoothStep(1.2, 1.2, 1.2 + width).value, 1.0);
    EXPECT_EQ(smoothStep(1.2 + width, 1.2, 1.2 + width).value, 0.0);
  }
}

}  // namespace
}  // namespace swarm_planner
