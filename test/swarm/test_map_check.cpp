// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What the check lets through near the voxels of a map is flown: if these fail UAVs fly into walls, or stand in front
// of doors.
#include <gtest/gtest.h>

#include <algorithm>

#include "check_scene.hpp"
#include "swarm_planner/swarm/plan_start.hpp"

namespace swarm_planner {
namespace {

constexpr double kLeast = 0.25;  // [m]
constexpr double kResolution = 0.1;
constexpr double kSample = 1e-3;  // [s]

double leastDistance(const CommittedMotion& motion, const VoxelMap& map, double step = kSample) {
  double least = 10.0;
  for (double t = 0.0; t <= motion.duration() + step; t += step) {
    least = std::min(least, map.distance(motion.after(t).p, least));
  }
  return least;
}

void setMap(CheckScene& scene, const VoxelMap& map) {
  scene.surroundings.map = &map;
  scene.surroundings.map_distance = kLeast;
}

/// Voxels about where the plan comes along, none nearer to it than `clearance` [m].
std::shared_ptr<const VoxelMap> voxelsAbout(Random& random, const CommittedMotion& motion, double clearance) {
  VoxelMapBuilder builder(kResolution);
  for (int i = 0; i < 60; ++i) {
    const Vector3 p =
        motion.after(random.uniform(0.0, motion.duration())).p + random.uniform(0.3, 1.5) * random.direction();
    const Vector3 low = p / kResolution;
    const VoxelIndex voxel(static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(low.z()));
    VoxelMapBuilder one(kResolution);
    one.set(voxel.x(), voxel.y(), voxel.z());
    if (leastDistance(motion, *one.build(), 20.0 * kSample) >= clearance) builder.set(voxel.x(), voxel.y(), voxel.z());
  }
  return builder.build();
}

/// A wall of one voxel's thickness whose near face is x = 2 m, with a hole of `width` [m] about y = z = 0.
std::shared_ptr<const VoxelMap> wallWithHole(double width) {
  VoxelMapBuilder builder(kResolution);
  const int half = static_cast<int>(std::lround(0.5 * width / kResolution));
  builder.setBox({20, -40, -40}, {21, 40, -half});
  builder.setBox({20, -40, half}, {21, 40, 40});
  builder.setBox({20, -40, -half}, {21, -half, half});
  builder.setBox({20, half, -half}, {21, 40, half});
  return builder.build();
}

void planFrom(CheckScene& scene, const KinematicState& start) {
  Trajectory plan;
  coastingPlan(start, 0.0, 0.15, plan);
  scene.plan(plan);
}

/// Straight ahead along x, from `start` on, with 2 m/s to rest.
void planAhead(CheckScene& scene, const Vector3& start) {
  KinematicState x;
  x.p = start;
  x.v = Vector3(2.0, 0.0, 0.0);
  planFrom(scene, x);
}

TEST(MapCheck, AcceptsNothingThatSamplesFindTooClose) {
  Random random(1);
  int accepted = 0;
  int refused = 0;
  int refused_though_clear = 0;
  for (int n = 0; n < 160; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 3.0);
    if (!scene.check().accepted()) continue;
    const auto map = voxelsAbout(random, scene.motion, random.uniform(0.0, 0.6));
    setMap(scene, *map);
    const CheckVerdict verdict = scene.check();
    const double least = leastDistance(scene.motion, *map);
    if (verdict.accepted()) {
      ++accepted;
      ASSERT_GE(least, kLeast - 2e-6) << n;
    } else {
      ++refused;
      EXPECT_EQ(verdict.reason, CheckReason::kMap);
      if (least > kLeast + 0.001) ++refused_though_clear;
    }
  }
  EXPECT_GT(accepted, 30);
  EXPECT_GT(refused, 30);
  EXPECT_EQ(refused_though_clear, 0);
}

TEST(MapCheck, KnowsWallsFromDoors) {
  for (const double width : {0.0, 0.4, 0.6, 1.0}) {
    CheckScene scene;
    planAhead(scene, Vector3::Zero());
    ASSERT_TRUE(scene.check().accepted()) << "without the map nothing is in the way";
    const auto map = wallWithHole(width);
    setMap(scene, *map);
    EXPECT_EQ(scene.check().accepted(), width > 2.0 * kLeast) << width;
  }
}

TEST(MapCheck, AsksNoMoreThanTheMotionBeforeHas) {
  const auto map = wallWithHole(0.0);
  const Vector3 near(1.85, 0.0, 0.0);  // 0.15 m before the wall
  KinematicState away;
  away.p = near;
  away.v = Vector3(-0.5, 0.0, 0.0);
  KinematicState along;
  along.p = near;
  along.v = Vector3(0.0, 0.5, 0.0);
  KinematicState towards;
  towards.p = near;
  towards.v = Vector3(0.5, 0.0, 0.0);
  for (const KinematicState& start : {away, along, towards}) {
    CheckScene scene;
    planFrom(scene, start);
    setMap(scene, *map);
    EXPECT_FALSE(scene.check().accepted());
    scene.committed = near;
    EXPECT_EQ(scene.check().accepted(), start.v.x() <= 0.0);
  }
}

TEST(MapCheck, LeadsOutOfAVoxelButNotIntoOthers) {
  VoxelMapBuilder builder(kResolution);
  builder.set(0, 0, 0);
  builder.setBox({20, -40, -40}, {21, 40, 40});
  const auto map = builder.build();
  for (const double direction : {-1.0, 1.0}) {
    CheckScene scene;
    KinematicState x;
    x.p = Vector3::Constant(0.05);
    x.v = Vector3(2.0 * direction, 0.0, 0.0);
    planFrom(scene, x);
    setMap(scene, *map);
    scene.committed = x.p;
    EXPECT_EQ(scene.check().accepted(), direction < 0.0);
  }
}

TEST(MapCheck, RefusesRestsThatAMapCoversUnlessTheyWereThere) {
  const auto map = wallWithHole(0.0);
  CommittedMotion rest;
  rest.assignRest(0.0, Vector3(1.9, 0.0, 0.0));
  CheckScene scene;
  setMap(scene, *map);
  EXPECT_EQ(checkClearance(rest, scene.committed, scene.limits, scene.surroundings).reason, CheckReason::kMap);
  EXPECT_TRUE(checkClearance(rest, rest.start(), scene.limits, scene.surroundings).accepted());
}

}  // namespace
}  // namespace swarm_planner
