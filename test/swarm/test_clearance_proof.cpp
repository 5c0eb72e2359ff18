// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The bounds that proofs of clearance rest on: on the wrong side they would prove what is false.
#include <gtest/gtest.h>

#include <cmath>

#include "check_scene.hpp"
#include "obstacles/random_bodies.hpp"
#include "swarm_planner/swarm/clearance_proof.hpp"

namespace swarm_planner {
namespace {

TEST(SupportBound, LiesBeyondTheBodyAndTouchesIt) {
  Random random(8);
  for (int n = 0; n < 3000; ++n) {
    const Superellipsoid body = randomBody(random, 0.05, 5.0);
    const Vector3 foot = randomOffset(random, body, 1.0);
    const Vector3 normal = body.gauge(foot).gradient.normalized();
    const double bound = supportBound(body, normal);
    const double scale = body.boundingRadius();
    ASSERT_NEAR(bound, normal.dot(foot), 1e-9 * scale) << body.exponents().transpose();
    for (int i = 0; i < 20; ++i) {
      ASSERT_GE(bound, normal.dot(randomOffset(random, body, 1.0)) - 1e-11 * scale);
    }
  }
}

TEST(DistanceBound, IsNeverAboveTheDistanceAndExactBesideASphere) {
  Random random(10);
  for (int n = 0; n < 3000; ++n) {
    const Superellipsoid body = randomBody(random, 0.05, 5.0);
    const Vector3 u = randomOffset(random, body, random.logUniform(1.0, 100.0));
    const double distance = body.signedDistance(body.center() + u);
    ASSERT_LE(distanceBound(body, u), distance + 1e-9 * (distance + body.boundingRadius()));
    ASSERT_GE(distanceBound(body, u), u.norm() - 2.0 * body.boundingRadius());
  }
  const Superellipsoid sphere(1, Vector3::Zero(), Vector3::Ones(), Vector3::Constant(2.0), 0.4, Vector3::Zero());
  EXPECT_NEAR(distanceBound(sphere, Vector3(0.0, 0.0, 3.0)), 2.0, 1e-9);
}

}  // namespace
}  // namespace swarm_planner
