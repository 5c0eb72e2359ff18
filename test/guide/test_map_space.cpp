// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "swarm_planner/guide/map_space.hpp"

namespace swarm_planner {
namespace {

constexpr double kDistance = 0.25;  // [m]
constexpr int kSamples = 400;

std::shared_ptr<const VoxelMap> randomMap(Random& random) {
  VoxelMapBuilder builder(0.1);
  for (int i = 0; i < 60; ++i) {
    const VoxelIndex low(random.integer(-30, 30), random.integer(-30, 30), random.integer(-30, 30));
    builder.setBox(low, low + VoxelIndex(random.integer(1, 6), random.integer(1, 6), random.integer(1, 6)));
  }
  return builder.build();
}

double leastOn(const VoxelMap& map, const Vector3& from, const Vector3& to) {
  double least = 1.0;
  for (int i = 0; i <= kSamples; ++i) least = std::min(least, map.distance(from + i * (to - from) / kSamples, least));
  return least;
}

TEST(MapSpace, LinesAreClearWhereTheirPointsAre) {
  Random random(1);
  int clear = 0;
  int blocked = 0;
  for (int n = 0; n < 600; ++n) {
    const auto map = randomMap(random);
    MapSpace space;
    space.set(map.get(), kDistance);
    const Vector3 from = random.vector(-3.5, 3.5);
    const Vector3 to = from + random.uniform(0.0, 3.0) * random.direction();
    const double least = leastOn(*map, from, to);
    if (std::abs(least - kDistance) < 0.005) continue;
    ASSERT_EQ(space.isClear(from, to), least > kDistance) << n << ": " << least;
    ++(least > kDistance ? clear : blocked);
    EXPECT_EQ(space.clearance(from) >= 0.0, map->distance(from, 1.0) >= kDistance);
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(blocked, 100);
}

TEST(MapSpace, FindsWhatIsBlockedOnALine) {
  VoxelMapBuilder builder(0.1);
  builder.setBox({20, -10, -10}, {21, 10, 10});
  builder.setBox({50, -10, -10}, {52, 10, 10});
  const auto map = builder.build();
  MapSpace space;
  space.set(map.get(), kDistance);
  const Vector3 from = Vector3::Zero();
  const Vector3 to(8.0, 0.0, 0.0);
  const auto first = space.firstBlocked(from, to, 0.0);
  ASSERT_TRUE(first);
  EXPECT_NEAR(8.0 * first->begin, 1.75, 0.03);
  EXPECT_NEAR(8.0 * first->end, 2.35, 0.03);
  const auto second = space.firstBlocked(from, to, first->end);
  ASSERT_TRUE(second);
  EXPECT_NEAR(8.0 * second->begin, 4.75, 0.03);
  EXPECT_NEAR(8.0 * second->end, 5.45, 0.03);
  EXPECT_FALSE(space.firstBlocked(from, to, second->end));
  space.set(nullptr, kDistance);
  EXPECT_FALSE(space.firstBlocked(from, to, 0.0)) << "without a map";
  EXPECT_TRUE(space.isClear(from, to));
}

TEST(MapSpace, LetsAFlightLeaveWhereItBeginsTooNear) {
  VoxelMapBuilder builder(0.1);
  builder.setBox({20, -40, -40}, {21, 40, 40});
  const auto map = builder.build();
  MapSpace space;
  space.set(map.get(), kDistance);
  const Vector3 near(1.85, 0.0, 0.0);
  EXPECT_FALSE(space.isClear(near, Vector3::Zero()));
  space.relieve(near);
  EXPECT_TRUE(space.isClear(near, Vector3::Zero()));
  EXPECT_FALSE(space.isClear(near, Vector3(1.95, 0.0, 0.0))) << "nearer";
  EXPECT_FALSE(space.isClear(near, Vector3(1.85, 2.0, 0.0))) << "along the wall for long";
}

}  // namespace
}  // namespace swarm_planner
