// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Ways, and places aside of them. If these fail, UAVs are asked to leave a way that they do not block, or give way to
// where they are still in it, in an obstacle or in somebody else.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/random.hpp"
#include "swarm_planner/swarm/wayside.hpp"

namespace swarm_planner {
namespace {

constexpr PairSpacing kSpacing{2.2, 1.1};
constexpr double kFar = 100.0;  // [m]

MovingTarget targetAlong(const std::vector<Vector3>& points, double speed) {
  MovingTarget target;
  target.path = ReferencePath(points);
  target.speed = speed;
  return target;
}

TEST(Way, LeadsBackToThePathAndAlongIt) {
  const MovingTarget target = targetAlong({Vector3::Zero(), Vector3(20, 0, 0), Vector3(20, 20, 0)}, 1.0);
  const Way way(target, Vector3(5, 3, 0), 5.0, 0.0);
  EXPECT_NEAR(way.gaugeTo(Vector3(10, 2.2, 0), kFar, kSpacing), 1.0, 1e-9);
  EXPECT_NEAR(way.gaugeTo(Vector3(10, 0, 1.1), kFar, kSpacing), 1.0, 1e-9) << "the ellipsoid, not a ball";
  EXPECT_NEAR(way.gaugeTo(Vector3(22.2, 10, 0), kFar, kSpacing), 1.0, 1e-9) << "round the corner";
  EXPECT_GT(way.gaugeTo(Vector3(22.2, 10, 0), 6.0, kSpacing), 3.0) << "not as far as that";
  EXPECT_LT(way.gaugeTo(Vector3(5.5, 2.5, 0), kFar, kSpacing), 0.2) << "between the UAV and its path";
}

TEST(Way, IsBlockedAheadNotBehindNorBeside) {
  const MovingTarget target = targetAlong({Vector3::Zero(), Vector3(50, 0, 0)}, 1.0);
  const Way way(target, Vector3(10, 0, 0), 10.0, 0.0);
  const auto blocked = [&](const Vector3& q) { return way.isBlockedAt(q, 6.6, 0.95, kSpacing); };
  EXPECT_TRUE(blocked(Vector3(12.2, 0, 0)));
  EXPECT_TRUE(blocked(Vector3(16, 2.0, 0)));
  EXPECT_FALSE(blocked(Vector3(12, 2.2, 0))) << "touches it alone";
  EXPECT_FALSE(blocked(Vector3(7.8, 0, 0)));
  EXPECT_FALSE(blocked(Vector3(19.5, 0, 0))) << "too far ahead";
}

// A target that stands before its path's end leads no farther.
TEST(Way, EndsWhereAStandingTargetIs) {
  MovingTarget target = targetAlong({Vector3::Zero(), Vector3(50, 0, 0)}, 0.0);
  target.start = 12.0;
  const Way way(target, Vector3(10, 0, 0), 10.0, 0.0);
  EXPECT_EQ(way.end(), 12.0);
  EXPECT_GT(way.gaugeTo(Vector3(20, 0, 0), kFar, kSpacing), 3.0);
}

class WaysideTest : public testing::Test {
 protected:
  WaysideTest() { parameters_.limits.pair_distance_vertical = 2.0; }

  static TrackedObstacle obstacle(const Vector3& center, const Vector3& radii, const Vector3& velocity) {
    TrackedObstacle track;
    track.shape = Superellipsoid(1, center, radii, Vector3::Constant(8.0), 0.0, velocity);
    return track;
  }
  std::optional<WayAside> find(const Vector3& from, const Vector3& wanted = Vector3(0, 0, 10)) {
    Wayside wayside(parameters_, workspace_, 100, 20);
    spacing_ = wayside.spacing();
    wayside.begin(obstacles_, 0.0);
    wayside.forgetOthers();
    wayside.addOther(way_.begin(), false);  // who comes
    for (const Vector3& other : others_) wayside.addOther(other, false);
    for (const Vector3& other : lower_) wayside.addOther(other, true);
    Wayside::Request request;
    request.from = from;
    request.wanted = wanted;
    request.way = &way_;
    return wayside.find(request);
  }
  static const Vector3& placeOf(const WayAside& aside) { return aside.points[aside.count - 1]; }

