// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a seed no longer stands for the same run everywhere, or the noise is not what its parameters say.
#include <gtest/gtest.h>

#include <cmath>

#include "swarm_planner/simulation/gaussian_noise.hpp"

namespace swarm_planner {
namespace {

TEST(GaussianNoise, ASeedGivesTheSameNumbersOnEveryPlatform) {
  // From an implementation of the same two methods in another language.
  GaussianNoise noise(42);
  for (const double expected : {0.981398390072499, -0.565720104673956, 1.34032564275202, 0.402312870299261,
                                -0.964220506294138, 0.270550864458253}) {
    EXPECT_NEAR(noise.next(), expected, 1e-13);
  }
}

TEST(GaussianNoise, HasTheMomentsOfTheNormalDistribution) {
  GaussianNoise noise(1);
  constexpr int kCount = 200000;
  double mean = 0.0, square = 0.0, fourth = 0.0, successive = 0.0, last = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = noise.next();
    mean += x / kCount;
    square += x * x / kCount;
    fourth += x * x * x * x / kCount;
    successive += x * last / kCount;
    beyond_two += std::abs(x) > 2.0 ? 1 : 0;
    last = x;
  }
  const double deviation = 4.0 / std::sqrt(kCount);  // four standard deviations of a mean of unit variance
  EXPECT_NEAR(mean, 0.0, deviation);
  EXPECT_NEAR(square, 1.0, std::sqrt(2.0) * deviation);
  EXPECT_NEAR(fourth, 3.0, std::sqrt(96.0) * deviation);
  EXPECT_NEAR(successive, 0.0, deviation);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, std::erfc(std::sqrt(2.0)), 0.21 * deviation);
}

TEST(GaussianNoise, NeighbouringSeedsAreIndependent) {
  GaussianNoise first(7), second(8);
  constexpr int kCount = 100000;
  double product = 0.0;
  for (int i = 0; i < kCount; ++i) product += first.next() * second.next() / kCount;
  EXPECT_NEAR(product, 0.0, 4.0 / std::sqrt(kCount));
}

}  // namespace
}  // namespace swarm_planner
