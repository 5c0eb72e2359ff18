// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The safety campaign counts collisions: a scenario in which one cannot be avoided, or none can happen, spoils it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {
namespace {

constexpr int kScenarios = 300;
constexpr double kRounding = 2e-6;

template <class Judge>
void forEachScenario(const Judge& judge) {
  for (int seed = 0; seed < kScenarios; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    judge(movingObstacles(6, 8, static_cast<std::uint64_t>(seed)));
  }
}

/// The smallest and the largest value seen.
struct Extremes {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;

  void see(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  /// Whether all lie in [low, high] and come close to both ends.
  void expectFill(double low, double high, const char* what) const {
    const double close = 0.03 * (high - low);
    EXPECT_TRUE(least >= low - kRounding && least < low + close) << what << ": from " << least;
    EXPECT_TRUE(most <= high + kRounding && most > high - close) << what << ": to " << most;
  }
};

TEST(MovingObstacles, StartsAndGoalsFillTheFieldAndLieApart) {
  Extremes x, y, z, way;
  forEachScenario([&](const Scenario& scenario) {
    ASSERT_EQ(scenario.uavs.size(), 6U);
    for (const ScenarioUav& uav : scenario.uavs) {
      ASSERT_EQ(uav.reference.size(), 2U);
      EXPECT_EQ(uav.reference.front(), uav.start);
      for (const Vector3& point : uav.reference) {
        x.see(point.x());
        y.see(point.y());
        z.see(point.z());
      }
      way.see((uav.reference.back() - uav.start).norm());
      for (const ScenarioUav& other : scenario.uavs) {
        if (other.name == uav.name) continue;
        EXPECT_GE((other.start - uav.start).norm(), 3.0);
        EXPECT_GE((other.reference.back() - uav.reference.back()).norm(), 3.0);
      }
    }
  });
  x.expectFill(0.0, 30.0, "x");
  y.expectFill(0.0, 30.0, "y");
  z.expectFill(3.0, 13.0, "z");
  EXPECT_GE(way.least, 15.0);
}

TEST(MovingObstacles, AreOfAllShapesAndSlowerThanUavs) {
  Extremes radius, exponent, speed, yaw;
  forEachScenario([&](const Scenario& scenario) {
    ASSERT_EQ(scenario.obstacles.size(), 8U);
    for (const ScenarioObstacle& obstacle : scenario.obstacles) {
      for (int axis = 0; axis < 3; ++axis) {
        radius.see(obstacle.radii[axis]);
        exponent.see(obstacle.exponents[axis]);
      }
      yaw.see(obstacle.yaw);
      speed.see(obstacle.velocity.norm());
    }
  });
  radius.expectFill(0.5, 2.0, "radius");
  exponent.expectFill(2.0, 8.0, "exponent");
  yaw.expectFill(-3.1415927, 3.1415927, "yaw");
  speed.expectFill(0.3, 2.0, "speed");
}

Superellipsoid shapeOf(const ScenarioObstacle& obstacle) {
  return Superellipsoid(obstacle.id, obstacle.center, obstacle.radii, obstacle.exponents, obstacle.yaw,
                        obstacle.velocity);
}

TEST(MovingObstacles, ComeNearNoStartInTheFirstSeconds) {
  forEachScenario([](const Scenario& scenario) {
    for (const ScenarioObstacle& obstacle : scenario.obstacles) {
      for (double t = 0.0; t < 4.0; t += 0.25) {
        const Superellipsoid shape = shapeOf(obstacle).movedBy(t);
        for (const ScenarioUav& uav : scenario.uavs) EXPECT_GT(shape.signedDistance(uav.start), 3.0 - kRounding);
      }
    }
  });
}

// Else they would be scenery.
TEST(MovingObstacles, CrossTheWaysOfMostSwarms) {
  int crossed = 0;
  forEachScenario([&crossed](const Scenario& scenario) {
    bool meets = false;
    for (const ScenarioUav& uav : scenario.uavs) {
      const Vector3 way = uav.reference.back() - uav.start;
      for (double t = 0.0; t < 60.0; t += 0.25) {
        const Vector3 target = uav.start + std::min(1.0, uav.target.speed * t / way.norm()) * way;
        for (const ScenarioObstacle& obstacle : scenario.obstacles) {
          meets = meets || shapeOf(obstacle).movedBy(t).signedDistance(target) < 0.3;
        }
      }
    }
    crossed += meets ? 1 : 0;
  });
  EXPECT_GT(crossed, kScenarios / 2);
}

TEST(MovingObstacles, SeedAloneDecides) {
  EXPECT_EQ(toYaml(movingObstacles(6, 8, 2)), toYaml(movingObstacles(6, 8, 2)));
  EXPECT_NE(toYaml(movingObstacles(6, 8, 2)), toYaml(movingObstacles(6, 8, 3)));
  // Recorded once: another platform or library that draws otherwise would fly other scenarios under the same seed.
  const Scenario scenario = movingObstacles(6, 8, 2);
  EXPECT_EQ(scenario.uavs.front().start, Vector3(27.108121, 25.507084, 10.838205));
  EXPECT_EQ(scenario.obstacles.front().center, Vector3(14.486653, 24.106906, 7.938933));
}

TEST(MovingObstacles, MoreUavsGetALargerField) {
  const Scenario scenario = movingObstacles(54, 20, 1);
  EXPECT_EQ(scenario.uavs.size(), 54U);
  EXPECT_EQ(scenario.obstacles.size(), 20U);
  Extremes x;
  for (const ScenarioUav& uav : scenario.uavs) x.see(uav.start.x());
  EXPECT_GT(x.most, 60.0);
  EXPECT_LE(x.most, 90.0);
}

TEST(MovingObstacles, RefuseNonsense) {
  EXPECT_THROW(movingObstacles(0, 8, 0), std::invalid_argument);
  EXPECT_THROW(movingObstacles(6, 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
