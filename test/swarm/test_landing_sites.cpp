// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Where UAVs land. If these fail, two come down in one column, or one into what stands there.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "swarm_planner/swarm/landing_sites.hpp"

namespace swarm_planner {
namespace {

TrackedObstacle obstacleAt(const Vector3& center, const Vector3& radii, const Vector3& velocity = Vector3::Zero()) {
  TrackedObstacle track;
  track.shape = Superellipsoid(1, center, radii, Vector3::Constant(2.0), 0.0, velocity);
  return track;
}

double apart(const Vector3& a, const Vector3& b) { return (a - b).head<2>().norm(); }

class LandingSitesTest : public ::testing::Test {
 protected:
  /// Sites of UAVs at `places`, one after the other.
  std::vector<Vector3> assign(const std::vector<Vector3>& places, const std::vector<TrackedObstacle>& obstacles = {}) {
    LandingSites sites(parameters, workspace, places.size());
    sites.begin(obstacles, 0.0);
    std::vector<Vector3> assigned;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::optional<Vector3> site = sites.find(i, places[i], 0.0);
      if (!site) continue;
      sites.take(i, *site);
      assigned.push_back(*site);
    }
    return assigned;
  }

  Parameters parameters;
  std::optional<Workspace> workspace;
};

TEST_F(LandingSitesTest, AreStraightBelowWhereThatIsFree) {
  const std::vector<Vector3> sites = assign({Vector3(3, 4, 10), Vector3(-3, 4, 8)});
  ASSERT_EQ(sites.size(), 2U);
  EXPECT_EQ(sites[0], Vector3(3, 4, 0));
  EXPECT_EQ(sites[1], Vector3(-3, 4, 0));
}

TEST_F(LandingSitesTest, OfUavsAboveEachOtherAreApart) {
  const std::vector<Vector3> places(20, Vector3(1, 2, 10));
  const std::vector<Vector3> sites = assign(places);
  ASSERT_EQ(sites.size(), places.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_LT(apart(sites[i], places[i]), 8.0) << "a nearer one is free";
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(apart(sites[i], sites[j]), parameters.limits.pair_distance + parameters.limits.pair_margin);
    }
  }
}

TEST_F(LandingSitesTest, OfCrowdsAreApart) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(-5.0, 5.0);
  std::vector<Vector3> places;
  for (int i = 0; i < 60; ++i) places.emplace_back(position(random), position(random), 10.0 + position(random));
  const std::vector<Vector3> sites = assign(places);
  ASSERT_EQ(sites.size(), places.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(apart(sites[i], sites[j]), parameters.limits.pair_distance);
  }
  EXPECT_EQ(assign(places), sites) << "the same input gives the same sites";
}

TEST_F(LandingSitesTest, KeepClearOfWhatStandsBelow) {
  const Vector3 place(0, 0, 20);
  const TrackedObstacle below = obstacleAt(Vector3(0.5, 0, 5), Vector3(2, 2, 2));
  const TrackedObstacle beside = obstacleAt(Vector3(9, 0, 5), Vector3(2, 2, 2));
  const TrackedObstacle above = obstacleAt(Vector3(0, 0, 30), Vector3(2, 2, 2));
  EXPECT_EQ(assign({place}, {beside, above}).at(0), Vector3(0, 0, 0));
  const Vector3 site = assign({place}, {below}).at(0);
  // At the height of its centre the obstacle is widest.
  const double distance = below.shape.signedDistance(Vector3(site.x(), site.y(), 5.0));
  EXPECT_GE(distance, parameters.limits.uav_radius + parameters.limits.tracking_margin);
}

// An obstacle that is not there yet but will be.
TEST_F(LandingSitesTest, KeepClearOfWhatWillCome) {
  const Vector3 place(0, 0, 10);
  const TrackedObstacle coming = obstacleAt(Vector3(-20, 0, 1), Vector3(1, 1, 1), Vector3(2, 0, 0));
  const TrackedObstacle leaving = obstacleAt(Vector3(-20, 0, 1), Vector3(1, 1, 1), Vector3(-2, 0, 0));
  EXPECT_EQ(assign({place}, {leaving}).at(0), Vector3(0, 0, 0));
  EXPECT_GE(std::abs(assign({place}, {coming}).at(0).y()), 1.0 + parameters.limits.uav_radius);
}

TEST_F(LandingSitesTest, AreInsideTheWorkspaceOrThereIsNone) {
  workspace = Workspace{Vector3(-3, -3, 1), Vector3(3, 3, 20)};
  for (const Vector3& site : assign(std::vector<Vector3>(6, Vector3(2.5, 2.5, 10)))) {
    EXPECT_LE(site.head<2>().cwiseAbs().maxCoeff(), 3.0 - parameters.limits.tracking_margin);
    EXPECT_EQ(site.z(), 0.0) << "the lower bound does not hold for landings";
  }
  EXPECT_LT(assign(std::vector<Vector3>(60, Vector3(0, 0, 10))).size(), 20U) << "there is no room for so many";
}

TEST_F(LandingSitesTest, AreNoHigherThanTheUav) {
  LandingSites sites(parameters, workspace, 1);
  const std::vector<TrackedObstacle> none;
  sites.begin(none, 0.0);
  EXPECT_EQ(sites.find(0, Vector3(0, 0, -4), 0.0)->z(), -4.0);
}

TEST_F(LandingSitesTest, CanBeKeptUntilSomethingComesUponThem) {
  LandingSites sites(parameters, workspace, 2);
  const std::vector<TrackedObstacle> none;
  const std::vector<TrackedObstacle> blocked{obstacleAt(Vector3(0, 0, 3), Vector3(1, 1, 1))};
  const Vector3 site(0, 0, 0);
  sites.begin(none, 0.0);
  sites.take(0, site);
  EXPECT_TRUE(sites.canKeep(0, site, 10.0)) << "its own column is no hindrance";
  sites.take(1, Vector3(2.1, 0, 5));
  EXPECT_TRUE(sites.canKeep(0, site, 10.0)) << "near, but allowed";
  sites.take(1, Vector3(1.5, 0, 5));
  EXPECT_FALSE(sites.canKeep(0, site, 10.0));
  sites.begin(blocked, 0.0);
  EXPECT_FALSE(sites.canKeep(0, site, 10.0));
  EXPECT_TRUE(sites.canKeep(0, site, 1.0)) << "it is below the obstacle already";
}

}  // namespace
}  // namespace swarm_planner
