// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a UAV stops for good before a box that it meets head on, or two that meet evade to the same side.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>

#include "support/flight_problem.hpp"
#include "support/random.hpp"
#include "support/resting_prediction.hpp"
#include "swarm_planner/problem/passing_side.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;
constexpr double kFar = 1e3;

Workspace openAir() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {Vector3::Constant(-kInfinity), Vector3::Constant(kInfinity)};
}

/// A box of half the size `half` [m] at rest at the origin.
Superellipsoid box(const Vector3& half) {
  return Superellipsoid(1, Vector3::Zero(), half, Vector3::Constant(10.0), 0.0, Vector3::Zero());
}

/// The segment of a straight flight with relative velocity `v` whose middle is at `middle`.
SegmentPoints segmentThrough(const Vector3& middle, const Vector3& v) {
  const KinematicState begin{middle - 0.5 * kDt * v, v, Vector3::Zero()};
  return segmentPoints(begin, propagate(begin, Vector3::Zero(), kDt), kDt);
}

/// Two UAVs that pass each other at a least distance: what each of them decides.
struct Encounter {
  Encounter(const Vector3& relative_velocity, const Vector3& offset, double horizontal, double vertical) {
    predictResting(Vector3::Zero(), motion);
    const MovingBody first_sees = MovingBody::fromUav(motion, horizontal, vertical, Vector3::UnitX());
    const MovingBody second_sees = MovingBody::fromUav(motion, horizontal, vertical, -Vector3::UnitX());
    const SegmentPoints of_first = segmentThrough(offset, relative_velocity);
    const SegmentPoints of_second = segmentThrough(-offset, -relative_velocity);
    const auto side_of_first = PassingSide::choose(first_sees, of_first, Vector3::Zero(), kFar, openAir());
    const auto side_of_second = PassingSide::choose(second_sees, of_second, Vector3::Zero(), kFar, openAir());
    decided = side_of_first && side_of_second;
    if (!decided) return;
    n_first = side_of_first->halfSpace(first_sees, offset).n;
    n_second = side_of_second->halfSpace(second_sees, -offset).n;
  }

  PredictedMotion motion;
  bool decided = false;
  Vector3 n_first = Vector3::Zero();   ///< where the first gives way to
  Vector3 n_second = Vector3::Zero();  ///< where the second gives way to
};

TEST(PassingSide, OfABoxMetHeadOnIsSidewaysForTheWholePassage) {
  const Superellipsoid obstacle = box(Vector3(2.0, 4.0, 8.0));
  const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
  const Vector3 v(5, 0, 0);
  // Without a side: the face has no sideways gradient, and no QP finds a way round.
  ASSERT_GT(std::abs(body.supportingHalfSpace(Vector3(-1, 0, 0)).n.x()), 0.99);
  const auto side = PassingSide::choose(body, segmentThrough(Vector3::Zero(), v), Vector3::Zero(), kFar, openAir());
  ASSERT_TRUE(side);
  for (double x = -1.9; x <= 1.9; x += 0.1) {
    const HalfSpace half_space = side->halfSpace(body, Vector3(x, 0, 0));
    EXPECT_GT(-half_space.n.y(), 0.8) << "the way round to the right is the shortest";
    EXPECT_LT(std::abs(half_space.n.x()), 0.6) << "neither to stay before it nor to be behind it";
  }
}

TEST(PassingSide, IsTheShortestWayOut) {
  const Superellipsoid obstacle = box(Vector3(2.0, 4.0, 4.0));
  const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
  for (const Vector3& offset : {Vector3(0, 3, 0), Vector3(0, -3, 0), Vector3(0, 0, 3), Vector3(0, 0, -3)}) {
    const auto side = PassingSide::choose(body, segmentThrough(offset, Vector3(5, 0, 0)), offset, kFar, openAir());
    ASSERT_TRUE(side);
    EXPECT_GT(side->halfSpace(body, offset).n.dot(offset.normalized()), 0.9) << offset.transpose();
  }
}

