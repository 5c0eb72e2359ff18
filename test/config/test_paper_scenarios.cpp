// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The figures of the paper's study compare with the paper only if the scenarios are the paper's: its starts, targets,
// obstacles and distributions, the same on every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "swarm_planner/config/paper_scenarios.hpp"

namespace swarm_planner {
namespace {

TEST(PaperSix, StartsAndTargetsAreThoseOfTableTwo) {
  const Scenario scenario = paperSix();
  const std::vector<Vector3> starts = {{0.0, 100.0, 20.0}, {0.0, 100.0, 40.0}, {0.0, 150.0, 20.0},
                                       {0.0, 150.0, 40.0}, {0.0, 200.0, 20.0}, {0.0, 200.0, 40.0}};
  ASSERT_EQ(scenario.uavs.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(scenario.uavs[i].name, "uav" + std::to_string(i + 1));
    EXPECT_EQ(scenario.uavs[i].start, starts[i]);
    const std::vector<Vector3> reference = {starts[i], starts[i] + Vector3(1000.0, 0.0, 0.0)};
    EXPECT_EQ(scenario.uavs[i].reference, reference);
    EXPECT_EQ(scenario.uavs[i].target.start, 20.0);
    EXPECT_EQ(scenario.uavs[i].target.speed, 3.0);
  }
  EXPECT_EQ(scenario.end.target_x, 300.0);
  for (const auto& [name, value] : std::map<std::string, double>{
           {"alpha", 0.5}, {"beta", 0.5}, {"eta", 0.1}, {"zeta", 0.2}, {"sampling_time", 0.3}, {"max_speed", 5.0}}) {
    EXPECT_EQ(scenario.overrides.at(name), value) << name;
  }
}

/// Horizontal and vertical offset of an obstacle's centre from a UAV's reference along x [m].
double offset(const ScenarioObstacle& obstacle, const ScenarioUav& uav) {
  return std::hypot(obstacle.center.y() - uav.start.y(), obstacle.center.z() - uav.start.z());
}

/// S of (7) on the reference, where it is smallest: beside the centre of an obstacle without yaw.
double leastSum(const ScenarioObstacle& obstacle, const ScenarioUav& uav) {
  const Vector3 u = (uav.start - obstacle.center).cwiseQuotient(obstacle.radii).cwiseAbs();
  return std::pow(u.y(), obstacle.exponents.y()) + std::pow(u.z(), obstacle.exponents.z());
}

TEST(PaperSix, SevenObstaclesStandAndTwoMoveAsInTheText) {
  const Scenario scenario = paperSix();
  std::vector<ScenarioObstacle> moving;
  std::copy_if(scenario.obstacles.begin(), scenario.obstacles.end(), std::back_inserter(moving),
               [](const ScenarioObstacle& obstacle) { return !obstacle.velocity.isZero(0.0); });
  EXPECT_EQ(scenario.obstacles.size(), 9u);
  ASSERT_EQ(moving.size(), 2u);
  EXPECT_EQ(moving[0].center.y(), 300.0);
  EXPECT_EQ(moving[0].center.z(), 20.0);
  EXPECT_EQ(moving[0].velocity, Vector3(0.0, -5.0, 0.0));
  EXPECT_EQ(moving[1].center.y(), 0.0);
  EXPECT_EQ(moving[1].center.z(), 20.0);
  EXPECT_EQ(moving[1].velocity, Vector3(0.0, 3.0, 0.0));
}

TEST(PaperSix, FiveOfSixReferencesAreBlockedByObstaclesBesideThem) {
  const Scenario scenario = paperSix();
  std::vector<std::string> blocked;
  for (const ScenarioUav& uav : scenario.uavs) {
    const auto blocks = [&uav](const ScenarioObstacle& obstacle) {
      return obstacle.velocity.isZero(0.0) && leastSum(obstacle, uav) < 1.0;
    };
    if (std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(), blocks)) blocked.push_back(uav.name);
    for (const ScenarioObstacle& obstacle : scenario.obstacles) {
      if (!blocks(obstacle)) continue;
      EXPECT_GE(offset(obstacle, uav), 2.0) << uav.name << ", obstacle " << obstacle.id;
      EXPECT_LE(offset(obstacle, uav), 6.0) << uav.name << ", obstacle " << obstacle.id;
    }
  }
  EXPECT_EQ(blocked, (std::vector<std::string>{"uav1", "uav2", "uav3", "uav5", "uav6"}));
}

TEST(PaperSix, MovingObstaclesMeetATargetOnItsWay) {
  const Scenario scenario = paperSix();
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    if (obstacle.velocity.isZero(0.0)) continue;
    double least = 1e9;
    for (const ScenarioUav& uav : scenario.uavs) {
      for (double t = 0.0; t < 90.0; t += 0.1) {
        const Vector3 target = uav.start + Vector3(20.0 + 3.0 * t, 0.0, 0.0);
        least =
            std::min(least, (target - obstacle.center - t * obstacle.velocity).cwiseQuotient(obstacle.radii).norm());
      }
    }
    EXPECT_LT(least, 1.0) << "obstacle " << obstacle.id;
  }
}

