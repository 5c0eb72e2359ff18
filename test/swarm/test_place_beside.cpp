// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A UAV that gives way has to go where it can stay, and no farther than it must.
#include <gtest/gtest.h>

#include "check_scene.hpp"
#include "swarm_planner/swarm/place_beside.hpp"

namespace swarm_planner {
namespace {

const Vector3 kPlace(0, 0, 10);
constexpr double kTime = 100.0;  // [s]

/// A ball of 2 m that comes along x and passes `aside` of the place, 10 s later.
class PlaceBeside : public ::testing::Test {
 protected:
  void come(const Vector3& aside, const Vector3& velocity) {
    body_ = Superellipsoid(1, kPlace + aside - 10.0 * velocity, Vector3::Constant(2.0), Vector3::Constant(2.0), 0.0,
                           velocity);
    PredictedObstacle obstacle;
    obstacle.body = &*body_;
    obstacle.stamp = kTime;
    obstacle.least_distance = 0.5;
    surroundings_.obstacles = {obstacle};
  }
  std::optional<Vector3> find() const { return placeBeside(kPlace, 0, kTime, limits_, surroundings_); }
  bool isClear(const Vector3& place) const {
    CommittedMotion rest;
    rest.assignRest(kTime, place);
    return checkClearance(rest, place, limits_, surroundings_).accepted();
  }

  CheckLimits limits_ = defaultCheckLimits();
  CheckSurroundings surroundings_;
  std::optional<Superellipsoid> body_;
};

TEST_F(PlaceBeside, IsClearAndNear) {
  for (const Vector3& aside : {Vector3(0, 1, 0), Vector3(0, -1, 0.2), Vector3(0, 0.1, 1), Vector3(0, 0, -1)}) {
    come(aside, Vector3(0.6, 0, 0));
    ASSERT_FALSE(isClear(kPlace));
    const std::optional<Vector3> place = find();
    ASSERT_TRUE(place);
    EXPECT_TRUE(isClear(*place));
    EXPECT_NEAR((*place - kPlace).norm(), 2.0 + 0.5 + 0.5 - 1.0, 0.02) << "to the side that is nearest";
    EXPECT_LT((*place - kPlace).dot(aside), 0.0);
  }
}

TEST_F(PlaceBeside, OfWhatFallsStraightDownOrGrowsWhereItStands) {
  come(Vector3(1, 0, 0), Vector3(0, 0, -0.6));
  ASSERT_TRUE(find());
  EXPECT_TRUE(isClear(*find()));
  come(Vector3(2.6, 0, 0), Vector3::Zero());
  surroundings_.obstacles[0].growth_rate = 0.1;
  ASSERT_FALSE(isClear(kPlace));
  ASSERT_TRUE(find());
  EXPECT_TRUE(isClear(*find()));
}

TEST_F(PlaceBeside, IsNotWhereAnotherUavIsOrNoUavMayBe) {
  come(Vector3(0, -1, 0), Vector3(0.6, 0, 0));
  CommittedMotion other;
  other.assignRest(kTime, kPlace + Vector3(0, 3, 0));
  surroundings_.uavs.push_back({&other, 1e9, {}});
  const std::optional<Vector3> place = find();
  ASSERT_TRUE(place);
  EXPECT_TRUE(isClear(*place));
  EXPECT_GT(std::abs(place->z() - kPlace.z()), 1.0) << "above or below";
  limits_.bounds.workspace = {kPlace - Vector3::Constant(0.5), kPlace + Vector3::Constant(0.5)};
  EXPECT_FALSE(find());
}

}  // namespace
}  // namespace swarm_planner
