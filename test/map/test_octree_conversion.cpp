// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a map that is updated costs the memory of two, or a map in another frame leaves out part of its walls.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "octree_files.hpp"

namespace swarm_planner {
namespace {

OctreeData dataOf(const octomap::OcTree& tree) {
  std::string why;
  return *parseMapFile(fullFile(tree), why);
}

TEST(OctreeConversion, ChunksThatDidNotChangeAreShared) {
  octomap::OcTree tree(0.1);
  mark(tree, {0, 0, 0}, true);
  mark(tree, {100, 0, 0}, true);
  std::string why;
  const auto before = toVoxelMap(dataOf(tree), false, nullptr, why);
  mark(tree, {101, 0, 0}, true);
  const auto after = toVoxelMap(dataOf(tree), false, before.get(), why);
  ASSERT_EQ(after->chunks().size(), 2U);
  EXPECT_EQ(after->chunks()[0].chunk, before->chunks()[0].chunk);
  EXPECT_NE(after->chunks()[1].chunk, before->chunks()[1].chunk);
  EXPECT_EQ(after->occupiedCount(), 3U);
}

TEST(OctreeConversion, UnknownSpaceOfAHugeBoxIsRefused) {
  octomap::OcTree tree(0.1);
  mark(tree, {-30000, -30000, -30000}, false);
  mark(tree, {30000, 30000, 30000}, false);
  std::string why;
  EXPECT_NE(toVoxelMap(dataOf(tree), false, nullptr, why), nullptr) << why;
  EXPECT_EQ(toVoxelMap(dataOf(tree), true, nullptr, why), nullptr);
  EXPECT_NE(why.find("too large"), std::string::npos) << why;
}

TEST(OctreeConversion, ATurnedMapCoversEveryPointOfItsVoxels) {
  std::string why;
  const auto map = toVoxelMap(dataOf(randomTree(0.1, 2)), false, nullptr, why);
  const Eigen::Isometry3d pose = Eigen::Translation3d(1.23, -0.4, 0.07) * Eigen::AngleAxisd(0.5, Vector3::UnitZ()) *
                                 Eigen::AngleAxisd(0.1, Vector3::UnitX());
  const auto turned = resampled(*map, pose, nullptr, why);
  ASSERT_NE(turned, nullptr) << why;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 0.1);
  map->forEachOccupied(map->bounds(), [&](const VoxelIndex& voxel) {
    const Vector3 low = 0.1 * voxel.cast<double>();
    for (int i = 0; i < 5; ++i) {
      const Vector3 p = pose * Vector3(low + Vector3(share(random), share(random), share(random)));
      EXPECT_TRUE(turned->isOccupied(p)) << p.transpose();
    }
  });
  // No more than about a voxel farther out.
  turned->forEachOccupied(turned->bounds(), [&](const VoxelIndex& voxel) {
    const Vector3 center = 0.1 * (voxel.cast<double>() + Vector3::Constant(0.5));
    EXPECT_LT(map->distance(pose.inverse() * center, 1.0), 0.16);
  });
}

TEST(OctreeConversion, AMapMovedByWholeVoxelsIsTheSame) {
  std::string why;
  const auto map = toVoxelMap(dataOf(randomTree(0.1, 2)), false, nullptr, why);
  const auto moved = resampled(*map, Eigen::Isometry3d(Eigen::Translation3d(0.7, -1.2, 3.0)), nullptr, why);
  ASSERT_NE(moved, nullptr) << why;
  EXPECT_EQ(moved->occupiedCount(), map->occupiedCount());
}

TEST(OctreeConversion, WhatCannotBeTurnedIsRefused) {
  std::string why;
  const auto map = toVoxelMap(dataOf(randomTree(0.1, 2)), true, nullptr, why);
  EXPECT_EQ(resampled(*map, Eigen::Isometry3d::Identity(), nullptr, why), nullptr);
  EXPECT_NE(why.find("unknown space"), std::string::npos) << why;
  const auto known = toVoxelMap(dataOf(randomTree(0.1, 2)), false, nullptr, why);
  EXPECT_EQ(resampled(*known, Eigen::Isometry3d(Eigen::Translation3d(1e9, 0, 0)), nullptr, why), nullptr);
  EXPECT_NE(why.find("far away"), std::string::npos) << why;
}

}  // namespace
}  // namespace swarm_planner