TEST(PassingSide, NeverLeavesTheWorkspace) {
  const Superellipsoid obstacle = box(Vector3(2.0, 3.0, 6.0));
  const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
  const SegmentPoints relative = segmentThrough(Vector3::Zero(), Vector3(5, 0, 0));
  Workspace walled = openAir();
  walled.min.y() = -3.4;  // less than half a size and the distance: no room on the right
  const auto left = PassingSide::choose(body, relative, Vector3::Zero(), kFar, walled);
  ASSERT_TRUE(left);
  EXPECT_GT(left->halfSpace(body, Vector3::Zero()).n.y(), 0.9);

  walled.max.y() = 3.4;
  const auto vertical = PassingSide::choose(body, relative, Vector3::Zero(), kFar, walled);
  ASSERT_TRUE(vertical);
  EXPECT_GT(std::abs(vertical->halfSpace(body, Vector3::Zero()).n.z()), 0.9);

  walled.min.z() = -6.4;
  const auto above = PassingSide::choose(body, relative, Vector3::Zero(), kFar, walled);
  ASSERT_TRUE(above);
  EXPECT_GT(above->halfSpace(body, Vector3::Zero()).n.z(), 0.9);

  walled.max.z() = 6.4;
  EXPECT_FALSE(PassingSide::choose(body, relative, Vector3::Zero(), kFar, walled)) << "no way out";
}

TEST(PassingSide, JudgesTheWorkspaceWhereTheUavIsThen) {
  const Superellipsoid obstacle = box(Vector3(2.0, 3.0, 6.0));
  const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
  const SegmentPoints relative = segmentThrough(Vector3::Zero(), Vector3(5, 0, 0));
  Workspace walled = openAir();
  walled.min.y() = 100.0;
  const auto side = PassingSide::choose(body, relative, Vector3(0, 101, 0), kFar, walled);
  ASSERT_TRUE(side);
  EXPECT_GT(side->halfSpace(body, Vector3::Zero()).n.y(), 0.9);
}

TEST(PassingSide, IsOnlyWhatTheUavCanReach) {
  const Superellipsoid obstacle = box(Vector3(2.0, 3.0, 6.0));
  const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
  const SegmentPoints relative = segmentThrough(Vector3::Zero(), Vector3(5, 0, 0));
  EXPECT_TRUE(PassingSide::choose(body, relative, Vector3::Zero(), 3.6, openAir()));
  EXPECT_FALSE(PassingSide::choose(body, relative, Vector3::Zero(), 3.3, openAir()));
  EXPECT_FALSE(PassingSide::choose(body, relative, Vector3::Zero(), 0.0, openAir()));
}

TEST(PassingSide, NeedsAPassage) {
  const Superellipsoid obstacle = box(Vector3::Constant(2.0));
  const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
  const SegmentPoints resting = segmentThrough(Vector3(1, 0, 0), Vector3::Zero());
  EXPECT_FALSE(PassingSide::choose(body, resting, Vector3(1, 0, 0), kFar, openAir()));
}

class HeadOn : public ::testing::TestWithParam<Vector3> {};

// Also where the way out above or below is shorter than the one to the right.
TEST_P(HeadOn, TheyGiveWayInOppositeDirections) {
  for (const double vertical : {1.0, 2.0, 3.0}) {
    const Encounter encounter(GetParam(), Vector3::Zero(), 2.0, vertical);
    ASSERT_TRUE(encounter.decided);
    EXPECT_LT(encounter.n_first.normalized().dot(encounter.n_second.normalized()), -0.99);
  }
}

TEST_P(HeadOn, ASmallOffsetDoesNotMakeThemDisagree) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Vector3 v = GetParam();
    Vector3 offset = random.logUniform(1e-9, 1.9) * random.direction();
    offset -= offset.dot(v) / v.squaredNorm() * v;
    const Encounter encounter(v, offset, 2.0, random.uniform(1.0, 3.0));
    ASSERT_TRUE(encounter.decided);
    EXPECT_LT(encounter.n_first.normalized().dot(encounter.n_second.normalized()), -0.5) << offset.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, HeadOn,
                         ::testing::Values(Vector3(10, 0, 0), Vector3(-3, 7, 0), Vector3(0, -1, 0), Vector3(4, 3, 5),
                                           Vector3(4, -3, -9), Vector3(0, 0, 6), Vector3(0, 0, -6),
                                           Vector3(1e-4, 2e-4, 6)));