  Parameters parameters_;
  std::optional<Workspace> workspace_;
  std::vector<TrackedObstacle> obstacles_;
  std::vector<Vector3> others_;
  std::vector<Vector3> lower_;  ///< that may be asked
  MovingTarget target_ = targetAlong({Vector3(-30, 0, 10), Vector3(30, 0, 10)}, 1.0);
  Way way_{target_, Vector3(-5, 0, 10), 25.0, 0.0};
  PairSpacing spacing_;
};

TEST_F(WaysideTest, IsOffTheWayAndOnTheSideThatTheUavWantsToGoTo) {
  for (const double side : {-1.0, 1.0}) {
    const auto aside = find(Vector3(0, 0, 10), Vector3(0, side * 20, 10));
    ASSERT_TRUE(aside);
    EXPECT_EQ(aside->count, 2U);
    EXPECT_GE(way_.gaugeTo(placeOf(*aside), kFar, spacing_), 1.0);
    EXPECT_GT(side * placeOf(*aside).y(), 2.0);
    EXPECT_LT(placeOf(*aside).norm(), Vector3(4, 4, 10).norm());
  }
}

TEST_F(WaysideTest, RetreatsOutOfALaneThenStepsAside) {
  for (const double side : {-1.0, 1.0}) {
    obstacles_.push_back(obstacle(Vector3(0, side * 3.0, 10), Vector3(15, 2, 9), Vector3::Zero()));
  }
  workspace_ = Workspace{Vector3(-40, -6, 9), Vector3(40, 6, 11)};
  const auto aside = find(Vector3(0, 0, 10));
  ASSERT_TRUE(aside);
  ASSERT_EQ(aside->count, 3U);
  EXPECT_GT(placeOf(*aside).x(), 14.0) << "away from who comes";
  EXPECT_GE(way_.gaugeTo(placeOf(*aside), kFar, spacing_), 1.0);
  workspace_->max.x() = 14.0;
  EXPECT_FALSE(find(Vector3(0, 0, 10))) << "a dead end";
}

TEST_F(WaysideTest, AsksOthersToLeaveOnlyWhereThereIsNoOtherPlace) {
  workspace_ = Workspace{Vector3(-40, -3, 9), Vector3(40, 3, 11)};
  lower_ = {Vector3(0, 2.4, 10)};
  const auto aside = find(Vector3(0, 0, 10), Vector3(0, 20, 10));
  ASSERT_TRUE(aside);
  EXPECT_GE(spacing_.gauge(placeOf(*aside) - lower_[0]), 1.0);
  for (double x = -39.0; x <= 39.0; x += 2.2) {
    lower_.emplace_back(x, 2.4, 10);
    lower_.emplace_back(x, -2.4, 10);
  }
  EXPECT_TRUE(find(Vector3(0, 0, 10)));
  others_ = lower_;
  lower_.clear();
  EXPECT_FALSE(find(Vector3(0, 0, 10)));
}

TEST_F(WaysideTest, KeepsClearOfWhatMovesTowardsThePlace) {
  const Vector3 wanted(0, 20, 10);
  const auto before = find(Vector3(0, 0, 10), wanted);
  ASSERT_TRUE(before);
  const Vector3 place = placeOf(*before);
  obstacles_ = {obstacle(place + Vector3(0, 8, 0), Vector3::Ones(), Vector3(0, -2, 0))};
  const auto after = find(Vector3(0, 0, 10), wanted);
  ASSERT_TRUE(after);
  for (const double t : {0.0, 1.0, 2.0, 4.0, 8.0}) {
    EXPECT_GE(obstacles_[0].shape.movedBy(t).signedDistance(placeOf(*after)), parameters_.limits.uav_radius) << t;
  }
  EXPECT_GT((placeOf(*after) - place).norm(), 0.5);
}

TEST_F(WaysideTest, HoldsAllItPromisesAmongRandomObstaclesAndUavs) {
  Random random(11);
  int found = 0;
  int none = 0;
  for (int n = 0; n < 300; ++n) {
    obstacles_.clear();
    others_.clear();
    workspace_ = Workspace{Vector3(-20, -6, 8.5), Vector3(20, 6, 11.5)};
    const Vector3 from(random.uniform(-2, 3), random.uniform(-1, 1), 10.0);
    while (obstacles_.size() < 14) {
      const Vector3 center(random.uniform(-12, 12), random.uniform(-6, 6), 10.0);
      const TrackedObstacle track = obstacle(center, Vector3(random.uniform(0.3, 2), 1, 5), Vector3::Zero());
      if (track.shape.signedDistance(from) > 0.6) obstacles_.push_back(track);
    }
    while (others_.size() < 20) {
      const Vector3 other(random.uniform(-12, 12), random.uniform(-6, 6), random.uniform(9, 11));
      if ((other - from).norm() > 2.2) others_.push_back(other);
    }
    const auto aside = find(from);
    ++(aside ? found : none);
    if (!aside) continue;
    const Vector3& place = placeOf(*aside);
    EXPECT_GE(way_.gaugeTo(place, kFar, spacing_), 1.0);
    for (const Vector3& other : others_) EXPECT_GE(spacing_.gauge(place - other), 1.0);
    for (const TrackedObstacle& track : obstacles_) {
      for (std::size_t leg = 0; leg + 1 < aside->count; ++leg) {
        for (double share = 0.0; share <= 1.0; share += 0.05) {
          const Vector3 q = aside->points[leg] + share * (aside->points[leg + 1] - aside->points[leg]);
          EXPECT_GT(track.shape.signedDistance(q), 0.5 * parameters_.limits.uav_radius);
        }
      }
    }
  }
  EXPECT_GT(found, 50);
  EXPECT_GT(none, 10);
}

}  // namespace
}  // namespace swarm_planner
