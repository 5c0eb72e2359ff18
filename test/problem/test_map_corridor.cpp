// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "swarm_planner/problem/map_corridor.hpp"
#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {
namespace {

constexpr double kDistance = 0.25;  // [m]

/// A wall at x = 2 m with a door of 1 m about y = 1.5 m.
std::shared_ptr<const VoxelMap> wallWithDoor() {
  VoxelMapBuilder builder(0.1);
  builder.setBox({20, -60, -30}, {21, 10, 30});
  builder.setBox({20, 20, -30}, {21, 60, 30});
  return builder.build();
}

/// A problem that starts at rest at `start` and follows `path`, with a target at its end.
class Scene {
 public:
  Scene(const Vector3& start, const std::vector<Vector3>& points) : path(points) {
    problem.path = &path;
    problem.start.p = start;
    problem.dt = 0.3;
    problem.bounds.max_speed = 1.5;
    problem.progress = path.nearest(start, 0.0).arc_length;
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      const PathPoint point = path.at(problem.progress + 0.3 * static_cast<double>(k));
      problem.targets[k].p = point.position;
      problem.targets[k].arc_length = point.arc_length;
    }
    request.distance = kDistance;
    request.margin = 0.05;
    request.band = 1.0;
  }
  /// Steady flight from the start with `v` [m/s].
  Trajectory coast(const Vector3& v) const {
    Trajectory plan;
    plan.dt = problem.dt;
    plan.jerks.fill(Vector3::Zero());
    KinematicState start = problem.start;
    start.v = v;
    rollOut(start, plan);
    return plan;
  }
  void buildAbout(const Trajectory& plan) { builder.buildAbout(request, plan, memory, problem); }
  bool holds(int k, const Vector3& p) const {
    const CorridorSegment& segment = problem.corridor.segments[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < segment.count; ++i) {
      if (segment.planes[i].half_space.clearance(p) < -1e-9) return false;
    }
    return (p.array() >= segment.window.min.array()).all() && (p.array() <= segment.window.max.array()).all();
  }
  bool anyHolds(const Vector3& p) const {
    bool any = false;
    for (int k = 0; k < static_cast<int>(kHorizon); ++k) any = any || holds(k, p);
    return any;
  }

  ReferencePath path;
  UavProblem problem;
  CorridorRequest request;
  CorridorBuilder builder;
  CorridorMemory memory;
};

TEST(MapCorridor, IsNoneWithoutAMap) {
  Scene scene(Vector3::Zero(), {Vector3::Zero(), Vector3(6, 0, 0)});
  scene.problem.corridor.active = true;
  scene.buildAbout(scene.coast(Vector3::Zero()));
  EXPECT_FALSE(scene.problem.corridor.active);
}

TEST(MapCorridor, HoldsAClearPlanAndNothingNearVoxels) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(0, 1.5, 0), {Vector3(0, 1.5, 0), Vector3(6, 1.5, 0)});
  scene.request.map = map.get();
  const Trajectory plan = scene.coast(Vector3(0.8, 0, 0));
  scene.buildAbout(plan);
  ASSERT_TRUE(scene.problem.corridor.active);
  for (int k = 0; k < static_cast<int>(kHorizon); ++k) {
    for (const std::size_t knot : {static_cast<std::size_t>(k), static_cast<std::size_t>(k) + 1}) {
      EXPECT_TRUE(scene.holds(k, plan.knots[knot].p)) << k;
    }
    for (double x = -2.0; x < 8.0; x += 0.07) {
      for (double y = -1.0; y < 4.0; y += 0.07) {
        const Vector3 p(x, y, 0.03);
        if (!scene.holds(k, p)) continue;
        EXPECT_GE(map->distance(p, 1.0), kDistance - 1e-6) << p.transpose();
      }
    }
  }
}

TEST(MapCorridor, EndsBeforeAWallThatAPlanLeadsThrough) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(0, -1, 0), {Vector3(0, -1, 0), Vector3(6, -1, 0)});
  scene.request.map = map.get();
  scene.buildAbout(scene.coast(Vector3(0.8, 0, 0)));
  for (int k = 8; k < static_cast<int>(kHorizon); ++k) {
    EXPECT_FALSE(scene.holds(k, Vector3(2.5, -1, 0))) << k;
    EXPECT_TRUE(scene.holds(k, Vector3(1.6, -1, 0))) << k;
  }
}

TEST(MapCorridor, LeadsRoundAlongThePathWhereThePlanStandsStill) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(1.5, -0.5, 0),
              {Vector3(1.5, -0.5, 0), Vector3(1.5, 1.5, 0), Vector3(3, 1.5, 0), Vector3(3, -0.5, 0)});
  scene.request.map = map.get();
  const auto last = static_cast<int>(kHorizon) - 1;
  scene.buildAbout(scene.coast(Vector3::Zero()));
  EXPECT_FALSE(scene.holds(last, Vector3(3, -0.3, 0)));
  scene.builder.buildAlongPath(scene.request, scene.problem);
  EXPECT_TRUE(scene.holds(last, Vector3(3, -0.3, 0)));
  EXPECT_TRUE(scene.holds(0, scene.problem.start.p));
}

