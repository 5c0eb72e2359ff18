// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, disturbances that should be independent are the same numbers over again.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "swarm_planner/simulation/random_stream.hpp"

namespace swarm_planner {
namespace {

TEST(RandomStream, EveryRunUseAndUavHasASeedOfItsOwn) {
  std::set<std::uint64_t> seeds;
  std::size_t count = 0;
  for (std::uint64_t run = 0; run < 20; ++run) {
    for (auto use = RandomUse::kPositionNoise; use <= RandomUse::kFlightRecord;
         use = static_cast<RandomUse>(static_cast<std::uint64_t>(use) + 1)) {
      for (std::size_t uav = 0; uav < 200; ++uav, ++count) seeds.insert(streamSeed(run, use, uav));
    }
  }
  EXPECT_EQ(seeds.size(), count);
}

TEST(RandomStream, IsUniformAndIndependentOfItsNeighbours) {
  constexpr int kCount = 100000;
  RandomStream first(streamSeed(1, RandomUse::kDrop, 0)), second(streamSeed(1, RandomUse::kDrop, 1));
  double mean = 0.0, square = 0.0, product = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = first.nextUniform();
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
    mean += x / kCount;
    square += (x - 0.5) * (x - 0.5) / kCount;
    product += (x - 0.5) * (second.nextUniform() - 0.5) / kCount;
  }
  EXPECT_NEAR(mean, 0.5, 4.0 / std::sqrt(12.0 * kCount));
  EXPECT_NEAR(square, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0 / kCount));
  EXPECT_NEAR(product, 0.0, 4.0 / 12.0 / std::sqrt(kCount));
}

}  // namespace
}  // namespace swarm_planner
