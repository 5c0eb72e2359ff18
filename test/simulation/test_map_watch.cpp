// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a flight through a wall of a map is reported as clear.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "swarm_planner/simulation/run_monitor.hpp"

namespace swarm_planner {
namespace {

constexpr double kRadius = 0.2;

/// A wall of voxels 0.1 m wide, x from 2 to 2.1 m, y and z from -1 to 1 m.
std::shared_ptr<const VoxelMap> wall() {
  VoxelMapBuilder builder(0.1);
  builder.setBox({20, -10, -10}, {21, 10, 10});
  return builder.build();
}

TEST(MapWatch, ClearanceIsFromTheVoxelsSurfaceLessTheUavsRadius) {
  MapWatch watch(wall(), kRadius);
  EXPECT_FALSE(watch.minClearance());
  EXPECT_TRUE(watch.observe({Vector3(-500, 0, 0)}).empty());
  EXPECT_NEAR(*watch.minClearance(), 502.0 - kRadius, 1e-9);
  for (int i = 0; i <= 100; ++i) EXPECT_TRUE(watch.observe({Vector3(0.01 * i, 0, 0)}).empty());
  EXPECT_NEAR(*watch.minClearance(), 1.0 - kRadius, 1e-9);
}

TEST(MapWatch, EveryPassThroughTheWallIsOneContact) {
  MapWatch watch(wall(), kRadius);
  int contacts = 0;
  for (double t = 0.0; t < 20.0; t += 0.01) {
    contacts += static_cast<int>(watch.observe({Vector3(2.0 - std::cos(0.1 * M_PI * t), 0, 0)}).size());
  }
  EXPECT_EQ(contacts, 2);
  EXPECT_NEAR(*watch.minClearance(), -kRadius, 1e-9);
}

TEST(MapWatch, AMapThatChangesCountsFromThenOn) {
  MapWatch watch(nullptr, kRadius);
  EXPECT_TRUE(watch.observe({Vector3(2, 0, 0)}).empty());
  watch.setMap(wall());
  EXPECT_EQ(watch.observe({Vector3(2, 0, 0)}).size(), 1U) << "it does not move, but there is a wall now";
  EXPECT_NEAR(*watch.minClearance(), -kRadius, 1e-9);
  watch.setMap(nullptr);
  EXPECT_TRUE(watch.observe({Vector3(2, 0, 0)}).empty());
  EXPECT_NEAR(*watch.minClearance(), -kRadius, 1e-9);
}

TEST(MapWatch, NothingIsMeasuredWithoutVoxels) {
  MapWatch none(nullptr, kRadius), empty(VoxelMapBuilder(0.1).build(), kRadius);
  for (MapWatch* watch : {&none, &empty}) {
    EXPECT_TRUE(watch->observe({Vector3::Zero()}).empty());
    EXPECT_FALSE(watch->minClearance());
  }
}

/// The distance to the nearest occupied voxel of an octree, all of whose leaves are looked at.
double bruteDistance(const octomap::OcTree& tree, const Vector3& p) {
  double least = 1e9;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const Vector3 center(leaf.getX(), leaf.getY(), leaf.getZ());
    const Vector3 gap = ((p - center).array().abs() - 0.5 * leaf.getSize()).max(0.0);
    least = std::min(least, gap.norm());
  }
  return least;
}

TEST(MapWatch, AFlightIsMeasuredAsOctoMapItselfMeasuresIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  octomap::OcTree tree(0.1);
  VoxelMapBuilder builder(0.1);
  for (int i = 0; i < 60; ++i) {
    const Vector3 p(place(random), place(random), place(random));
    tree.updateNode(octomap::point3d(p.cast<float>().x(), p.cast<float>().y(), p.cast<float>().z()), true);
    const VoxelIndex voxel = (p.cast<float>().cast<double>() / 0.1).array().floor().cast<int>();
    builder.set(voxel.x(), voxel.y(), voxel.z());
  }
  MapWatch watch(builder.build(), kRadius);
  double least = 1e9;
  for (double t = 0.0; t < 6.0; t += 0.01) {
    const std::vector<Vector3> positions = {{4 * std::cos(t), 4 * std::sin(t), 0.5 * t},
                                            {3 * std::sin(2 * t), 3 * std::cos(3 * t), std::cos(5 * t)}};
    watch.observe(positions);
    for (const Vector3& p : positions) least = std::min(least, bruteDistance(tree, p) - kRadius);
    ASSERT_NEAR(*watch.minClearance(), least, 1e-6) << t;
  }
}

TEST(MapWatch, ARunThroughAWallHasACollisionWithTheMap) {
  Mission mission;
  mission.map = wall();
  mission.scenario.end.duration = 4.0;
  ScenarioUav uav;
  uav.reference = {Vector3::Zero(), Vector3(10, 0, 0)};
  mission.scenario.uavs = {uav};
  RunMonitor monitor(mission);
  for (double t = 0.0; !monitor.ended(); t += 0.01) monitor.observe(t, {UavSample{Vector3(t, 0, 0)}}, {});
  const RunSummary run = monitor.summary();
  ASSERT_EQ(run.collisions.size(), 1U);
  EXPECT_TRUE(run.collisions[0].with_obstacle);
  EXPECT_EQ(run.collisions[0].partner, kMapPartner);
  EXPECT_NEAR(run.collisions[0].time, 2.0 - mission.parameters.limits.uav_radius, 0.011);
  EXPECT_NEAR(*run.min_obstacle_clearance, -mission.parameters.limits.uav_radius, 1e-9);
}

}  // namespace
}  // namespace swarm_planner