struct Grid {
  int uavs;
  Vector3 first, second, last;
};

class PaperScaling : public testing::TestWithParam<Grid> {};

TEST_P(PaperScaling, StartsStandInTheGridOfSectionFourTwo) {
  const Grid& grid = GetParam();
  const Scenario scenario = paperScaling(grid.uavs);
  ASSERT_EQ(scenario.uavs.size(), static_cast<std::size_t>(grid.uavs));
  EXPECT_EQ(scenario.name, "paper_" + std::to_string(grid.uavs));
  EXPECT_EQ(scenario.uavs.front().start, grid.first);
  EXPECT_EQ(scenario.uavs[scenario.uavs.size() > 1 ? 1 : 0].start, grid.second);
  EXPECT_EQ(scenario.uavs.back().start, grid.last);
  EXPECT_EQ(scenario.obstacles.size(), paperSix().obstacles.size());
}

INSTANTIATE_TEST_SUITE_P(Sizes, PaperScaling,
                         testing::Values(Grid{1, {0, 20, 20}, {0, 20, 20}, {0, 20, 20}},
                                         Grid{6, {0, 100, 20}, {0, 100, 40}, {0, 200, 40}},
                                         Grid{16, {0, 30, 30}, {0, 60, 30}, {0, 120, 120}},
                                         Grid{32, {0, 20, 20}, {0, 40, 20}, {0, 160, 80}},
                                         Grid{64, {0, 20, 20}, {0, 40, 20}, {0, 160, 160}},
                                         Grid{100, {0, 20, 20}, {0, 40, 20}, {0, 200, 200}},
                                         Grid{1000, {0, 20, 20}, {0, 40, 20}, {0, 8 * 20, 32 * 20}}));

TEST(PaperMonteCarlo, EveryDrawLiesInTheRangesOfSectionFourOneAndReachesTheirEnds) {
  constexpr int kScenarios = 400;
  double most_speed = 0.0, least_speed = 1e9;
  std::size_t most = 0, least = 100;
  Vector3 low = Vector3::Constant(1e9), high = -low;
  for (int seed = 0; seed < kScenarios; ++seed) {
    const Scenario scenario = paperMonteCarlo(6, static_cast<std::uint64_t>(seed));
    EXPECT_EQ(scenario.end.target_x, 800.0);
    std::size_t stationary = 0;
    for (const ScenarioObstacle& obstacle : scenario.obstacles) {
      low = low.cwiseMin(obstacle.center);
      high = high.cwiseMax(obstacle.center);
      EXPECT_TRUE((obstacle.radii.array() >= 20.0).all() && (obstacle.radii.array() <= 50.0).all());
      EXPECT_TRUE((obstacle.exponents.array() >= 2.0).all() && (obstacle.exponents.array() <= 10.0).all());
      if (obstacle.velocity.isZero(0.0)) {
        ++stationary;
        continue;
      }
      most_speed = std::max(most_speed, obstacle.velocity.norm());
      least_speed = std::min(least_speed, obstacle.velocity.norm());
    }
    const std::size_t moving = scenario.obstacles.size() - stationary;
    EXPECT_TRUE(stationary >= 1 && stationary <= 10 && moving >= 1 && moving <= 10) << "seed " << seed;
    most = std::max(most, scenario.obstacles.size());
    least = std::min(least, scenario.obstacles.size());
  }
  // Some 2000 moving and as many standing obstacles: a draw within 2 % of each end is all but certain.
  EXPECT_TRUE(low.x() >= 100.0 && low.x() < 114.0 && high.x() <= 800.0 && high.x() > 786.0) << low.x() << high.x();
  EXPECT_TRUE(low.y() >= -300.0 && low.y() < -288.0 && high.y() <= 300.0 && high.y() > 288.0) << low.y() << high.y();
  EXPECT_TRUE(low.z() >= 0.0 && low.z() < 8.0 && high.z() <= 400.0 && high.z() > 392.0) << low.z() << high.z();
  EXPECT_TRUE(least_speed >= 0.499999 && least_speed < 0.6) << least_speed;
  EXPECT_TRUE(most_speed <= 5.550001 && most_speed > 5.45) << most_speed;
  EXPECT_EQ(least, 2u);
  EXPECT_EQ(most, 20u);
}

