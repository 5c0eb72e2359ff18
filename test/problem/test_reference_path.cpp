// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, UAVs chase the wrong point: the foot on the reference would jump between branches, or the target
// would not be where the scenario puts it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/random.hpp"
#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {
namespace {

std::vector<Vector3> corner() { return {Vector3(0, 0, 1), Vector3(3, 0, 1), Vector3(3, 4, 1)}; }

TEST(ReferencePath, IsAPolylineByArcLength) {
  const ReferencePath path(corner());
  EXPECT_DOUBLE_EQ(path.length(), 7.0);
  EXPECT_LT((path.at(1.0).position - Vector3(1, 0, 1)).norm(), 1e-15);
  EXPECT_LT((path.at(1.0).tangent - Vector3::UnitX()).norm(), 1e-15);
  EXPECT_LT((path.at(5.0).position - Vector3(3, 2, 1)).norm(), 1e-15);
  EXPECT_LT((path.at(5.0).tangent - Vector3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(path.at(5.0).arc_length, 5.0);
}

TEST(ReferencePath, LooksAheadAtCorners) {
  const ReferencePath path(corner());
  EXPECT_LT((path.at(3.0).tangent - Vector3::UnitY()).norm(), 1e-15);
  EXPECT_LT((path.at(7.0).tangent - Vector3::UnitY()).norm(), 1e-15);
}

TEST(ReferencePath, ClampsToItsEnds) {
  const ReferencePath path(corner());
  EXPECT_EQ(path.at(-1.0).arc_length, 0.0);
  EXPECT_LT((path.at(-1.0).position - Vector3(0, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(path.at(99.0).arc_length, 7.0);
  EXPECT_LT((path.at(99.0).position - Vector3(3, 4, 1)).norm(), 1e-15);
}

TEST(ReferencePath, DropsRepeatedPoints) {
  const ReferencePath path({Vector3(0, 0, 1), Vector3(0, 0, 1), Vector3(3, 0, 1), Vector3(3, 0, 1), Vector3(3, 0, 1),
                            Vector3(3, 4, 1), Vector3(3, 4, 1)});
  EXPECT_EQ(path.points().size(), 3U);
  EXPECT_DOUBLE_EQ(path.length(), 7.0);
  for (double s = 0.0; s <= 7.0; s += 0.25) EXPECT_NEAR(path.at(s).tangent.norm(), 1.0, 1e-12);
}

TEST(ReferencePath, OfLengthZeroIsAPoint) {
  for (const ReferencePath& path :
       {ReferencePath({Vector3(1, 2, 3)}), ReferencePath({Vector3(1, 2, 3), Vector3(1, 2, 3)})}) {
    EXPECT_EQ(path.length(), 0.0);
    for (const PathPoint& point : {path.at(0.0), path.at(5.0), path.nearest(Vector3(9, 9, 9), 3.0)}) {
      EXPECT_EQ((point.position - Vector3(1, 2, 3)).norm(), 0.0);
      EXPECT_EQ((point.tangent - Vector3::UnitX()).norm(), 0.0);
      EXPECT_EQ(point.arc_length, 0.0);
    }
  }
}

TEST(ReferencePath, FindsTheNearestPoint) {
  const ReferencePath path(corner());
  const PathPoint foot = path.nearest(Vector3(1.0, 0.5, 2.0), 0.0);
  EXPECT_NEAR(foot.arc_length, 1.0, 1e-12);
  EXPECT_LT((foot.position - Vector3(1, 0, 1)).norm(), 1e-12);
  EXPECT_NEAR(path.nearest(Vector3(4.0, 3.0, 0.0), 4.0).arc_length, 6.0, 1e-12);
  EXPECT_NEAR(path.nearest(Vector3(-4.0, 0.0, 0.0), 1.0).arc_length, 0.0, 1e-12);
  EXPECT_NEAR(path.nearest(Vector3(4.0, -1.0, 1.0), 1.0).arc_length, 3.0, 1e-12);
}

TEST(ReferencePath, AgreesWithSamplingTheWindow) {
  Random random(1);
  for (int n = 0; n < 300; ++n) {
    std::vector<Vector3> points;
    for (int i = random.integer(1, 12); i >= 0; --i) points.push_back(random.vector(-4.0, 4.0));
    const ReferencePath path(points);
    const Vector3 position = random.vector(-5.0, 5.0);
    const double near = random.uniform(-3.0, path.length() + 3.0);
    const double window = random.uniform(3.5, 8.0);
    const PathPoint foot = path.nearest(position, near, window);

    double nearest = std::numeric_limits<double>::infinity();
    const double first = std::max(0.0, near - window);
    const double last = std::min(path.length(), near + window);
    for (int i = 0; i <= 5000; ++i) {
      nearest = std::min(nearest, (position - path.at(first + (last - first) * i / 5000.0).position).norm());
    }
    EXPECT_NEAR((position - foot.position).norm(), nearest, 2e-3);
    EXPECT_LE((position - foot.position).norm(), nearest + 1e-9);
    EXPECT_GE(foot.arc_length, first - 1e-9);
    EXPECT_LE(foot.arc_length, last + 1e-9);
    EXPECT_LT((foot.position - path.at(foot.arc_length).position).norm(), 1e-9);
  }
}

TEST(ReferencePath, DoesNotJumpWhereItCrossesItself) {
  // A figure of eight through the origin: a vehicle that follows it a little off must progress evenly.
  std::vector<Vector3> points;
  constexpr int kCorners = 200;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * M_PI * i / kCorners;
    points.push_back(Vector3(20.0 * std::sin(angle), 10.0 * std::sin(2.0 * angle), 5.0));
  }
  const ReferencePath path(points);
  double progress = 0.0;
  for (double s = 0.0; s < path.length(); s += 0.5) {
    const PathPoint on_path = path.at(s);
    const Vector3 sideways(-on_path.tangent.y(), on_path.tangent.x(), 0.0);
    const double before = progress;
    progress = path.nearest(on_path.position + 0.3 * sideways, progress).arc_length;
    EXPECT_LT(std::abs(progress - s), 0.2);
    EXPECT_LT(std::abs(progress - before), 1.0);
  }
}

TEST(ReferencePath, WithAWindowBeyondItsEndGivesTheEnd) {
  const ReferencePath path(corner());
  EXPECT_NEAR(path.nearest(Vector3::Zero(), 50.0).arc_length, 7.0, 1e-12);
  EXPECT_NEAR(path.nearest(Vector3(3, 4, 1), -50.0).arc_length, 0.0, 1e-12);
}

TEST(MovingTarget, MovesFromTimeZeroAndStopsAtTheEnd) {
  const MovingTarget target{ReferencePath(corner()), 1.0, 2.0, 100.0};
  const TargetState before = target.at(90.0);
  EXPECT_NEAR(before.arc_length, 1.0, 1e-12);
  EXPECT_EQ(before.v.norm(), 0.0);

  const TargetState start = target.at(100.0);
  EXPECT_LT((start.p - Vector3(1, 0, 1)).norm(), 1e-12);
  EXPECT_LT((start.v - Vector3(2, 0, 0)).norm(), 1e-12);

  const TargetState around_the_corner = target.at(102.0);
  EXPECT_NEAR(around_the_corner.arc_length, 5.0, 1e-12);
  EXPECT_LT((around_the_corner.p - Vector3(3, 2, 1)).norm(), 1e-12);
  EXPECT_LT((around_the_corner.v - Vector3(0, 2, 0)).norm(), 1e-12);

  const TargetState after = target.at(200.0);
  EXPECT_LT((after.p - Vector3(3, 4, 1)).norm(), 1e-12);
  EXPECT_EQ(after.v.norm(), 0.0);
  EXPECT_NEAR(after.arc_length, 7.0, 1e-12);
}

TEST(ReferencePath, AssignedAsALineIsTheSameAsOneMadeOfItsEnds) {
  const Vector3 begin(1, 2, 3);
  const Vector3 end(1, 2, -1);
  ReferencePath path(corner());
  path.assignLine(begin, end);
  EXPECT_EQ(path.points(), ReferencePath({begin, end}).points());
  EXPECT_EQ(path.length(), 4.0);
  EXPECT_EQ(path.at(1.0).position, Vector3(1, 2, 2));
  EXPECT_EQ(path.at(1.0).tangent, -Vector3::UnitZ());
  path.assignLine(begin, begin);
  EXPECT_EQ(path.length(), 0.0);
  EXPECT_EQ(path.nearest(Vector3(5, 5, 5), 0.0).position, begin);
}

TEST(MovingTarget, StartingBeyondTheEndRestsThere) {
  const MovingTarget target{ReferencePath(corner()), 50.0, 2.0, 0.0};
  EXPECT_LT((target.at(1.0).p - Vector3(3, 4, 1)).norm(), 1e-12);
  EXPECT_EQ(target.at(1.0).v.norm(), 0.0);
}

TEST(MovingTarget, OnAPointRests) {
  const MovingTarget target{ReferencePath({Vector3(1, 2, 3)}), 0.0, 2.0, 0.0};
  EXPECT_EQ((target.at(5.0).p - Vector3(1, 2, 3)).norm(), 0.0);
  EXPECT_EQ(target.at(5.0).v.norm(), 0.0);
}

TEST(MovingTarget, VelocityIsTheDerivativeOfItsPosition) {
  const MovingTarget target{ReferencePath(corner()), 0.5, 1.5, 10.0};
  for (double t = 10.1; t < 14.0; t += 0.17) {
    const double h = 1e-6;
    EXPECT_LT((target.at(t).v - (target.at(t + h).p - target.at(t - h).p) / (2.0 * h)).norm(), 1e-6) << t;
  }
}

TEST(ReferencePath, VisitsTheCornersThatFollow) {
  const ReferencePath path({Vector3::Zero(), Vector3(2, 0, 0), Vector3(2, 3, 0), Vector3(2, 3, 4)});
  std::vector<double> ways;
  const auto note = [&ways](const Vector3& point, double arc_length) {
    EXPECT_GT(point.x(), 1.0);
    ways.push_back(arc_length);
    return ways.size() < 2;
  };
  path.forEachPointAfter(1.0, note);
  EXPECT_EQ(ways, (std::vector<double>{2.0, 5.0})) << "until it is told to stop";
  ways.clear();
  path.forEachPointAfter(5.0, note);
  EXPECT_EQ(ways, (std::vector<double>{9.0}));
  ways.clear();
  path.forEachPointAfter(9.0, note);
  EXPECT_TRUE(ways.empty());
}

}  // namespace
}  // namespace swarm_planner
