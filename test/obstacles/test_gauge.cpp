// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, the planner's half-spaces cut into obstacles, or the gauge answers with a NaN: UAVs hit obstacles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "obstacles/random_bodies.hpp"
#include "support/central_difference.hpp"

namespace swarm_planner {
namespace {

/// min { s : S(u / s) <= level } by bisection on the definition.
double gaugeByBisection(const Superellipsoid& body, const Vector3& u, double level) {
  double low = 1e-20;
  double high = 1e20;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (body.sum(u / middle) <= level ? high : low) = middle;
  }
  return high;
}

double randomLevel(Random& random) {
  switch (random.integer(0, 2)) {
    case 0:
      return 1.0;
    case 1:
      return std::exp(0.01);
    default:
      return std::exp(random.uniform(0.0, 5.0));
  }
}

TEST(Gauge, IsItsDefinition) {
  Random random(1);
  for (int n = 0; n < 3000; ++n) {
    const Superellipsoid body = randomBody(random, 0.01, 100.0);
    const Vector3 u = randomOffset(random, body, random.logUniform(1e-3, 1e3));
    const double level = randomLevel(random);
    const double value = body.gauge(u, level).value;
    EXPECT_NEAR(value, gaugeByBisection(body, u, level), 1e-12 * value) << body.exponents().transpose();
  }
}

TEST(Gauge, HasItsGradient) {
  Random random(2);
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.5, 5.0);
    const double level = randomLevel(random);
    const Vector3 u = randomOffset(random, body, random.uniform(0.3, 5.0));
    const Gauge gauge = body.gauge(u, level);
    // Where two terms balance, the gradient turns on a length of the least radius over the largest exponent.
    const double scale = body.radii().minCoeff() * gauge.value / body.exponents().maxCoeff();
    const auto value = [&](const Vector3& v) { return body.gauge(v, level).value; };
    EXPECT_LT((gauge.gradient - centralGradient(value, u, scale)).norm(),
              1e-8 * gauge.gradient.norm() * body.exponents().maxCoeff())
        << body.exponents().transpose();
  }
}

TEST(Gauge, IsPositivelyHomogeneous) {
  Random random(3);
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.01, 100.0);
    const Vector3 u = randomOffset(random, body, 1.0);
    const double level = randomLevel(random);
    const Gauge gauge = body.gauge(u, level);
    const double factor = random.logUniform(1e-9, 1e6);
    const Gauge scaled = body.gauge(factor * u, level);
    EXPECT_NEAR(scaled.value, factor * gauge.value, 1e-12 * factor * gauge.value);
    EXPECT_LT((scaled.gradient - gauge.gradient).norm(), 1e-10 * gauge.gradient.norm());
    EXPECT_NEAR(gauge.gradient.dot(u), gauge.value, 1e-12 * gauge.value);  // Euler
  }
}

TEST(Gauge, IsConvex) {
  Random random(4);
  for (int n = 0; n < 20000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const Vector3 u = randomOffset(random, body, random.uniform(0.1, 5.0));
    const Vector3 v = randomOffset(random, body, random.uniform(0.1, 5.0));
    const Gauge at_u = body.gauge(u);
    const double at_v = body.gauge(v).value;
    const double fraction = random.uniform(0.0, 1.0);
    EXPECT_LE(body.gauge(fraction * u + (1.0 - fraction) * v).value,
              fraction * at_u.value + (1.0 - fraction) * at_v + 1e-11);
    EXPECT_GE(at_v, at_u.value + at_u.gradient.dot(v - u) - 1e-11 * (1.0 + at_u.gradient.norm() * (v - u).norm()));
  }
}

TEST(Gauge, HalfSpacesLieInTheFreeSet) {
  // {x : phi(x0) + grad . (x - x0) >= 1} must not meet the obstacle S < e^eps_s, from wherever it is linearised.
  Random random(5);
  for (int n = 0; n < 20000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const double level = std::exp(0.01);
    const Vector3 start = randomOffset(random, body, random.logUniform(0.01, 100.0));
    const Gauge gauge = body.gauge(start, level);
    Vector3 inside = randomOffset(random, body, 1.0);
    inside *= 0.999999 / body.gauge(inside, level).value;
    ASSERT_LT(body.sum(inside), level);
    EXPECT_LT(gauge.value + gauge.gradient.dot(inside - start), 1.0);
  }
}

