// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.hpp"
#include "swarm_planner/guide/convex_passage.hpp"

namespace swarm_planner {
namespace {

constexpr int kSamples = 2000;

/// Least of what is left of the distance along the line [m], by brute force.
double leastSampled(const Superellipsoid& shape, const Vector3& a, const Vector3& b, double distance) {
  double least = 1e9;
  for (int i = 0; i <= kSamples; ++i) {
    least = std::min(least, shape.signedDistance(a + i * (b - a) / kSamples) - distance);
  }
  return least;
}

// If it took a line for clear that is not, guides would lead into obstacles.
TEST(ConvexPassage, JudgesLinesAsManySamplesDo) {
  Random random(1);
  int clear = 0;
  int blocked = 0;
  for (int n = 0; n < 400; ++n) {
    const Superellipsoid shape(1, random.vector(-2, 2), random.vector(0.3, 4.0), random.vector(2.0, 10.0),
                               random.uniform(-3, 3), Vector3::Zero());
    const Vector3 a = random.vector(-8, 8);
    const Vector3 b = random.vector(-8, 8);
    const double least = leastSampled(shape, a, b, 0.36);
    if (std::abs(least) < 0.01) continue;
    EXPECT_EQ(ConvexPassage(shape, a, b, 0.36).isClear(), least > 0.0) << n << ", least " << least;
    ++(least > 0.0 ? clear : blocked);
  }
  EXPECT_GT(clear, 50);
  EXPECT_GT(blocked, 50);
}

TEST(ConvexPassage, FindsTheBlockedPart) {
  const Superellipsoid ball(1, Vector3::Zero(), Vector3::Ones(), Vector3::Constant(2.0), 0.0, Vector3::Zero());
  const auto part = ConvexPassage(ball, Vector3(-10, 0, 0), Vector3(10, 0, 0), 1.0).blocked();
  ASSERT_TRUE(part.has_value());
  EXPECT_NEAR(part->begin, 0.4, 1e-3);
  EXPECT_NEAR(part->end, 0.6, 1e-3);
  const auto from_inside = ConvexPassage(ball, Vector3::Zero(), Vector3(10, 0, 0), 1.0).blocked();
  ASSERT_TRUE(from_inside.has_value());
  EXPECT_EQ(from_inside->begin, 0.0);
  EXPECT_NEAR(from_inside->end, 0.2, 1e-3);
  EXPECT_FALSE(ConvexPassage(ball, Vector3(-10, 2.01, 0), Vector3(10, 2.01, 0), 1.0).blocked().has_value());
}

}  // namespace
}  // namespace swarm_planner
