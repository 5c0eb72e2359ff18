// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "swarm_planner/problem/free_polyhedron.hpp"

namespace swarm_planner {
namespace {

constexpr double kResolution = 0.1;

SegmentPoints straight(const Vector3& from, const Vector3& to) {
  return {from, from + (to - from) / 3.0, from + 2.0 * (to - from) / 3.0, to};
}

/// Up to `band` [m] beyond a segment.
Box windowAbout(const SegmentPoints& segment, double band) {
  Box window;
  for (const Vector3& point : segment) {
    window.include(point - Vector3::Constant(band));
    window.include(point + Vector3::Constant(band));
  }
  return window;
}

/// Whether some corner of the voxel is farther in front of the planes, and within the window, than rounding.
bool reachesInto(const FreePolyhedron& polyhedron, const Box& voxel) {
  constexpr double kRounding = 1e-6;
  if (!voxel.near(polyhedron.window, -kRounding)) return false;
  for (std::size_t i = 0; i < polyhedron.count; ++i) {
    const FreePlane& plane = polyhedron.planes[i];
    const Vector3 farthest = (plane.n.array() > 0.0).select(voxel.max, voxel.min);
    if (plane.n.dot(farthest) <= plane.offset + kRounding) return false;
  }
  return true;
}

TEST(FreePolyhedron, HoldsItsSegmentAndNoVoxel) {
  Random random(1);
  PolyhedronSearch search;
  FreePolyhedron polyhedron;
  int free_segments = 0;
  double volume = 0.0;
  for (int n = 0; n < 200; ++n) {
    VoxelMapBuilder builder(kResolution);
    for (int i = random.integer(1, 400); i > 0; --i) {
      const VoxelIndex low(random.integer(-30, 30), random.integer(-30, 30), random.integer(-30, 30));
      builder.setBox(low, low + VoxelIndex(random.integer(1, 6), random.integer(1, 6), random.integer(1, 6)));
    }
    const auto map = builder.build();
    const Vector3 from = random.vector(-2.0, 2.0);
    const SegmentPoints segment = straight(from, from + random.uniform(0.0, 0.6) * random.direction());
    search.find(*map, segment, windowAbout(segment, 1.0), polyhedron);
    double least = 1.0;
    for (int i = 0; i <= 100; ++i) {
      least = std::min(least, map->distance(segment[0] + i / 100.0 * (segment[3] - segment[0]), least));
    }
    if (least < 0.01) continue;
    ++free_segments;
    EXPECT_GT(polyhedron.clearance, 0.0);
    EXPECT_LE(polyhedron.clearance, least + 1e-9);
    map->forEachOccupied(map->bounds(), [&](const VoxelIndex& voxel) {
      ASSERT_FALSE(reachesInto(polyhedron, map->boxOf(voxel))) << n << ": " << voxel.transpose();
    });
    for (const Vector3& point : segment) {
      for (std::size_t i = 0; i < polyhedron.count; ++i) {
        EXPECT_GT(polyhedron.planes[i].n.dot(point), polyhedron.planes[i].offset);
      }
    }
    volume += (polyhedron.window.max - polyhedron.window.min).prod();
  }
  EXPECT_GT(free_segments, 50);
  EXPECT_GT(volume, 0.0);
}

TEST(FreePolyhedron, OfACorridorIsItsCrossSection) {
  VoxelMapBuilder builder(kResolution);
  builder.setBox({-100, 10, -20}, {100, 12, 20});  // walls at y = 1 m and y = -1 m
  builder.setBox({-100, -12, -20}, {100, -10, 20});
  builder.setBox({-100, -12, -12}, {100, 12, -10});  // floor at z = -1 m
  const auto map = builder.build();
  PolyhedronSearch search;
  FreePolyhedron polyhedron;
  const SegmentPoints segment = straight(Vector3(0.0, 0.2, 0.1), Vector3(0.5, 0.25, 0.1));
  search.find(*map, segment, windowAbout(segment, 2.0), polyhedron);
  ASSERT_EQ(polyhedron.count, 3U);
  EXPECT_NEAR(polyhedron.clearance, 0.75, 1e-9);
  for (const Vector3& normal : {Vector3(0, -1, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) {
    bool has = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const FreePlane& plane = polyhedron.planes[i];
      has = has || ((plane.n - normal).norm() < 1e-9 && std::abs(plane.offset + 1.0) < 1e-9);
    }
    EXPECT_TRUE(has) << normal.transpose();
  }
}

TEST(FreePolyhedron, SaysWhereASegmentMeetsAVoxel) {
  VoxelMapBuilder builder(kResolution);
  builder.setBox({5, -20, -20}, {6, 20, 20});
  const auto map = builder.build();
  PolyhedronSearch search;
  FreePolyhedron polyhedron;
  const SegmentPoints segment = straight(Vector3(0, 0, 0), Vector3(1, 0, 0));
  search.find(*map, segment, windowAbout(segment, 1.0), polyhedron);
  EXPECT_DOUBLE_EQ(polyhedron.clearance, 0.0);
}

TEST(FreePolyhedron, EndsWhereTheKnownEnds) {
  VoxelMapBuilder builder(kResolution);
  builder.setOutsideOccupied({-100, -100, -100}, {10, 100, 100});
  const auto map = builder.build();
  PolyhedronSearch search;
  FreePolyhedron polyhedron;
  const SegmentPoints segment = straight(Vector3(0, 0, 0), Vector3(0.4, 0, 0));
  search.find(*map, segment, windowAbout(segment, 2.0), polyhedron);
  ASSERT_EQ(polyhedron.count, 1U);
  EXPECT_NEAR(polyhedron.planes[0].offset, -1.0, 1e-12);
  EXPECT_NEAR(polyhedron.clearance, 0.6, 1e-12);
}

}  // namespace
}  // namespace swarm_planner
