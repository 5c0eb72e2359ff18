// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "support/random.hpp"
#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/map/voxel_map_editor.hpp"

namespace swarm_planner {
namespace {

constexpr double kResolution = 0.1;

using Voxels = std::set<std::array<int, 3>>;

double gapTo(const Box& box, const Vector3& p) { return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).norm(); }

/// From a point to the nearest of some voxels [m], by brute force.
double leastGap(const Voxels& voxels, const Vector3& p, double limit) {
  double least = limit;
  for (const auto& [x, y, z] : voxels) {
    const Vector3 low = kResolution * Vector3(x, y, z);
    least = std::min(least, gapTo({low, low + Vector3::Constant(kResolution)}, p));
  }
  return least;
}

Voxels randomVoxels(Random& random, int count, int extent) {
  Voxels voxels;
  for (int i = 0; i < count; ++i) {
    voxels.insert({random.integer(-extent, extent), random.integer(-extent, extent), random.integer(-extent, extent)});
  }
  return voxels;
}

std::shared_ptr<const VoxelMap> mapOf(const Voxels& voxels, const VoxelMap* previous = nullptr) {
  VoxelMapBuilder builder(kResolution);
  for (const auto& [x, y, z] : voxels) builder.set(x, y, z);
  return builder.build(previous);
}

TEST(VoxelMap, HoldsWhatWasSetAndNothingElse) {
  Random random(1);
  const Voxels voxels = randomVoxels(random, 3000, 40);
  const auto map = mapOf(voxels);
  EXPECT_EQ(map->occupiedCount(), voxels.size());
  for (int i = 0; i < 20000; ++i) {
    const std::array<int, 3> v{random.integer(-45, 45), random.integer(-45, 45), random.integer(-45, 45)};
    const Vector3 inside = kResolution * (Vector3(v[0], v[1], v[2]) + random.vector(0.01, 0.99));
    ASSERT_EQ(map->isOccupied(inside), voxels.count(v) == 1) << inside.transpose();
  }
}

TEST(VoxelMap, DistancesAreThoseToTheNearestVoxel) {
  Random random(2);
  for (const int count : {5, 200, 3000}) {
    const Voxels voxels = randomVoxels(random, count, 36);
    const auto map = mapOf(voxels);
    for (int i = 0; i < 200; ++i) {
      const Vector3 p = random.vector(-5.0, 5.0);
      const double limit = random.logUniform(0.05, 8.0);
      const VoxelMap::Nearest nearest = map->findNearest(p, limit);
      ASSERT_NEAR(nearest.distance, leastGap(voxels, p, limit), 1e-9) << p.transpose() << " within " << limit;
      if (nearest.distance >= limit) continue;
      EXPECT_NEAR((nearest.point - p).norm(), nearest.distance, 1e-9);
      EXPECT_LT(leastGap(voxels, nearest.point, 1.0), 1e-9);
    }
  }
}

TEST(VoxelMap, BoxesAreVisitedVoxelByVoxel) {
  Random random(3);
  const Voxels voxels = randomVoxels(random, 2000, 40);
  const auto map = mapOf(voxels);
  for (int i = 0; i < 50; ++i) {
    Box box;
    box.include(random.vector(-4.5, 4.5));
    box.include(random.vector(-4.5, 4.5));
    Voxels expected;
    for (const auto& [x, y, z] : voxels) {
      const Vector3 low = kResolution * Vector3(x, y, z);
      if (box.near({low, low + Vector3::Constant(kResolution)}, 0.0)) expected.insert({x, y, z});
    }
    Voxels visited;
    map->forEachOccupied(box, [&](const VoxelIndex& v) { EXPECT_TRUE(visited.insert({v.x(), v.y(), v.z()}).second); });
    EXPECT_EQ(visited, expected);
    EXPECT_EQ(map->isEmpty(box), expected.empty());
    const Vector3 small = random.vector(-4.5, 4.5);
    const double gap = map->distance(small, 1.0) / std::sqrt(3.0);
    const auto cube = [&small](double half) {
      return Box{small - Vector3::Constant(half), small + Vector3::Constant(half)};
    };
    EXPECT_TRUE(gap == 0.0 || map->isEmpty(cube(0.999 * gap)));
    EXPECT_FALSE(map->isEmpty(cube(map->distance(small, 10.0) + 1e-9)));
  }
}

TEST(VoxelMap, PrunedLeavesFillTheirCube) {
  VoxelMapBuilder builder(kResolution);
  builder.setBox({-40, 0, 30}, {24, 3, 34});
  builder.setBox({0, 0, 30}, {1, 1, 31});
  const auto map = builder.build();
  EXPECT_EQ(map->occupiedCount(), 64U * 3U * 4U);
  EXPECT_NEAR((map->bounds().min - Vector3(-4.0, 0.0, 3.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((map->bounds().max - Vector3(2.4, 0.3, 3.4)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(map->isOccupied(Vector3(-3.95, 0.05, 3.35)));
  EXPECT_FALSE(map->isOccupied(Vector3(2.45, 0.05, 3.35)));
}

TEST(VoxelMap, OutsideOfTheKnownIsOccupiedWhereAskedFor) {
  VoxelMapBuilder builder(kResolution);
  builder.set(0, 0, 0);
  builder.setOutsideOccupied({-10, -10, -10}, {20, 10, 10});
  const auto map = builder.build();
  EXPECT_TRUE(map->isOccupied(Vector3(2.05, 0.0, 0.0)));
  EXPECT_FALSE(map->isOccupied(Vector3(1.95, 0.0, 0.0)));
  EXPECT_NEAR(map->distance(Vector3(1.8, 0.0, 0.0), 1.0), 0.2, 1e-12);
  EXPECT_NEAR(map->distance(Vector3(0.3, 0.0, 0.05), 1.0), 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(map->distance(Vector3(9.0, 0.0, 0.0), 1.0), 0.0);
  builder.set(0, 0, 0);
  EXPECT_DOUBLE_EQ(builder.build()->distance(Vector3(9.0, 0.0, 0.0), 1.0), 1.0);
}

TEST(VoxelMap, SuccessiveMapsShareTheChunksThatAreEqual) {
  Random random(4);
  Voxels voxels = randomVoxels(random, 2000, 60);
  const auto before = mapOf(voxels);
  voxels.insert({200, 0, 0});
  voxels.erase(voxels.begin());
  const auto after = mapOf(voxels, before.get());
  ASSERT_EQ(after->chunks().size(), before->chunks().size() + 1);
  int changed = 0;
  for (const VoxelMap::Entry& entry : after->chunks()) {
    if (before->chunk(entry.index) != entry.chunk.get()) ++changed;
  }
  EXPECT_EQ(changed, 2);
  VoxelMapBuilder coarser(2.0 * kResolution);
  for (const auto& [x, y, z] : voxels) coarser.set(x, y, z);
  for (const VoxelMap::Entry& entry : coarser.build(before.get())->chunks()) {
    EXPECT_NE(before->chunk(entry.index), entry.chunk.get());
  }
}

TEST(VoxelMap, EditedItIsAsMadeAnew) {
  Random random(6);
  Voxels voxels = randomVoxels(random, 2000, 60);
  voxels.insert({300, 0, 0});
  auto map = mapOf(voxels);
  for (int round = 0; round < 20; ++round) {
    VoxelMapEditor editor(map);
    for (int i = 0; i < 50; ++i) {
      const std::array<int, 3> v{random.integer(-70, 70), random.integer(-70, 70), random.integer(-70, 70)};
      const bool occupied = random.integer(0, 1) == 1;
      editor.set({v[0], v[1], v[2]}, occupied);
      occupied ? static_cast<void>(voxels.insert(v)) : static_cast<void>(voxels.erase(v));
    }
    if (round == 10) {
      editor.set({300, 0, 0}, false);
      voxels.erase({300, 0, 0});
    }
    const auto before = map;
    map = editor.build();
    const auto anew = mapOf(voxels);
    ASSERT_EQ(map->occupiedCount(), anew->occupiedCount());
    ASSERT_EQ(map->chunks().size(), anew->chunks().size());
    EXPECT_NEAR((map->bounds().max - anew->bounds().max).norm(), 0.0, 1e-9);
    for (const VoxelMap::Entry& entry : anew->chunks()) ASSERT_TRUE(*map->chunk(entry.index) == *entry.chunk);
    EXPECT_TRUE(round >= 10 || map->chunk({9, 0, 0}) == before->chunk({9, 0, 0})) << "what was not edited is shared";
  }
}

TEST(VoxelMap, FingerprintsTellWhetherAPlaceHasChanged) {
  Random random(5);
  const Voxels voxels = randomVoxels(random, 500, 60);
  const auto map = mapOf(voxels);
  const Box box{Vector3(-1, -1, -1), Vector3(1, 1, 1)};
  Voxels more = voxels;
  more.insert({200, 0, 0});
  EXPECT_EQ(mapOf(voxels)->fingerprint(box), map->fingerprint(box));
  EXPECT_EQ(mapOf(more)->fingerprint(box), map->fingerprint(box));
  more.insert({3, 3, 3});
  EXPECT_NE(mapOf(more)->fingerprint(box), map->fingerprint(box));
  VoxelMapBuilder bounded(kResolution);
  for (const auto& [x, y, z] : voxels) bounded.set(x, y, z);
  bounded.setOutsideOccupied({-100, -100, -100}, {100, 100, 100});
  EXPECT_NE(bounded.build()->fingerprint(box), map->fingerprint(box));
  // A voxel in another place of the same chunk, and in another chunk.
  EXPECT_NE(mapOf({{0, 0, 0}})->fingerprint(box), mapOf({{0, 0, 1}})->fingerprint(box));
  EXPECT_NE(mapOf({{0, 0, 0}})->fingerprint(box), mapOf({{-32, 0, 0}})->fingerprint(box));
}

TEST(VoxelMap, EmptyMapsAndStrangePointsAreHandled) {
  const auto empty = mapOf({});
  EXPECT_EQ(empty->occupiedCount(), 0U);
  EXPECT_DOUBLE_EQ(empty->distance(Vector3::Zero(), 3.0), 3.0);
  EXPECT_FALSE(empty->isOccupied(Vector3(Vector3::Zero())));
  const auto map = mapOf({{0, 0, 0}});
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(map->distance(Vector3::Constant(infinity), 3.0), 3.0);
  EXPECT_NEAR(map->distance(Vector3(0.05, 0.05, 1000.1), infinity), 1000.0, 1e-9);
  EXPECT_DOUBLE_EQ(map->distance(Vector3(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0), 3.0), 0.0);
  EXPECT_TRUE(map->isOccupied(Vector3(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()))));
}

TEST(VoxelMap, WhatCannotBeAMapIsRefused) {
  for (const double resolution :
       {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(VoxelMapBuilder{resolution}, std::invalid_argument);
  }
  VoxelMapBuilder builder(kResolution);
  EXPECT_THROW(builder.set(kFarthestVoxel, 0, 0), std::out_of_range);
  EXPECT_THROW(VoxelMapEditor(builder.build()).set({kFarthestVoxel, 0, 0}, true), std::out_of_range);
  EXPECT_THROW(builder.setBox({0, -kFarthestVoxel - 1, 0}, {1, 1, 1}), std::out_of_range);
}

}  // namespace
}  // namespace swarm_planner
