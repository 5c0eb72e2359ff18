// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, rviz shows an operator free space where the planner sees none.
#include <gtest/gtest.h>

#include <cmath>

#include "swarm_planner/ros/corridor_drawing.hpp"

namespace swarm_planner {
namespace {

FreePolyhedron cubeOf(double half_width) {
  FreePolyhedron polyhedron;
  polyhedron.window = {Vector3::Constant(-half_width), Vector3::Constant(half_width)};
  return polyhedron;
}

double lengthOf(const std::vector<Vector3>& ends) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) length += (ends[i + 1] - ends[i]).norm();
  return length;
}

TEST(CorridorDrawing, AWindowWithoutPlanesIsABox) {
  const std::vector<Vector3> ends = edgesOf(cubeOf(1.0));
  EXPECT_NEAR(lengthOf(ends), 2.0 * 12.0 * 2.0, 1e-9) << "twelve edges, each of two faces";
  for (const Vector3& end : ends) EXPECT_NEAR(end.lpNorm<Eigen::Infinity>(), 1.0, 1e-9);
}

TEST(CorridorDrawing, PlanesCutTheBox) {
  FreePolyhedron polyhedron = cubeOf(1.0);
  polyhedron.count = 1;
  polyhedron.planes[0].n = Vector3(1, 1, 0).normalized();
  polyhedron.planes[0].offset = -0.5 / std::sqrt(2.0);  // what is left is a prism with five corners
  EXPECT_NEAR(lengthOf(edgesOf(polyhedron)), 2.0 * (2.0 * (5.0 + std::sqrt(4.5)) + 5.0 * 2.0), 1e-9);
  polyhedron.planes[0].offset = 5.0;
  EXPECT_TRUE(edgesOf(polyhedron).empty());
}

TEST(CorridorDrawing, NoEdgeEntersAWall) {
  VoxelMapBuilder builder(0.1);
  builder.setBox({10, -20, -20}, {11, 20, 20});
  const auto map = builder.build();
  CommittedMotion plan;
  plan.assignRest(0.0, Vector3(0.5, 0, 0));
  CorridorDrawing drawing;
  const std::vector<Vector3> ends = drawing.edges(*map, plan, 1.0);
  ASSERT_FALSE(ends.empty());
  for (const Vector3& end : ends) EXPECT_LE(end.x(), 1.0 + 1e-6);
  plan.assignRest(0.0, Vector3(1.05, 0, 0));
  EXPECT_TRUE(drawing.edges(*map, plan, 1.0).empty()) << "within the wall";
}

}  // namespace
}  // namespace swarm_planner
