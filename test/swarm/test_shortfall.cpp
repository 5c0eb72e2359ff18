// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Where nothing is safe the motion that comes too close least is flown. If these fail, a worse one is.
#include <gtest/gtest.h>

#include "check_scene.hpp"
#include "swarm_planner/swarm/shortfall.hpp"

namespace swarm_planner {
namespace {

/// Of a flight along x at 2 m/s from 100 s on, from x = 0 until it stops beyond x = 12 m.
double shortfall(CheckScene& scene, double from = 100.0) {
  scene.plan(straightPlan(Vector3::Zero(), Vector3(2.0, 0.0, 0.0), 100.0, 0.3));
  return worstShortfall(scene.motion, from, scene.limits, scene.surroundings);
}

/// A sphere of 1 m, which keeps UAVs 0.3 m off, or 0.5 m with the margin.
PredictedObstacle& addSphere(CheckScene& scene, const Vector3& center, const Vector3& velocity = Vector3::Zero()) {
  scene.addObstacle(Superellipsoid(1, center, Vector3::Ones(), Vector3::Constant(2.0), 0.0, velocity));
  scene.surroundings.obstacles.back().stamp = 100.0;
  return scene.surroundings.obstacles.back();
}

TEST(Shortfall, IsNoneWhereTheLeastDistanceIsKept) {
  CheckScene scene;
  EXPECT_EQ(shortfall(scene), 0.0);
  addSphere(scene, Vector3(6.0, 1.31, 0.0));
  EXPECT_EQ(shortfall(scene), 0.0) << "a margin that is used up is no danger";
}

TEST(Shortfall, IsWhatTheDistanceFromAnObstacleLacks) {
  for (const double lacks : {0.05, 0.2, 0.9}) {
    CheckScene scene;
    addSphere(scene, Vector3(6.0, 1.3 - lacks, 0.0));
    EXPECT_NEAR(shortfall(scene), lacks, 1e-3);
  }
}

TEST(Shortfall, IsThatOfTheWorstMoment) {
  CheckScene scene;
  addSphere(scene, Vector3(3.0, 1.2, 0.0));
  addSphere(scene, Vector3(6.0, 1.0, 0.0));
  addSphere(scene, Vector3(9.0, 1.1, 0.0));
  EXPECT_NEAR(shortfall(scene), 0.3, 1e-3);
  EXPECT_NEAR(shortfall(scene, 103.8), 0.2, 1e-3) << "what is over does not count";
}

TEST(Shortfall, MovesTheObstacleOn) {
  CheckScene scene;
  // At the crossing when the UAV is there, 3 s after the epoch; seen a second before.
  addSphere(scene, Vector3(6.0, 5.1, 0.0), Vector3(0.0, -1.0, 0.0)).stamp = 99.0;
  EXPECT_NEAR(shortfall(scene), 0.3 + 1.0 - 0.8, 0.35);
  CheckScene later;
  addSphere(later, Vector3(6.0, 15.0, 0.0), Vector3(0.0, -1.0, 0.0));
  EXPECT_EQ(shortfall(later), 0.0);
}

// As the check demands it: a prediction does not turn worse for ever.
TEST(Shortfall, GrowsWithTheAgeOfThePredictionUntilGrowthEnds) {
  const auto lacks = [](double rate, double growth_time, double age) {
    CheckScene scene;
    PredictedObstacle& obstacle = addSphere(scene, Vector3(6.0, 1.5, 0.0));
    obstacle.stamp = 100.0 - age;
    obstacle.growth_rate = rate;
    obstacle.growth_time = growth_time;
    return shortfall(scene);
  };
  EXPECT_EQ(lacks(0.1, 1.0, 0.0), 0.0);
  EXPECT_NEAR(lacks(0.3, 1.0, 0.0), 0.1, 1e-3);
  EXPECT_NEAR(lacks(0.3, 1.0, 10.0), 0.1, 1e-3);
  EXPECT_NEAR(lacks(0.1, 100.0, 7.0), 0.8, 0.02);
}

TEST(Shortfall, EndsWithAPredictionsValidity) {
  CheckScene scene;
  addSphere(scene, Vector3(6.0, 1.0, 0.0)).valid_until = 102.0;  // it is reached after 2.2 s
  EXPECT_EQ(shortfall(scene), 0.0);
  scene.surroundings.obstacles[0].valid_until = 104.0;
  EXPECT_NEAR(shortfall(scene), 0.3, 1e-3);
}

TEST(Shortfall, IsWhatTheDistanceFromAUavLacks) {
  CheckScene scene;
  scene.plan(straightPlan(Vector3::Zero(), Vector3(2.0, 0.0, 0.0), 100.0, 0.3));
  CommittedMotion other;
  other.assignRest(100.0, Vector3(6.0, 1.5, 0.0));
  scene.addMotion(other, 104.0);
  EXPECT_NEAR(shortfall(scene), 0.5, 1e-3);
  scene.surroundings.uavs[0].valid_until = 101.0;
  EXPECT_EQ(shortfall(scene), 0.0) << "that motion is not flown any more when the UAV comes";
}

TEST(Shortfall, OfAPairIsMeasuredByItsEllipsoid) {
  CheckScene scene;
  scene.limits.pair_vertical = 4.0;
  CommittedMotion other;
  other.assignRest(100.0, Vector3(6.0, 0.0, 3.0));
  scene.addMotion(other);
  EXPECT_NEAR(shortfall(scene), 0.25 * 2.0, 1e-3);
  scene.limits.pair_vertical = 2.9;
  EXPECT_EQ(shortfall(scene), 0.0);
}

// At rest too: an obstacle is where the motion ends.
TEST(Shortfall, CountsTheRestingPlace) {
  CheckScene scene;
  scene.plan(straightPlan(Vector3::Zero(), Vector3(2.0, 0.0, 0.0), 100.0, 0.3));
  addSphere(scene, scene.motion.restingPlace() + Vector3(1.1, 0.0, 0.0));
  EXPECT_NEAR(shortfall(scene), 0.2, 1e-3);
  EXPECT_NEAR(shortfall(scene, 500.0), 0.2, 1e-9);
}

}  // namespace
}  // namespace swarm_planner