TEST(MapCorridor, WaivesTheMarginAtFirstWhereTheStartHasLess) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(1.78, -1, 0), {Vector3(1.78, -1, 0), Vector3(0, -1, 0)});  // 0.22 m before the wall
  scene.request.map = map.get();
  scene.buildAbout(scene.coast(Vector3::Zero()));
  EXPECT_TRUE(scene.holds(0, scene.problem.start.p));
  EXPECT_FALSE(scene.holds(static_cast<int>(kHorizon) - 1, scene.problem.start.p));
}

// What the last cycle found serves again where nothing has changed, and nowhere else: otherwise either the planner does
// everything anew in every cycle, or it flies through what has come.
TEST(MapCorridor, KeepsFreeSpaceThatHasNotChanged) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(0, 1.5, 0), {Vector3(0, 1.5, 0), Vector3(6, 1.5, 0)});
  scene.request.map = map.get();
  const Vector3 v(0.8, 0, 0);
  scene.buildAbout(scene.coast(v));
  const MapCorridor before = scene.problem.corridor;
  ASSERT_GT(scene.memory.count, 2U);
  scene.problem.start.p += scene.problem.dt * v + Vector3(0, 0.01, 0);
  VoxelMapBuilder same(0.1);
  same.setBox({20, -60, -30}, {21, 10, 30});
  same.setBox({20, 20, -30}, {21, 60, 30});
  same.setBox({-200, -200, -200}, {-199, -199, -199});
  const auto changed_elsewhere = same.build();
  scene.request.map = changed_elsewhere.get();
  scene.buildAbout(scene.coast(v));
  for (std::size_t k = 0; k + 4 < kHorizon; ++k) {
    const CorridorSegment& now = scene.problem.corridor.segments[k];
    bool is_known = false;
    for (const CorridorSegment& other : before.segments) is_known = is_known || now.window.min == other.window.min;
    EXPECT_TRUE(is_known) << k;
  }
}

TEST(MapCorridor, LooksAnewWhereTheMapHasChanged) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(0, 1.5, 0), {Vector3(0, 1.5, 0), Vector3(6, 1.5, 0)});
  scene.request.map = map.get();
  const Trajectory plan = scene.coast(Vector3(0.8, 0, 0));
  const Vector3 in_the_door(2.05, 1.5, 0.0);
  scene.buildAbout(plan);
  EXPECT_TRUE(scene.anyHolds(in_the_door));
  scene.buildAbout(plan);
  EXPECT_TRUE(scene.anyHolds(in_the_door)) << "control: with the same map it is free";
  VoxelMapBuilder shut(0.1);
  shut.setBox({20, -60, -30}, {21, 60, 30});
  const auto without_door = shut.build(map.get());
  scene.request.map = without_door.get();
  scene.buildAbout(plan);
  EXPECT_FALSE(scene.anyHolds(in_the_door));
  scene.request.map = map.get();
  scene.buildAbout(plan);
  EXPECT_TRUE(scene.anyHolds(in_the_door)) << "and free again";
}

TEST(MapCorridor, HoldsNoVoxelOverManyCyclesInMapsThatChange) {
  Random random(7);
  int recalled = 0;
  for (int flight = 0; flight < 10; ++flight) {
    Scene scene(Vector3::Zero(), {Vector3::Zero(), Vector3(6, 0, 0)});
    std::shared_ptr<const VoxelMap> map;
    Vector3 v = random.vector(-0.5, 0.5);
    for (int cycle = 0; cycle < 20; ++cycle) {
      if (cycle % 5 == 0) {
        VoxelMapBuilder builder(0.1);
        for (int i = 0; i < 60; ++i) {
          const VoxelIndex low(random.integer(-50, 50), random.integer(-50, 50), random.integer(-50, 50));
          builder.setBox(low, low + VoxelIndex(random.integer(1, 6), random.integer(1, 6), random.integer(1, 6)));
        }
        map = builder.build(map.get());
      }
      scene.request.map = map.get();
      const std::size_t known = scene.memory.count;
      const Box first = scene.memory.parts[0].polyhedron.window;
      scene.buildAbout(scene.coast(v));
      if (known > 0 && scene.memory.parts[0].polyhedron.window.min == first.min) ++recalled;
      for (int i = 0; i < 2000; ++i) {
        const Vector3 p = random.vector(-4.0, 4.0);
        // The margin is waived near the start.
        if (!scene.anyHolds(p)) continue;
        ASSERT_GE(map->distance(p, 1.0), kDistance - scene.request.margin - 1e-6) << flight << ", " << cycle;
      }
      scene.problem.start.p += scene.problem.dt * v;
      v += random.vector(-0.05, 0.05);
    }
  }
  EXPECT_GT(recalled, 20);
}

}  // namespace
}  // namespace swarm_planner
