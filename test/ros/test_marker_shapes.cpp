// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: obstacles drawn where they are not, or scenes that the camera misses.
#include <gtest/gtest.h>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/ros/marker_shapes.hpp"

namespace swarm_planner {
namespace {

// Six times the signed volume of a closed mesh whose faces turn counter-clockwise seen from outside.
double sixVolumes(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.size(); i += 3) sum += mesh[i].dot(mesh[i + 1].cross(mesh[i + 2]));
  return sum;
}

TEST(SuperellipsoidMesh, EveryVertexLiesOnTheSurface) {
  for (const Vector3& exponents : {Vector3(2, 2, 2), Vector3(2, 3.5, 10), Vector3(8, 8, 8)}) {
    const Vector3 radii(3, 1, 2);
    const Superellipsoid body(1, Vector3::Zero(), radii, exponents, 0.0, Vector3::Zero());
    const TriangleMesh mesh = superellipsoidMesh(radii, exponents, 24);
    ASSERT_EQ(mesh.size() % 3, 0U);
    for (const Vector3& vertex : mesh) EXPECT_NEAR(body.sum(vertex), 1.0, 1e-9) << vertex.transpose();
  }
}

TEST(SuperellipsoidMesh, FillsTheBodyWithFacesOutward) {
  constexpr double kPi = 3.14159265358979323846;
  const double ellipsoid = 4.0 / 3.0 * kPi * 3 * 1 * 2;
  const double drawn = sixVolumes(superellipsoidMesh(Vector3(3, 1, 2), Vector3(2, 2, 2), 64)) / 6.0;
  EXPECT_GT(drawn, 0.98 * ellipsoid);
  EXPECT_LT(drawn, ellipsoid);
}

TEST(QuadrotorMesh, HasTheGivenWidthAndFacesOutward) {
  const TriangleMesh mesh = quadrotorMesh(2.0);
  Eigen::AlignedBox3d box;
  for (const Vector3& vertex : mesh) box.extend(vertex);
  EXPECT_GT(sixVolumes(mesh), 0.0);
  EXPECT_NEAR(box.center().y(), 0.0, 1e-12);
  double reach = 0.0;
  for (const Vector3& vertex : mesh) {
    if (vertex.x() < 0.0) reach = std::max(reach, vertex.head<2>().norm());
  }
  EXPECT_NEAR(reach, 1.0, 0.05);
  EXPECT_GT(box.max().x(), -box.min().x()) << "the nose tells the heading";
}

TEST(Dashes, CoverHalfOfThePathUpToTheLimit) {
  const ReferencePath path({Vector3(0, 0, 0), Vector3(100, 0, 0)});
  const auto ends = dashes(path, 50.0, 1.0);
  ASSERT_EQ(ends.size() % 2, 0U);
  double length = 0.0;
  for (std::size_t i = 0; i < ends.size(); i += 2) length += (ends[i + 1] - ends[i]).norm();
  EXPECT_NEAR(length, 25.0, 1.0);
  EXPECT_LE(ends.back().x(), 50.0);
  EXPECT_TRUE(dashes(ReferencePath({Vector3(1, 2, 3)}), 50.0, 1.0).empty());
}

TEST(ScenePoints, HoldsStartsObstaclesAndTheRunButNotWhatLiesBeyond) {
  const Eigen::AlignedBox3d box = boundingBox(scenePoints(paperSix()));
  EXPECT_LE(box.min().x(), 0.0);
  EXPECT_GE(box.max().x(), 300.0);
  EXPECT_LT(box.max().x(), 400.0);
  EXPECT_LE(box.min().y(), 0.0);
  EXPECT_GE(box.max().y(), 300.0);
}

TEST(ScenePoints, EndsWhereTheTargetsGetToInTheGivenTime) {
  Scenario scenario;
  scenario.end.duration = 10.0;
  scenario.uavs.resize(1);
  scenario.uavs[0].reference = {Vector3(0, 0, 0), Vector3(1000, 0, 0)};
  scenario.uavs[0].target.start = 5.0;
  scenario.uavs[0].target.speed = 2.0;
  EXPECT_NEAR(boundingBox(scenePoints(scenario)).max().x(), 25.0, 1e-9);
}

}  // namespace
}  // namespace swarm_planner
