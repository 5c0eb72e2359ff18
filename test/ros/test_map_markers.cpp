// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, rviz shows other walls than there are, or stands still under a large map.
#include <gtest/gtest.h>

#include "swarm_planner/ros/map_markers.hpp"

namespace swarm_planner {
namespace {

/// A solid cube of 32 voxels along an edge, 0.1 m each.
std::shared_ptr<const VoxelMap> cube() {
  VoxelMapBuilder builder(0.1);
  builder.setBox({-16, -16, 0}, {16, 16, 32});
  return builder.build();
}

TEST(MapMarkers, TheSurfaceIsDrawnNotWhatIsInside) {
  const MapDrawing drawing = drawingOf(*cube(), 100.0, 100000);
  EXPECT_DOUBLE_EQ(drawing.width, 0.1);
  EXPECT_EQ(drawing.centers.size(), 32U * 32U * 32U - 30U * 30U * 30U);
}

TEST(MapMarkers, WhatIsAboveIsLeftOut) {
  for (const Vector3& center : drawingOf(*cube(), 1.0, 100000).centers) EXPECT_LT(center.z(), 1.0);
  EXPECT_EQ(drawingOf(*cube(), 1.0, 100000).centers.size(), 32U * 32U + 9U * 4U * 31U);
  EXPECT_TRUE(drawingOf(*cube(), -5.0, 100000).centers.empty());
}

TEST(MapMarkers, LargeMapsAreDrawnCoarser) {
  const auto map = cube();
  const MapDrawing drawing = drawingOf(*map, 100.0, 1500);
  EXPECT_DOUBLE_EQ(drawing.width, 0.2);
  EXPECT_EQ(drawing.centers.size(), 16U * 16U * 16U - 14U * 14U * 14U);
  for (const Vector3& center : drawing.centers) EXPECT_TRUE(map->isOccupied(center));
}

TEST(MapMarkers, TheHighestUavCounts) {
  Scenario scenario;
  scenario.uavs.resize(2);
  scenario.uavs[0].start = Vector3(0, 0, 3);
  scenario.uavs[1].reference = {Vector3(0, 0, 1), Vector3(0, 0, 4)};
  EXPECT_DOUBLE_EQ(highestPoint(scenario), 4.0);
}

}  // namespace
}  // namespace swarm_planner
