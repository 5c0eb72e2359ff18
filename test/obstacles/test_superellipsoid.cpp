// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, obstacles have another shape for the planner than in the world, or crash it with a NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "obstacles/random_bodies.hpp"
#include "support/central_difference.hpp"

namespace swarm_planner {
namespace {

TEST(Superellipsoid, SumIsEquationSevenTermByTerm) {
  const Superellipsoid body(7, Vector3(1, 2, 3), Vector3(2, 4, 5), Vector3(3, 2.5, 4), 0.0, Vector3::Zero());
  const double expected = std::pow(0.5, 3) + std::pow(0.25, 2.5) + std::pow(0.4, 4);
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      for (const double z : {2.0, -2.0}) EXPECT_NEAR(body.sum(Vector3(x, y, z)), expected, 1e-15);
    }
  }
}

TEST(Superellipsoid, YawTurnsCounterclockwise) {
  // A long body turned by a quarter points along y; by an eighth along the diagonal.
  const Vector3 radii(10, 1, 1);
  const Superellipsoid quarter(1, Vector3::Zero(), radii, Vector3(2, 4, 6), M_PI / 2, Vector3::Zero());
  EXPECT_NEAR(quarter.gauge(Vector3(0, 10, 0)).value, 1.0, 1e-12);
  EXPECT_NEAR(quarter.gauge(Vector3(1, 0, 0)).value, 1.0, 1e-12);
  const Superellipsoid eighth(1, Vector3::Zero(), radii, Vector3(2, 4, 6), M_PI / 4, Vector3::Zero());
  EXPECT_NEAR(eighth.gauge(Vector3(1, 1, 0) * 10.0 / std::sqrt(2.0)).value, 1.0, 1e-12);
  EXPECT_NEAR(eighth.gauge(Vector3(1, -1, 0) / std::sqrt(2.0)).value, 1.0, 1e-12);
}

TEST(Superellipsoid, MovesAtItsVelocityOnly) {
  const Superellipsoid body(3, Vector3(1, 2, 3), Vector3(2, 4, 5), Vector3(3, 2.5, 4), 0.3, Vector3(1, -2, 0.5));
  const Superellipsoid moved = body.movedBy(2.0);
  EXPECT_LT((moved.center() - Vector3(3, -2, 4)).norm(), 1e-15);
  EXPECT_EQ(moved.id(), 3);
  EXPECT_EQ(moved.velocity(), body.velocity());
  const Vector3 u(3, 4, 5);
  EXPECT_EQ(moved.gauge(u).value, body.gauge(u).value);
}

TEST(Superellipsoid, SumHasItsDerivatives) {
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    const Superellipsoid body = randomBody(random, 0.5, 5.0);
    const double p = body.exponents().maxCoeff();
    const Vector3 u = randomOffset(random, body, random.uniform(0.5, 1.0 + 2.0 / p));
    Vector3 gradient;
    Matrix3 hessian;
    const double value = body.sum(u, gradient, hessian);
    EXPECT_NEAR(value, body.sum(u), 1e-13 * p * value);

    // The sum changes on a length of the least radius over the largest exponent.
    const double scale = body.radii().minCoeff() / p;
    const auto sum = [&](const Vector3& v) { return body.sum(v); };
    const auto slope = [&](const Vector3& v) {
      Vector3 g;
      Matrix3 ignored;
      body.sum(v, g, ignored);
      return g;
    };
    // Rounding of the argument is magnified by the exponent.
    const double size = (1.0 + value) * (10.0 + p);
    EXPECT_LT((gradient - centralGradient(sum, u, scale)).norm() * scale, 1e-10 * size);
    EXPECT_LT((hessian - centralJacobian(slope, u, scale)).norm() * scale * scale, 1e-10 * size);
  }
}

TEST(Superellipsoid, BoxAndSphereContainTheBody) {
  Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    for (int i = 0; i < 20; ++i) {
      const Vector3 on_surface = randomOffset(random, body, 1.0);
      EXPECT_LE(on_surface.norm(), body.boundingRadius() * (1.0 + 1e-12));
      EXPECT_TRUE((on_surface.cwiseAbs().array() <= body.halfExtents().array() * (1.0 + 1e-12)).all());
    }
  }
}

TEST(Superellipsoid, BoundsAreTightForEllipsoids) {
  const Superellipsoid body(1, Vector3::Zero(), Vector3(3, 1, 2), Vector3(2, 2, 2), M_PI / 4, Vector3::Zero());
  EXPECT_NEAR(body.boundingRadius(), 3.0, 1e-12);
  EXPECT_NEAR(body.halfExtents().x(), std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(body.halfExtents().y(), std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(body.halfExtents().z(), 2.0, 1e-12);
  const Superellipsoid straight(1, Vector3::Zero(), Vector3(3, 1, 2), Vector3(2, 9, 5), 0.0, Vector3::Zero());
  EXPECT_LT((straight.halfExtents() - Vector3(3, 1, 2)).norm(), 1e-12);
}

TEST(Superellipsoid, RefusesWhatIsNoConvexBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto make = [](const Vector3& center, const Vector3& radii, const Vector3& exponents, double yaw,
                       const Vector3& velocity) { return Superellipsoid(1, center, radii, exponents, yaw, velocity); };
  const Vector3 zero = Vector3::Zero();
  const Vector3 ones = Vector3::Ones();
  const Vector3 twos = 2.0 * ones;
  EXPECT_NO_THROW(make(zero, ones, twos, 0.0, zero));
  for (const double bad : {0.0, -1.0, nan, infinity, 1e-320}) {
    EXPECT_THROW(make(zero, Vector3(1, bad, 1), twos, 0.0, zero), std::invalid_argument) << bad;
  }
  for (const double bad : {1.99, 0.0, -2.0, nan, infinity}) {
    EXPECT_THROW(make(zero, ones, Vector3(2, 2, bad), 0.0, zero), std::invalid_argument) << bad;
  }
  for (const double bad : {nan, infinity}) {
    EXPECT_THROW(make(Vector3(bad, 0, 0), ones, twos, 0.0, zero), std::invalid_argument);
    EXPECT_THROW(make(zero, ones, twos, bad, zero), std::invalid_argument);
    EXPECT_THROW(make(zero, ones, twos, 0.0, Vector3(0, bad, 0)), std::invalid_argument);
  }
}

TEST(Superellipsoid, AtALevelHasItsSurfaceWhereTheSumIsThatLevel) {
  const Superellipsoid body(3, Vector3(1, 2, 3), Vector3(0.5, 2, 4), Vector3(2, 3.5, 8), 0.4, Vector3(1, 0, 0));
  const Superellipsoid grown = body.atLevel(1.3);
  for (const Vector3& u : {Vector3(0.3, 1, 2), Vector3(-0.7, 0.2, 3), Vector3(0, -3, 1)}) {
    const Vector3 surface = u / grown.gauge(u).value;
    EXPECT_NEAR(body.sum(surface), 1.3, 1e-9);
  }
  EXPECT_EQ(grown.center(), body.center());
  EXPECT_EQ(grown.velocity(), body.velocity());
}

}  // namespace
}  // namespace swarm_planner
