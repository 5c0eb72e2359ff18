// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, clearances are reported that do not hold: the check would pass plans too close to obstacles, and the
// figures of every experiment would be wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "obstacles/random_bodies.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {
namespace {

/// Smallest distance from `point` to surface points: a coarse sample of directions, refined around the best.
double distanceBySampling(const Superellipsoid& body, const Vector3& point, Random& random) {
  double best = std::numeric_limits<double>::infinity();
  Vector3 best_direction = Vector3::UnitX();
  double spread = 2.0;
  for (int round = 0; round < 100; ++round) {
    const Vector3 center = best_direction;
    for (int i = 0; i < 80; ++i) {
      // Directions scaled by the body's radii cover thin bodies evenly.
      const Vector3 direction = (center + spread * random.direction()).normalized();
      const double c = std::cos(body.yaw());
      const double s = std::sin(body.yaw());
      const Vector3 scaled = direction.cwiseProduct(body.radii());
      const Vector3 u(c * scaled.x() - s * scaled.y(), s * scaled.x() + c * scaled.y(), scaled.z());
      const double distance = (point - body.center() - u / body.gauge(u).value).norm();
      if (distance < best) {
        best = distance;
        best_direction = direction;
      }
    }
    spread *= 0.85;
  }
  return best;
}

TEST(SignedDistance, AgreesWithSamplingTheSurface) {
  Random random(1);
  for (int n = 0; n < 300; ++n) {
    const Superellipsoid body = randomBody(random, 0.5, 5.0);
    const Vector3 point = body.center() + randomOffset(random, body, random.uniform(1.0, 5.0));
    const double sampled = distanceBySampling(body, point, random);
    const double exact = body.signedDistance(point);
    EXPECT_LE(exact, sampled + 1e-9) << body.exponents().transpose();
    EXPECT_NEAR(exact, sampled, 1e-3 * (sampled + body.radii().minCoeff())) << body.exponents().transpose();
  }
}

TEST(SignedDistance, FindsTheFootOfANormal) {
  // From a surface point outwards along the normal, the distance is the length of the way: exact for convex bodies.
  Random random(2);
  for (int n = 0; n < 20000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const Vector3 foot = randomOffset(random, body, 1.0);
    const Vector3 normal = body.gauge(foot).gradient.normalized();
    const double away = body.radii().minCoeff() * random.logUniform(1e-6, 1e4);
    const double distance = body.signedDistance(body.center() + foot + away * normal);
    // The foot itself is rounded in world coordinates, which the exponents magnify.
    const double rounding = 1e-13 * (body.center().norm() + body.boundingRadius()) * body.exponents().maxCoeff();
    EXPECT_NEAR(distance, away, 1e-9 * away + rounding) << body.exponents().transpose();
  }
}

TEST(SignedDistance, GivesTheNormalAtTheFoot) {
  Random random(8);
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const Vector3 point = body.center() + randomOffset(random, body, random.logUniform(0.1, 100.0));
    Vector3 normal;
    const double distance = body.signedDistance(point, normal);
    ASSERT_EQ(distance, body.signedDistance(point));
    ASSERT_NEAR(normal.norm(), 1.0, 1e-12);
    if (distance < 0.0) continue;
    // Whatever lies further along it is as much farther away, however curved the body.
    const double further = random.logUniform(1e-2, 1e2) * distance;
    ASSERT_NEAR(body.signedDistance(point + further * normal), distance + further,
                1e-8 * (distance + further + body.boundingRadius()))
        << body.exponents().transpose();
  }
}

TEST(SignedDistance, IsThatOfSpheresAndBoxes) {
  const Superellipsoid sphere(1, Vector3(1, 2, 3), Vector3::Constant(2.0), Vector3::Constant(2.0), 0.0,
                              Vector3::Zero());
  EXPECT_NEAR(sphere.signedDistance(Vector3(1, 2, 8)), 3.0, 1e-12);
  EXPECT_NEAR(sphere.signedDistance(Vector3(1, 2, 4)), -1.0, 1e-12);
  EXPECT_NEAR(sphere.signedDistance(Vector3(1, 2, 3)), -2.0, 1e-12);
  // Exponents of 1000 make a box but for rounded edges.
  const Superellipsoid box(1, Vector3::Zero(), Vector3(1, 2, 3), Vector3::Constant(1000.0), M_PI / 2, Vector3::Zero());
  EXPECT_NEAR(box.signedDistance(Vector3(0.5, 4.0, 1.0)), 3.0, 1e-2);
  EXPECT_NEAR(box.signedDistance(Vector3(5.0, 5.0, 3.0 + 4.0)), std::sqrt(9.0 + 16.0 + 16.0), 1e-2);
}

TEST(SignedDistance, IsOneLipschitzOutside) {
  Random random(3);
  for (int n = 0; n < 20000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const Vector3 a = body.center() + randomOffset(random, body, random.uniform(1.0, 5.0));
    const Vector3 b = a + random.logUniform(1e-6, 10.0) * random.direction();
    const double at_b = body.signedDistance(b);
    if (at_b <= 0.0) continue;
    EXPECT_LE(std::abs(body.signedDistance(a) - at_b), (a - b).norm() * (1.0 + 1e-9) + 1e-10);
  }
}

