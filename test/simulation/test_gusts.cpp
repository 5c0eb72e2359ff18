// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, --wind does not blow as strongly, or as steadily, as it says.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "swarm_planner/simulation/gusts.hpp"

namespace swarm_planner {
namespace {

constexpr double kSigma = 1.5;
constexpr double kTime = 2.0;

TEST(Gusts, HaveTheStatedVarianceAndCorrelationTime) {
  constexpr double kStep = 0.1;
  constexpr int kLag = 20;  // steps in kTime
  constexpr int kCount = 200000;
  Gusts gusts(kSigma, kTime, 1);
  std::vector<Vector3> wind;
  for (int i = 0; i < kCount; ++i) wind.push_back(gusts.at(kStep * i));
  // So many independent values have the same deviation of mean and variance: 2 T of correlated time each.
  const double independent = kCount * kStep / (2.0 * kTime);
  for (int axis = 0; axis < 3; ++axis) {
    double mean = 0.0, square = 0.0, lagged = 0.0, crossed = 0.0;
    for (std::size_t i = kLag; i < wind.size(); ++i) {
      mean += wind[i](axis) / kCount;
      square += wind[i](axis) * wind[i](axis) / kCount;
      lagged += wind[i](axis) * wind[i - kLag](axis) / kCount;
      crossed += wind[i](axis) * wind[i]((axis + 1) % 3) / kCount;
    }
    EXPECT_NEAR(mean, 0.0, 4.0 * kSigma / std::sqrt(independent));
    EXPECT_NEAR(square / (kSigma * kSigma), 1.0, 4.0 * std::sqrt(2.0 / independent));
    EXPECT_NEAR(lagged / (kSigma * kSigma), std::exp(-1.0), 4.0 * std::sqrt(2.0 / independent));
    EXPECT_NEAR(crossed / (kSigma * kSigma), 0.0, 4.0 / std::sqrt(independent));
  }
}

TEST(Gusts, BlowFromTheFirstInstantOnWithFullStrength) {
  double square = 0.0;
  constexpr int kCount = 5000;
  for (int seed = 0; seed < kCount; ++seed) {
    square += Gusts(kSigma, kTime, static_cast<std::uint64_t>(seed)).at(0.0).squaredNorm() / (3.0 * kCount);
  }
  EXPECT_NEAR(square / (kSigma * kSigma), 1.0, 4.0 * std::sqrt(2.0 / (3.0 * kCount)));
}

TEST(Gusts, AreAFunctionOfTimeHoweverOftenTheyAreAskedFor) {
  Gusts coarse(kSigma, kTime, 3), fine(kSigma, kTime, 3), other(kSigma, kTime, 4);
  Vector3 last = fine.at(0.0);
  double most = 0.0;
  for (int i = 0; i <= 10000; ++i) {
    const double t = 0.001 * i;
    const Vector3 wind = fine.at(t);
    most = std::max(most, (wind - last).norm());
    last = wind;
    if (i % 137 != 0) continue;
    EXPECT_EQ(coarse.at(t), wind);
    EXPECT_NE(other.at(t), wind);
  }
  EXPECT_LT(most, 0.1 * kSigma);  // no jumps
}

TEST(Gusts, GoOnWhenTheClockIsSet) {
  Gusts gusts(kSigma, kTime, 3), undisturbed(kSigma, kTime, 3);
  gusts.resetClock(1.7e9);
  gusts.resetClock(-0.3);
  for (double t = 0.0; t < 5.0; t += 0.05) EXPECT_LT((gusts.at(t - 0.3) - undisturbed.at(t)).norm(), 1e-9);
}

TEST(Gusts, ZeroIsCalm) {
  Gusts gusts(0.0, kTime, 3);
  EXPECT_EQ(gusts.at(0.0), Vector3::Zero());
  EXPECT_EQ(gusts.at(1e9), Vector3::Zero());
}

}  // namespace
}  // namespace swarm_planner
