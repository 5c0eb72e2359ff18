// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/generated_maps.hpp"

#include "swarm_planner/config/tight_scenarios.hpp"
#include "swarm_planner/map/octree_writer.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {
namespace {

/// The voxels from `low` on, up to but without `high`.
struct VoxelBox {
  VoxelIndex low, high;
};

void fill(const VoxelBox& box, bool occupied, OctreeWriter& writer) {
  for (int z = box.low.z(); z < box.high.z(); ++z) {
    for (int y = box.low.y(); y < box.high.y(); ++y) {
      for (int x = box.low.x(); x < box.high.x(); ++x) writer.set({x, y, z}, occupied);
    }
  }
}

// The building's plan, in voxels of 0.1 m. Walls, floor and ceiling are two voxels thick, at even places, so that they
// take few cubes.
constexpr double kBuildingResolution = 0.1;  // [m]
constexpr int kLength = 180, kWidth = 120, kHeight = 26, kThickness = 2;
constexpr int kDoorHeight = 21;

/// From floor to ceiling, as seen from above.
VoxelBox wall(int x, int y, int length, int width) { return {{x, y, 0}, {x + length, y + width, kHeight}}; }

std::vector<VoxelBox> buildingWalls() {
  const int length = kLength + kThickness, width = kWidth + kThickness;
  std::vector<VoxelBox> walls = {
      wall(-kThickness, -kThickness, length + kThickness, kThickness),  // outside
      wall(-kThickness, kWidth, length + kThickness, kThickness),
      wall(-kThickness, -kThickness, kThickness, width + kThickness),
      wall(kLength, -kThickness, kThickness, width + kThickness),
      wall(0, 48, kLength, kThickness),  // of the corridor
      wall(0, 70, kLength, kThickness),
      {{-kThickness, -kThickness, -kThickness}, {length, width, 0}},  // floor and ceiling
      {{-kThickness, -kThickness, kHeight}, {length, width, kHeight + kThickness}},
  };
  for (const int x : {60, 120}) {  // between the rooms
    walls.push_back(wall(x, 0, kThickness, 48));
    walls.push_back(wall(x, 72, kThickness, 48));
  }
  return walls;
}

/// As seen from above, through a wall.
VoxelBox door(int x, int y, int length, int width) { return {{x, y, 0}, {x + length, y + width, kDoorHeight}}; }

std::vector<VoxelBox> buildingDoors() {
  std::vector<VoxelBox> doors;
  for (const int x : {26, 86, 146}) doors.push_back(door(x, 48, 10, kThickness));  // from 2.6, 8.6, 14.6 m on
  for (const int x : {36, 96, 156}) doors.push_back(door(x, 70, 10, kThickness));  // from 3.6, 9.6, 15.6 m on
  doors.push_back(door(60, 20, kThickness, 9));                                    // y from 2.0 to 2.9 m
  doors.push_back(door(120, 90, kThickness, 9));                                   // y from 9.0 to 9.9 m
  return doors;
}

/// Pillars and shelves.
std::vector<VoxelBox> buildingFurniture() {
  return {wall(88, 22, 4, 4), wall(30, 94, 4, 4), wall(150, 96, 4, 4), wall(0, 0, 40, 4), wall(124, 0, 4, 30)};
}

std::vector<std::uint8_t> buildingFile() {
  OctreeWriter writer(kBuildingResolution);
  fill({{0, 0, 0}, {kLength, kWidth, kHeight}}, false, writer);
  for (const VoxelBox& box : buildingWalls()) fill(box, true, writer);
  for (const VoxelBox& box : buildingDoors()) fill(box, false, writer);
  for (const VoxelBox& box : buildingFurniture()) fill(box, true, writer);
  return writer.file();
}

constexpr double kForestResolution = 0.2;  // [m]

std::vector<std::uint8_t> forestFile() {
  const Scenario scenario = forest(10, kForestGap, 0);
  const VoxelIndex low = (scenario.workspace->min / kForestResolution).array().floor().cast<int>();
  const VoxelIndex high = (scenario.workspace->max / kForestResolution).array().ceil().cast<int>();
  OctreeWriter writer(kForestResolution);
  fill({low, high}, false, writer);
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    const Superellipsoid tree = makeObstacle(obstacle);
    const VoxelIndex first = ((tree.center() - tree.halfExtents()) / kForestResolution).array().floor().cast<int>();
    const VoxelIndex last = ((tree.center() + tree.halfExtents()) / kForestResolution).array().ceil().cast<int>();
    const VoxelBox box{first.cwiseMax(low), last.cwiseMin(high)};
    for (int z = box.low.z(); z < box.high.z(); ++z) {
      for (int y = box.low.y(); y < box.high.y(); ++y) {
        for (int x = box.low.x(); x < box.high.x(); ++x) {
          const Vector3 middle = kForestResolution * (Vector3(x, y, z) + Vector3::Constant(0.5));
          if (tree.sum(middle - tree.center()) < 1.0) writer.set({x, y, z}, true);
        }
      }
    }
  }
  return writer.file();
}

}  // namespace

const std::vector<GeneratedMap>& generatedMaps() {
  static const std::vector<GeneratedMap> maps = {{"building", buildingFile}, {"forest", forestFile}};
  return maps;
}

}  // namespace swarm_planner