TEST(Gauge, HalfSpacesMovedOutKeepTheMetricClearance) {
  // grad . u >= 1 + r |grad| must imply a distance of r to the surface: the row that the planner imposes.
  Random random(6);
  for (int n = 0; n < 3000; ++n) {
    const Superellipsoid body = randomBody(random, 0.2, 5.0);
    const double clearance = random.uniform(0.1, 1.0);
    const Gauge gauge = body.gauge(randomOffset(random, body, random.uniform(0.5, 4.0)));
    const Vector3 normal = gauge.gradient.normalized();
    Vector3 u = random.vector(-10.0, 10.0);
    u += normal * ((1.0 / gauge.gradient.norm() + clearance) - normal.dot(u));  // onto the plane
    EXPECT_GE(body.signedDistance(body.center() + u), clearance * (1.0 - 1e-8));
  }
}

TEST(Gauge, SurvivesExtremes) {
  Random random(7);
  for (int n = 0; n < 20000; ++n) {
    const Superellipsoid body = randomBody(random, 1e-3, 1e3);
    Vector3 u = randomOffset(random, body, 1.0);
    // Exactly on axes, next to them, in the middle of edges; from deep inside to far away.
    if (random.integer(0, 2) == 0) u[random.integer(0, 2)] = 0.0;
    if (random.integer(0, 2) == 0) u[random.integer(0, 2)] *= 1e-200;
    if (u.norm() == 0.0) continue;
    u *= random.logUniform(1e-9, 1e6);
    // Turning a thin body rounds its short axis to epsilon of the long one.
    const double aspect = body.radii().maxCoeff() / body.radii().minCoeff();
    const double tolerance = body.exponents().maxCoeff() * (1e-12 + 1e-15 * aspect);
    for (const double level : {1.0, std::exp(0.01), std::exp(1.0), std::exp(20.0)}) {
      const Gauge gauge = body.gauge(u, level);
      ASSERT_TRUE(std::isfinite(gauge.value) && gauge.value > 0.0) << body.exponents().transpose();
      ASSERT_TRUE(gauge.gradient.allFinite()) << body.exponents().transpose();
      ASSERT_NEAR(std::log(body.sum(u / gauge.value) / level), 0.0, tolerance)
          << body.exponents().transpose() << " u " << u.transpose();
    }
  }
}

TEST(Gauge, HasASubgradientAtTheCentre) {
  Random random(8);
  for (int n = 0; n < 200; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const double level = randomLevel(random);
    const Gauge center = body.gauge(Vector3::Zero(), level);
    EXPECT_EQ(center.value, 0.0);
    EXPECT_GT(center.gradient.norm(), 0.0);
    for (int i = 0; i < 20; ++i) {
      const Vector3 u = random.vector(-5.0, 5.0);
      EXPECT_GE(body.gauge(u, level).value, center.gradient.dot(u) - 1e-12);
    }
  }
}

TEST(Gauge, PassesNotANumberOn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3& exponents : {Vector3(2, 2, 2), Vector3(4, 4, 4), Vector3(2, 2, 8), Vector3(2.5, 3.5, 4.5)}) {
    const Superellipsoid body(1, Vector3::Zero(), Vector3(1, 2, 3), exponents, 0.3, Vector3::Zero());
    EXPECT_TRUE(std::isnan(body.gauge(Vector3(nan, 1, 1)).value));
    EXPECT_TRUE(std::isnan(body.gauge(Vector3(1, 1, nan)).value));
    EXPECT_TRUE(std::isnan(body.signedDistance(Vector3(1, 1, nan))));
  }
}

}  // namespace
}  // namespace swarm_planner
