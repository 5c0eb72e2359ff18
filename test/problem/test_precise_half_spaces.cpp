// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"
#include "swarm_planner/problem/moving_body.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;

// Beside the edge of a thin wall the half-space towards its centre is that of its face: it lets nobody round the edge.
TEST(MovingBody, PreciseHalfSpacesSupportTheBodyAndLeadRoundTheEdgeOfAWall) {
  const Superellipsoid wall(1, Vector3(2, 1, 3), Vector3(0.5, 7, 5), Vector3::Constant(10.0), 0.0, Vector3::Zero());
  const MovingBody usual = MovingBody::fromObstacle(wall, kDt, 1.0, 0.36);
  MovingBody precise = usual;
  precise.setPrecise();
  const Vector3 beside(-0.9, -7.5, 0);
  EXPECT_GT(std::abs(usual.supportingHalfSpace(beside).n.x()), 0.99);
  EXPECT_LT(precise.supportingHalfSpace(beside).n.y(), -0.5);
  EXPECT_NEAR(precise.supportingHalfSpace(beside).clearance(beside), wall.signedDistance(wall.center() + beside) - 0.36,
              1e-9);

  Random random(5);
  for (int n = 0; n < 500; ++n) {
    const Vector3 r = random.vector(-9.0, 9.0);
    if (wall.signedDistance(wall.center() + r) < 0.1) continue;
    const HalfSpace half_space = precise.supportingHalfSpace(r);
    const Vector3 direction = random.direction();
    const Vector3 surface = direction / wall.gauge(direction).value;
    EXPECT_LT(half_space.clearance(surface), -0.36 + 1e-6) << "cuts into the wall";
    EXPECT_GE(half_space.clearance(r), usual.supportingHalfSpace(r).clearance(r) - 1e-9);
  }
}

}  // namespace
}  // namespace swarm_planner
