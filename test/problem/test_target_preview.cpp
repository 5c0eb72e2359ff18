// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a UAV whose target is past a corner is drawn off its path, or stands for good where the legs part.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/random.hpp"
#include "swarm_planner/problem/target_preview.hpp"

namespace swarm_planner {
namespace {

constexpr double kSpeed = 5.0;     // of the UAV [m/s]
constexpr double kTimeStep = 0.3;  // [s]
constexpr double kPass = 0.75;     // [m]

/// Ten metres along x, then along a leg that turns by `degrees` to the left.
MovingTarget atCorner(double degrees, double start, double speed) {
  const double turn = degrees * M_PI / 180.0;
  const Vector3 corner(10, 0, 5);
  return {ReferencePath({Vector3(0, 0, 5), corner, corner + 20.0 * Vector3(std::cos(turn), std::sin(turn), 0)}), start,
          speed, 0.0};
}

TEST(TargetPreview, OnTheSameLegIsTheTargetItself) {
  for (const double progress : {0.0, 4.0, 10.0, 15.0}) {
    const MovingTarget target = atCorner(120.0, progress < 10.0 ? 2.0 : 25.0, 1.0);
    const StageTargets targets = previewTargets(target, progress, kSpeed, 1.0, kTimeStep);
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      const TargetState exact = target.at(1.0 + static_cast<double>(k) * kTimeStep);
      EXPECT_EQ((targets[k].p - exact.p).norm(), 0.0);
      EXPECT_EQ((targets[k].v - exact.v).norm(), 0.0);
      EXPECT_EQ(targets[k].arc_length, exact.arc_length);
    }
  }
}

TEST(TargetPreview, BeyondACornerIsNoFartherThanTheUavCanBe) {
  const MovingTarget target = atCorner(60.0, 29.0, 0.0);
  const StageTargets targets = previewTargets(target, 7.0, kSpeed, 0.0, kTimeStep);
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    const double reached = 7.0 + kSpeed * static_cast<double>(k) * kTimeStep;
    EXPECT_NEAR(targets[k].arc_length, std::min(29.0, std::max(10.0, reached)), 1e-12);
    EXPECT_LT((targets[k].p - target.path.at(targets[k].arc_length).position).norm(), 1e-12);
    const Vector3 expected =
        reached < 29.0 ? Vector3(kSpeed * target.path.at(reached).tangent) : Vector3(Vector3::Zero());
    EXPECT_LT((targets[k].v - expected).norm(), 1e-12);
  }
}

TEST(TargetPreview, WaitsAtASharpCornerUntilItIsPassed) {
  const MovingTarget target = atCorner(150.0, 29.0, 0.0);
  const StageTargets before = previewTargets(target, 7.0, kSpeed, 0.0, kTimeStep);
  EXPECT_NEAR(before.back().arc_length, 10.0, 1e-12);
  EXPECT_EQ(before.back().v.norm(), 0.0);
  const StageTargets after = previewTargets(target, 10.0, kSpeed, 0.0, kTimeStep);
  EXPECT_NEAR(after.back().arc_length, 29.0, 1e-12);
}

TEST(ReferencePath, IsPassedAtASharpCornerOnlyFromNearIt) {
  // There and back on the same line: whatever is near one leg is near the other one.
  const ReferencePath path({Vector3(0, 0, 5), Vector3(10, 0, 5), Vector3(0, 0, 5)});
  EXPECT_EQ(path.nextSharpCorner(3.0), 10.0);
  EXPECT_EQ(path.nextSharpCorner(10.0), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(path.advance(Vector3(8.0, 0.1, 5), 7.5, kPass), 8.0, 1e-12) << "still to come";
  EXPECT_NEAR(path.advance(Vector3(9.0, 0.1, 5), 8.5, kPass), 9.0, 1e-12) << "still to come";
  EXPECT_NEAR(path.advance(Vector3(9.5, 0.1, 5), 9.2, kPass), 10.5, 1e-12) << "passed";
  EXPECT_NEAR(path.advance(Vector3(8.0, 0.1, 5), 10.5, kPass), 12.0, 1e-12) << "on the way back";
  EXPECT_NEAR(path.advance(Vector3(11.0, 0.1, 5), 10.5, kPass), 10.0, 1e-12) << "passed for good";
  EXPECT_NEAR(path.nearest(Vector3(8.0, 0.1, 5), 10.5).arc_length, 8.0, 1e-12) << "what the nearest point alone tells";
}

TEST(ReferencePath, IsPassedAtASharpCornerWhereTheNextLegIsNearer) {
  const ReferencePath path = atCorner(120.0, 0.0, 0.0).path;
  const PathPoint beyond = path.at(13.0);
  EXPECT_NEAR(path.advance(beyond.position, 9.0, kPass), 13.0, 1e-12);
  EXPECT_LT(path.advance(0.5 * (beyond.position + path.at(8.5).position), 9.0, kPass), 10.0);
}

TEST(ReferencePath, AdvancesToTheNearestPointWhereThereIsNoSharpCorner) {
  Random random(3);
  for (int n = 0; n < 300; ++n) {
    std::vector<Vector3> points{random.vector(-4.0, 4.0)};
    Vector3 direction = random.vector(-1.0, 1.0).normalized();
    for (int i = 0; i < 6; ++i) {
      points.push_back(points.back() + random.uniform(0.5, 4.0) * direction);
      Vector3 next = random.vector(-1.0, 1.0).normalized();
      while (next.dot(direction) < 0.1) next = random.vector(-1.0, 1.0).normalized();
      direction = next;
    }
    const ReferencePath path(points);
    ASSERT_EQ(path.nextSharpCorner(0.0), std::numeric_limits<double>::infinity());
    const double progress = random.uniform(0.0, path.length());
    const Vector3 position = path.at(progress).position + random.vector(-1.0, 1.0);
    EXPECT_EQ(path.advance(position, progress, kPass), path.nearest(position, progress).arc_length);
  }
}

}  // namespace
}  // namespace swarm_planner