TEST(PaperMonteCarlo, SeedAloneDecides) {
  EXPECT_EQ(toYaml(paperMonteCarlo(6, 3)), toYaml(paperMonteCarlo(6, 3)));
  EXPECT_NE(toYaml(paperMonteCarlo(6, 3)), toYaml(paperMonteCarlo(6, 4)));
  // Recorded once: another platform or library that draws otherwise would fly other scenarios under the same seed.
  const Scenario scenario = paperMonteCarlo(6, 3);
  EXPECT_EQ(scenario.obstacles.front().center, Vector3(513.16889, -92.178654, 223.918255));
  EXPECT_EQ(scenario.obstacles.back().velocity, Vector3(3.377793, 1.561556, 0.243432));
  EXPECT_EQ(scenario.obstacles.size(), 16u);
}

TEST(Crossing, AllTargetsAreAtOnePointAtOneTime) {
  const Scenario scenario = crossing();
  int vertical = 0;
  for (const ScenarioUav& uav : scenario.uavs) {
    ASSERT_EQ(uav.reference.size(), 2u);
    EXPECT_EQ(0.5 * (uav.reference[0] + uav.reference[1]), Vector3(0.0, 0.0, 60.0)) << uav.name;
    EXPECT_DOUBLE_EQ((uav.reference[1] - uav.reference[0]).norm(), 80.0) << uav.name;
    EXPECT_EQ(uav.start, uav.reference[0]);
    EXPECT_EQ(uav.target.start, 0.0);
    EXPECT_EQ(uav.target.speed, scenario.uavs.front().target.speed);
    vertical += uav.reference[0].head<2>() == uav.reference[1].head<2>();
  }
  EXPECT_EQ(vertical, 1);
  EXPECT_EQ(scenario.uavs.size(), 6u);
}

TEST(CircleSwap, SeedZeroIsExactlyAntipodal) {
  const Scenario scenario = circleSwap(10, 10.0, 0);
  for (const ScenarioUav& uav : scenario.uavs) {
    EXPECT_EQ(uav.reference.back().head<2>(), -uav.start.head<2>());
    EXPECT_NEAR(uav.start.head<2>().norm(), 10.0, 1e-6);
  }
  EXPECT_EQ(scenario.name, "circle_swap");
}

TEST(CircleSwap, OtherSeedsMoveEveryUavALittle) {
  const Scenario exact = circleSwap(10, 10.0, 0);
  const Scenario moved = circleSwap(10, 10.0, 9);
  for (std::size_t i = 0; i < exact.uavs.size(); ++i) {
    for (const Vector3& shift : {Vector3(moved.uavs[i].start - exact.uavs[i].start),
                                 Vector3(moved.uavs[i].reference.back() - exact.uavs[i].reference.back())}) {
      EXPECT_GT(shift.norm(), 0.0);
      EXPECT_LE(shift.lpNorm<Eigen::Infinity>(), 0.1 + 1e-9);
    }
    EXPECT_EQ(moved.uavs[i].start, moved.uavs[i].reference.front());
  }
}

TEST(Generators, RefuseNonsense) {
  EXPECT_THROW(paperScaling(0), std::invalid_argument);
  EXPECT_THROW(paperMonteCarlo(-1, 0), std::invalid_argument);
  EXPECT_THROW(circleSwap(0, 10.0, 0), std::invalid_argument);
  EXPECT_THROW(circleSwap(3, 0.0, 0), std::invalid_argument);
  EXPECT_THROW(circleSwap(3, std::nan(""), 0), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
