// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Where nothing is safe the motion with the least shortfall flies. If it is wrong, a UAV stays where an obstacle comes.
#include <gtest/gtest.h>

#include "support/flight_problem.hpp"
#include "swarm/check_scene.hpp"
#include "swarm_planner/swarm/shortfall.hpp"

namespace swarm_planner {
namespace {

/// Of a flight along x at 2 m/s from 100 s on, from x = 0 until it stops beyond x = 12 m.
double ofFlight(CheckScene& scene, double from = 100.0) {
  scene.plan(straightPlan(Vector3::Zero(), Vector3(2.0, 0.0, 0.0), 100.0, 0.3));
  return shortfall(scene.motion, from, scene.limits, scene.surroundings);
}

/// Of a UAV that rests at the origin from 100 s on.
double ofRest(const CheckScene& scene, double from = 100.0) {
  CommittedMotion rest;
  rest.assignRest(100.0, Vector3::Zero());
  return shortfall(rest, from, scene.limits, scene.surroundings);
}

/// A sphere of 1 m, seen at 100 s, which is to be kept 0.5 m off.
PredictedObstacle& addSphere(CheckScene& scene, const Vector3& center, const Vector3& velocity = Vector3::Zero()) {
  scene.addObstacle(Superellipsoid(1, center, Vector3::Ones(), Vector3::Constant(2.0), 0.0, velocity));
  scene.surroundings.obstacles.back().stamp = 100.0;
  return scene.surroundings.obstacles.back();
}

TEST(Shortfall, IsNoneWhereTheLeastDistanceIsKept) {
  CheckScene scene;
  EXPECT_EQ(ofFlight(scene), 0.0);
  addSphere(scene, Vector3(6.0, 1.51, 0.0));
  EXPECT_EQ(ofFlight(scene), 0.0);
}

TEST(Shortfall, IsWhatTheDistanceLacksTimesHowLong) {
  for (const double lacks : {0.05, 0.2, 0.9}) {
    CheckScene scene;
    addSphere(scene, Vector3(0.0, 1.5 - lacks, 0.0));
    EXPECT_NEAR(ofRest(scene), kShortfallTime * lacks, 1e-6);
    EXPECT_NEAR(ofRest(scene, 500.0), kShortfallTime * lacks, 1e-6) << "at rest for good";
  }
}

// Through a wall is no way out of it: else a UAV that cannot stop before one flies on at full speed.
TEST(Shortfall, OfAWallIsThatOfWhoStaysInIt) {
  VoxelMapBuilder builder(0.1);
  builder.setBox({60, -50, -50}, {62, 50, 50});
  const auto wall = builder.build();
  CheckScene scene;
  scene.surroundings.map = wall.get();
  scene.surroundings.map_distance = 0.5;
  EXPECT_NEAR(ofFlight(scene), 0.5 * (kShortfallTime - 2.9), 0.1) << "it gets there after 2.9 s";
  // It begins in the wall: out of that it may fly.
  VoxelMapBuilder around(0.1);
  around.setBox({-1, -50, -50}, {1, 50, 50});
  const auto start = around.build();
  scene.surroundings.map = start.get();
  EXPECT_LT(ofFlight(scene), 0.2);
}

// Not the sum: one conflict more does not make a moment worse than its worst.
TEST(Shortfall, IsThatOfTheWorstAtEachMoment) {
  CheckScene scene;
  addSphere(scene, Vector3(0.0, 1.2, 0.0));
  addSphere(scene, Vector3(1.4, 0.0, 0.0));
  EXPECT_NEAR(ofRest(scene), kShortfallTime * 0.3, 1e-6);
}

// Both begin inside, as deep: only how soon they leave tells them apart.
TEST(Shortfall, IsLessForWhomLeavesSooner) {
  CheckScene scene;
  addSphere(scene, Vector3(-0.5, 0.0, 0.0));
  const double staying = ofRest(scene);
  const double leaving = ofFlight(scene);
  EXPECT_NEAR(staying, kShortfallTime * 1.0, 1e-6);
  EXPECT_GT(leaving, 0.0);
  EXPECT_LT(leaving, 0.1 * staying);
}

// A UAV that stands has to get out of the way of what arrives only later.
TEST(Shortfall, CountsWhatComesToTheRestingPlaceInTime) {
  const auto coming = [](double arrival) {
    CheckScene scene;
    addSphere(scene, Vector3(0.0, 1.5 + arrival, 0.0), Vector3(0.0, -1.0, 0.0));
    return ofRest(scene);
  };
  EXPECT_GT(coming(8.0), coming(9.0));
  EXPECT_GT(coming(9.0), 0.0);
  EXPECT_EQ(coming(kShortfallTime + 0.1), 0.0);
}

TEST(Shortfall, LooksAtWhatIsStillToCome) {
  CheckScene scene;
  addSphere(scene, Vector3(2.0, 1.0, 0.0));
  EXPECT_GT(ofFlight(scene), 0.1);
  EXPECT_EQ(ofFlight(scene, 103.0), 0.0) << "passed after 1 s";
}

// As the check demands it: a prediction does not turn worse for ever.
TEST(Shortfall, GrowsWithTheAgeOfThePredictionUntilGrowthEnds) {
  const auto lacks = [](double rate, double growth_time, double age) {
    CheckScene scene;
    PredictedObstacle& obstacle = addSphere(scene, Vector3(0.0, 1.5, 0.0));
    obstacle.stamp = 100.0 - age;
    obstacle.growth_rate = rate;
    obstacle.growth_time = growth_time;
    return ofRest(scene) / kShortfallTime;
  };
  EXPECT_NEAR(lacks(0.3, 1.0, 10.0), 0.3, 1e-6);
  EXPECT_NEAR(lacks(0.1, 100.0, 0.0), 0.1 * 0.5 * kShortfallTime, 1e-6);
  EXPECT_NEAR(lacks(0.1, 100.0, 7.0), 0.1 * (7.0 + 0.5 * kShortfallTime), 1e-6);
}

TEST(Shortfall, EndsWithAPredictionsValidity) {
  CheckScene scene;
  addSphere(scene, Vector3(0.0, 1.0, 0.0)).valid_until = 102.0;
  EXPECT_NEAR(ofRest(scene), 2.0 * 0.5, 1e-6);
}

TEST(Shortfall, IsWhatTheDistanceFromAUavLacks) {
  CheckScene scene;
  CommittedMotion other;
  other.assignRest(100.0, Vector3(0.0, 1.7, 0.0));
  scene.addMotion(other, 104.0);
  EXPECT_NEAR(ofRest(scene), 4.0 * 0.5, 1e-6) << "flown for 4 s at most";
  scene.limits.pair_horizontal = 1.6;
  EXPECT_EQ(ofRest(scene), 0.0);
}

TEST(Shortfall, OfAPairIsMeasuredByItsEllipsoid) {
  CheckScene scene;
  scene.limits.pair_vertical = 4.0;
  CommittedMotion other;
  other.assignRest(100.0, Vector3(0.0, 0.0, 3.0));
  scene.addMotion(other);
  EXPECT_NEAR(ofRest(scene), kShortfallTime * 0.25 * 2.2, 1e-6);
  scene.limits.pair_vertical = 2.9;
  EXPECT_EQ(ofRest(scene), 0.0);
}

}  // namespace
}  // namespace swarm_planner
