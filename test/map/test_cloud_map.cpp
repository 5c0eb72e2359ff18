// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a wall that a sensor sees is not in the map, one that is gone stays, or a bad point spoils it.
#include <gtest/gtest.h>

#include <limits>

#include "octree_files.hpp"
#include "support/random.hpp"
#include "swarm_planner/map/cloud_map.hpp"
#include "swarm_planner/map/octree_conversion.hpp"

namespace swarm_planner {
namespace {

constexpr double kRange = 5.0;

/// A wall at x [m], as a sensor sees it.
std::vector<Vector3> wallAt(double x) {
  std::vector<Vector3> points;
  for (double y = -0.95; y < 1.0; y += 0.1) {
    for (double z = 0.05; z < 2.0; z += 0.1) points.emplace_back(x, y, z);
  }
  return points;
}

TEST(CloudMap, AWallIsOccupiedAndTheSpaceBeforeItIsKnown) {
  CloudMap cloud(0.1);
  EXPECT_EQ(cloud.insert(wallAt(3.05), Vector3(0.05, 0.05, 1.05), kRange), wallAt(3.05).size());
  std::string why;
  const auto map = cloud.voxels(true, nullptr, why);
  ASSERT_NE(map, nullptr) << why;
  EXPECT_TRUE(map->isOccupied(Vector3(3.05, 0.05, 1.05)));
  EXPECT_FALSE(map->isOccupied(Vector3(2.05, 0.05, 1.05)));
  EXPECT_TRUE(map->isOccupied(Vector3(3.55, 0.05, 1.05))) << "behind the wall nothing is known";
}

TEST(CloudMap, AWallThatIsSeenThroughGoes) {
  CloudMap cloud(0.1);
  const Vector3 sensor(0.05, 0.05, 1.05);
  cloud.insert(wallAt(2.05), sensor, kRange);
  for (int i = 0; i < 10; ++i) cloud.insert(wallAt(4.05), sensor, kRange);
  std::string why;
  const auto map = cloud.voxels(false, nullptr, why);
  EXPECT_FALSE(map->isOccupied(Vector3(2.05, 0.05, 1.05)));
  EXPECT_TRUE(map->isOccupied(Vector3(4.05, 0.05, 1.05)));
}

TEST(CloudMap, PointsBeyondTheRangeMakeNoWall) {
  CloudMap cloud(0.1);
  cloud.insert(wallAt(kRange + 1.05), Vector3(0.05, 0.05, 1.05), kRange);
  std::string why;
  const auto map = cloud.voxels(false, nullptr, why);
  ASSERT_NE(map, nullptr) << why;
  EXPECT_EQ(map->occupiedCount(), 0U);
}

TEST(CloudMap, UavsAreNoWalls) {
  const std::vector<Vector3> points = {{2.05, 0.45, 1.05}, {2.05, -0.55, 1.05}, {4.05, 0.05, 1.05}};
  for (const double radius : {0.0, 0.5}) {
    CloudMap cloud(0.1);
    const BodyPlaces bodies{{Vector3(0, 0, 1), Vector3(2.05, 0.05, 1.05)}, radius};
    EXPECT_EQ(cloud.insert(points, Vector3(0.05, 0.05, 1.05), kRange, bodies), radius > 0.0 ? 2U : 3U);
    std::string why;
    const auto map = cloud.voxels(false, nullptr, why);
    EXPECT_EQ(map->isOccupied(points[0]), radius == 0.0);
    EXPECT_TRUE(map->isOccupied(points[1]));
    EXPECT_TRUE(map->isOccupied(points[2]));
  }
}

// Its own points are left out as those of the UAV that flies along it: rays to others are not to clear it.
TEST(CloudMap, AWallBesideTheSensorStays) {
  for (const double radius : {0.5, 0.0}) {
    CloudMap cloud(0.1);
    cloud.insert(wallAt(2.05), Vector3(0.05, 0.05, 1.05), kRange);
    for (double y = -0.9; y < 0.9; y += 0.01) {
      const Vector3 sensor(1.7, y, 1.05);
      std::vector<Vector3> points;
      for (const Vector3& point : wallAt(2.05)) {
        if ((point - sensor).norm() >= 0.5) points.push_back(point);
      }
      cloud.insert(points, sensor, kRange, {{sensor}, radius});
    }
    std::string why;
    const std::size_t left = cloud.voxels(false, nullptr, why)->occupiedCount();
    if (radius > 0.0) {
      EXPECT_EQ(left, wallAt(2.05).size());
    } else {
      EXPECT_LT(left, wallAt(2.05).size());
    }
  }
}

TEST(CloudMap, BadPointsAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CloudMap cloud(0.1);
  const std::vector<Vector3> points = {{kNan, 0, 0}, {1, kInfinity, 0}, {1e200, 1e200, 0}, {2.05, 0.05, 1.05}};
  EXPECT_EQ(cloud.insert(points, Vector3(0.05, 0.05, 1.05), kRange), 2U);
  EXPECT_EQ(cloud.insert(points, Vector3(kNan, 0, 0), kRange), 0U);
  EXPECT_EQ(cloud.insert(points, Vector3(1e9, 0, 0), kRange), 0U);
  EXPECT_FALSE(cloud.reaches(Vector3(1e9, 0, 0), kRange));
  std::string why;
  const auto map = cloud.voxels(false, nullptr, why);
  ASSERT_NE(map, nullptr) << why;
  EXPECT_EQ(map->occupiedCount(), 1U);
}

/// That two maps are equal, chunk by chunk.
void expectSame(const VoxelMap& map, const VoxelMap& other) {
  ASSERT_EQ(map.occupiedCount(), other.occupiedCount());
  ASSERT_EQ(map.chunks().size(), other.chunks().size());
  EXPECT_TRUE(map.bounds().min.isApprox(other.bounds().min, 1e-9));
  EXPECT_TRUE(map.bounds().max.isApprox(other.bounds().max, 1e-9));
  for (std::size_t i = 0; i < map.chunks().size(); ++i) {
    ASSERT_EQ(map.chunks()[i].index, other.chunks()[i].index);
    ASSERT_TRUE(*map.chunks()[i].chunk == *other.chunks()[i].chunk);
  }
}

TEST(CloudMap, ChangesGiveTheMapThatTheWholeTreeGives) {
  for (const bool unknown_is_occupied : {false, true}) {
    Random random(3);
    const auto tree = randomTree(0.1, 6);
    std::string why;
    const OctreeData start = *parseMapFile(binaryFile(tree), why);
    const auto present = toVoxelMap(start, unknown_is_occupied, nullptr, why);
    CloudMap cloud(start, present);
    CloudMap anew(start);
    std::shared_ptr<const VoxelMap> last = present;
    int shared = 0;
    for (int i = 0; i < 15; ++i) {
      const Vector3 sensor = random.vector(-3.0, 3.0);
      std::vector<Vector3> points;
      for (int n = 0; n < 200; ++n) points.push_back(sensor + random.uniform(0.3, 4.0) * random.direction());
      cloud.insert(points, sensor, kRange);
      anew.insert(points, sensor, kRange);
      const auto map = cloud.voxels(unknown_is_occupied, nullptr, why);
      ASSERT_NE(map, nullptr) << why;
      // Asked for the other way between, it has no last map to start from.
      ASSERT_NE(anew.voxels(!unknown_is_occupied, nullptr, why), nullptr);
      expectSame(*map, *anew.voxels(unknown_is_occupied, nullptr, why));
      for (const VoxelMap::Entry& entry : map->chunks())
        shared += last->chunk(entry.index) == entry.chunk.get() ? 1 : 0;
      last = map;
    }
    EXPECT_GT(shared, 0);
  }
}

TEST(CloudMap, AnEmptyOneIsNoMap) {
  std::string why;
  EXPECT_EQ(CloudMap(0.1).voxels(false, nullptr, why), nullptr);
  EXPECT_FALSE(why.empty());
}

TEST(CloudMap, CloudsAreAddedToAMapOfAnyKind) {
  const auto tree = randomTree(0.1, 6);
  const auto colored = randomTree<octomap::ColorOcTree>(0.1, 6);
  for (const auto& bytes : {binaryFile(tree), fullFile(tree), fullFile(colored)}) {
    std::string why;
    const auto before = mapOf(bytes, why);
    CloudMap cloud(*parseMapFile(bytes, why));
    EXPECT_EQ(cloud.voxels(false, nullptr, why)->occupiedCount(), before->occupiedCount());
    cloud.insert(wallAt(8.05), Vector3(7.05, 0.05, 1.05), kRange);
    const auto after = cloud.voxels(false, before.get(), why);
    EXPECT_EQ(after->occupiedCount(), before->occupiedCount() + wallAt(8.05).size());
  }
}

TEST(CloudMap, ABadMapIsRefused) {
  OctreeData bad;
  bad.resolution = 0.1;
  bad.bytes.assign(100000, 0x03);
  EXPECT_THROW(CloudMap{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