TEST(PassingSide, OfOppositeFlightsBetweenWallsIsNotTheSame) {
  PredictedMotion motion;
  predictResting(Vector3::Zero(), motion);
  const MovingBody body = MovingBody::fromUav(motion, 2.0, 2.0, Vector3::UnitX());
  Workspace corridor = openAir();
  corridor.min.y() = -1.0;
  corridor.max.y() = 1.0;
  const Vector3 v(10, 0, 0);
  const auto forth = PassingSide::choose(body, segmentThrough(Vector3::Zero(), v), Vector3::Zero(), kFar, corridor);
  const auto back = PassingSide::choose(body, segmentThrough(Vector3::Zero(), -v), Vector3::Zero(), kFar, corridor);
  ASSERT_TRUE(forth && back);
  EXPECT_LT(forth->halfSpace(body, Vector3::Zero()).n.dot(back->halfSpace(body, Vector3::Zero()).n), -0.99);
}

TEST(PassingSide, HorizontallyIsTheRight) {
  const Encounter encounter(Vector3(10, 0, 0), Vector3::Zero(), 2.0, 2.0);
  ASSERT_TRUE(encounter.decided);
  EXPECT_LT(encounter.n_first.y(), -0.99) << "flying along +x, the right is -y";
  EXPECT_GT(encounter.n_second.y(), 0.99) << "flying along -x, the right is +y";
}

// Whatever side: no half-space may cut into the body.
TEST(PassingSide, HalfSpacesAreAlwaysClearOfTheBody) {
  Random random(2);
  int chosen = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3 radii(random.logUniform(0.3, 10.0), random.logUniform(0.3, 10.0), random.logUniform(0.3, 10.0));
    const Superellipsoid obstacle(1, random.vector(-5.0, 5.0), radii, random.vector(2.0, 10.0),
                                  random.uniform(-M_PI, M_PI), Vector3::Zero());
    const double distance = random.uniform(0.1, 2.0);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.02, distance);
    const Vector3 middle = random.uniform(0.0, 1.0) * radii.minCoeff() * random.direction();
    const SegmentPoints relative = segmentThrough(middle, random.logUniform(0.1, 10.0) * random.direction());
    const auto side = PassingSide::choose(body, relative, obstacle.center() + middle, kFar, openAir());
    if (!side) continue;
    ++chosen;
    const HalfSpace half_space =
        side->halfSpace(body, random.uniform(0.0, 2.0) * obstacle.boundingRadius() * random.direction());
    ASSERT_NEAR(half_space.n.norm(), 1.0, 1e-12);
    for (int i = 0; i < 50; ++i) {
      Vector3 u = random.direction();
      u /= obstacle.gauge(u, 1.02).value;
      EXPECT_LE(half_space.n.dot(u), half_space.offset - distance + 1e-9 * obstacle.boundingRadius());
    }
  }
  EXPECT_GT(chosen, 450) << "in open air there is a way out of everything";
}

// The half-space is to lead out: at the way out itself it must be met, else the plan is pushed on for nothing.
TEST(PassingSide, TheWayOutMeetsTheHalfSpace) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Vector3 radii(random.logUniform(1.0, 4.0), random.logUniform(1.0, 4.0), random.logUniform(1.0, 4.0));
    const Superellipsoid obstacle(1, Vector3::Zero(), radii, random.vector(2.0, 10.0), random.uniform(-M_PI, M_PI),
                                  Vector3::Zero());
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
    const Vector3 along = random.direction();
    const Vector3 middle = random.uniform(0.0, 0.9) * radii.minCoeff() * random.direction();
    const auto side = PassingSide::choose(body, segmentThrough(middle, 5.0 * along), middle, kFar, openAir());
    ASSERT_TRUE(side);
    const HalfSpace half_space = side->halfSpace(body, middle);
    EXPECT_LT(half_space.clearance(middle), 0.0) << "a point in the body cannot be clear";
    const Vector3 out = half_space.n - half_space.n.dot(along) * along;
    EXPECT_GT(out.norm(), 0.1) << "the half-space does not lead sideways";
  }
}

}  // namespace
}  // namespace swarm_planner
