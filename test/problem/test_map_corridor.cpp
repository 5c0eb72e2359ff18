// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

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
  bool holds(int k, const Vector3& p) const {
    const CorridorSegment& segment = problem.corridor.segments[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < segment.count; ++i) {
      if (segment.planes[i].half_space.clearance(p) < -1e-9) return false;
    }
    return (p.array() >= segment.window.min.array()).all() && (p.array() <= segment.window.max.array()).all();
  }

  ReferencePath path;
  UavProblem problem;
  CorridorRequest request;
  CorridorBuilder builder;
};

TEST(MapCorridor, IsNoneWithoutAMap) {
  Scene scene(Vector3::Zero(), {Vector3::Zero(), Vector3(6, 0, 0)});
  scene.problem.corridor.active = true;
  scene.builder.buildAbout(scene.request, scene.coast(Vector3::Zero()), scene.problem);
  EXPECT_FALSE(scene.problem.corridor.active);
}

TEST(MapCorridor, HoldsAClearPlanAndNothingNearVoxels) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(0, 1.5, 0), {Vector3(0, 1.5, 0), Vector3(6, 1.5, 0)});
  scene.request.map = map.get();
  const Trajectory plan = scene.coast(Vector3(0.8, 0, 0));
  scene.builder.buildAbout(scene.request, plan, scene.problem);
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
  scene.builder.buildAbout(scene.request, scene.coast(Vector3(0.8, 0, 0)), scene.problem);
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
  scene.builder.buildAbout(scene.request, scene.coast(Vector3::Zero()), scene.problem);
  EXPECT_FALSE(scene.holds(last, Vector3(3, -0.3, 0)));
  scene.builder.buildAlongPath(scene.request, scene.problem);
  EXPECT_TRUE(scene.holds(last, Vector3(3, -0.3, 0)));
  EXPECT_TRUE(scene.holds(0, scene.problem.start.p));
}

TEST(MapCorridor, WaivesTheMarginAtFirstWhereTheStartHasLess) {
  const auto map = wallWithDoor();
  Scene scene(Vector3(1.78, -1, 0), {Vector3(1.78, -1, 0), Vector3(0, -1, 0)});  // 0.22 m before the wall
  scene.request.map = map.get();
  scene.builder.buildAbout(scene.request, scene.coast(Vector3::Zero()), scene.problem);
  EXPECT_TRUE(scene.holds(0, scene.problem.start.p));
  EXPECT_FALSE(scene.holds(static_cast<int>(kHorizon) - 1, scene.problem.start.p));
}

}  // namespace
}  // namespace swarm_planner