TEST(SignedDistance, RespectsItsBounds) {
  Random random(4);
  for (int n = 0; n < 20000; ++n) {
    const Superellipsoid body = randomBody(random, 0.01, 100.0);
    const Vector3 u = randomOffset(random, body, random.logUniform(1.0, 1e4));
    const Vector3 point = body.center() + u;
    const Gauge gauge = body.gauge(point - body.center());
    const double distance = body.signedDistance(point);
    const double rounding = 1e-9 * (distance + body.radii().minCoeff());
    EXPECT_GE(distance, (gauge.value - 1.0) / gauge.gradient.norm() - rounding) << body.exponents().transpose();
    EXPECT_LE(distance, u.norm() * (1.0 - 1.0 / gauge.value) + rounding) << body.exponents().transpose();
    EXPECT_LE(body.distanceLowerBound(point), distance + rounding) << body.exponents().transpose();
    EXPECT_LE(u.norm() - body.boundingRadius(), distance + rounding);
  }
}

TEST(SignedDistance, HasTheSignOfTheSumAndIsContinuousAcrossTheSurface) {
  Random random(5);
  for (int n = 0; n < 5000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const Vector3 foot = randomOffset(random, body, 1.0);
    EXPECT_GT(body.signedDistance(body.center() + 1.001 * foot), 0.0);
    EXPECT_LT(body.signedDistance(body.center() + 0.999 * foot), 0.0);
    for (const double step : {1e-3, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12}) {
      const double outside = body.signedDistance(body.center() + (1.0 + step) * foot);
      const double inside = body.signedDistance(body.center() + (1.0 - step) * foot);
      EXPECT_LE(std::abs(outside - inside), 2.0 * step * foot.norm() + 1e-12);
    }
  }
}

TEST(SignedDistance, InsideIsTheDepthBelowTheSupportingPlane) {
  Random random(6);
  for (int n = 0; n < 2000; ++n) {
    const Superellipsoid body = randomBody(random, 0.1, 10.0);
    const Vector3 u = randomOffset(random, body, random.uniform(0.01, 0.99));
    const Gauge gauge = body.gauge(u);
    EXPECT_NEAR(body.signedDistance(body.center() + u), -(1.0 - gauge.value) / gauge.gradient.norm(),
                1e-9 * body.radii().minCoeff());
  }
}

TEST(SignedDistance, SurvivesExtremes) {
  Random random(7);
  for (int n = 0; n < 20000; ++n) {
    const Superellipsoid body = randomBody(random, 1e-3, 1e3);
    Vector3 u = randomOffset(random, body, 1.0);
    if (random.integer(0, 2) == 0) u[random.integer(0, 2)] = 0.0;
    if (random.integer(0, 2) == 0) u[random.integer(0, 2)] *= 1e-200;
    if (u.norm() == 0.0) continue;
    u *= random.logUniform(1e-9, 1e6);
    const double distance = body.signedDistance(body.center() + u);
    ASSERT_TRUE(std::isfinite(distance)) << body.exponents().transpose();
    ASSERT_LE(distance, u.norm());
    if (distance < 0.0) {
      ASSERT_GE(distance, -body.boundingRadius() * (1.0 + 1e-12));
    } else {
      ASSERT_GE(distance, body.distanceLowerBound(body.center() + u) - 1e-9 * (u.norm() + body.boundingRadius()));
    }
  }
}

// A yaw of rounding alone turns an offset along one axis into one of 1e-312 m along another.
TEST(SignedDistance, OffsetsThatUnderflowCountAsNone) {
  for (const double yaw : {1e-323, 1.2e-313, 1e-300, 1e-250}) {
    const Superellipsoid body(1, Vector3(11, 2, 0.5), Vector3(1, 2, 2), Vector3(2, 3.5, 8), yaw, Vector3::Zero());
    const Superellipsoid straight(1, body.center(), body.radii(), body.exponents(), 0.0, Vector3::Zero());
    const Vector3 point(1.0, 2.0, 3.0);
    Vector3 normal;
    EXPECT_NEAR(body.signedDistance(point, normal), straight.signedDistance(point), 1e-9) << yaw;
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12) << yaw;
    EXPECT_TRUE(body.gauge(point - body.center()).gradient.allFinite()) << yaw;
  }
}

TEST(SignedDistance, LowerBoundIsExactInFrontOfAFace) {
  const Superellipsoid body(1, Vector3(1, 1, 1), Vector3(1, 2, 3), Vector3(4, 4, 4), 0.0, Vector3::Zero());
  EXPECT_NEAR(body.distanceLowerBound(Vector3(5, 1, 1)), 3.0, 1e-12);
  EXPECT_EQ(body.distanceLowerBound(Vector3(1.9, 2.9, 3.9)), 0.0);
}

TEST(PairGauge, IsAnEllipsoidWithItsOwnVerticalAxis) {
  EXPECT_DOUBLE_EQ(pairGauge(Vector3(1.2, 1.6, 0.0), 2.0, 4.0), 1.0);
  EXPECT_DOUBLE_EQ(pairGauge(Vector3(0.0, 0.0, -4.0), 2.0, 4.0), 1.0);
  EXPECT_LT(pairGauge(Vector3(0.0, 0.0, 3.9), 2.0, 4.0), 1.0);
  EXPECT_GT(pairGauge(Vector3(1.9, 0.0, 3.9), 2.0, 4.0), 1.0);
  EXPECT_EQ(pairGauge(Vector3::Zero(), 2.0, 4.0), 0.0);
  LimitParameters limits;
  limits.pair_distance = 1.0;
  limits.pair_distance_vertical = 3.0;
  EXPECT_DOUBLE_EQ(pairGauge(Vector3(0.0, 0.5, 1.5), limits), std::sqrt(0.5));
}

}  // namespace
}  // namespace swarm_planner
