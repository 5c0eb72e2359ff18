// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Figures from tight places compare only if the places are what they are said to be: the same on every machine, with a
// way through, and as tight as told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/config/tight_scenarios.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {
namespace {

struct Family {
  const char* name;
  std::function<Scenario(std::uint64_t)> make;
};

class TightScenario : public testing::TestWithParam<Family> {};

TEST_P(TightScenario, SeedAloneDecides) {
  const auto& make = GetParam().make;
  EXPECT_EQ(toYaml(make(3)), toYaml(make(3)));
  Scenario other = make(4);
  other.name = make(3).name;
  EXPECT_NE(toYaml(make(3)), toYaml(other));
  EXPECT_EQ(make(3).name, GetParam().name + std::string("_3"));
}

/// makeMission throws for what a scenario file would be refused for.
TEST_P(TightScenario, IsAValidMissionWithGoalsThatCanBeHeldForEverySeed) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Mission mission = makeMission(GetParam().make(seed), {}, GetParam().name);
    const LimitParameters& limits = mission.parameters.limits;
    for (const ScenarioUav& uav : mission.scenario.uavs) {
      const Vector3& goal = uav.reference.back();
      EXPECT_EQ(uav.reference.front(), uav.start);
      if (const auto& box = mission.scenario.workspace) {
        EXPECT_TRUE((goal.array() > box->min.array()).all() && (goal.array() < box->max.array()).all()) << seed;
      }
      for (const ScenarioObstacle& obstacle : mission.scenario.obstacles) {
        EXPECT_GT(makeObstacle(obstacle).signedDistance(goal), limits.uav_radius + limits.tracking_margin) << seed;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Families, TightScenario,
    testing::Values(Family{"circle_swap", [](std::uint64_t seed) { return circleSwap(40, 20.0, seed); }},
                    Family{"forest", [](std::uint64_t seed) { return forest(10, kForestGap, seed); }},
                    Family{"small_forest", [](std::uint64_t seed) { return smallForest(20, seed); }},
                    Family{"gap", [](std::uint64_t seed) { return gap(8, kPerturbation, seed); }},
                    Family{"box_head_on", [](std::uint64_t seed) { return boxHeadOn(4, kPerturbation, seed); }},
                    Family{"u_trap", [](std::uint64_t seed) { return uTrap(3, kPerturbation, seed); }},
                    Family{"same_goal", [](std::uint64_t seed) { return sameGoal(6, kPerturbation, seed); }},
                    Family{"dens_16", [](std::uint64_t seed) { return denseRoom(16, seed); }},
                    Family{"swapj_16", [](std::uint64_t seed) { return swapInRoom(16, seed); }}),
    [](const auto& family) { return family.param.name; });

/// Seen from above: whether a disc of `radius` [m] gets from `start` to each goal among upright obstacles, found by
/// filling a grid of 5 cm.
class FloodFill {
 public:
  FloodFill(const Scenario& scenario, double radius, const Vector3& start)
      : box_(*scenario.workspace), radius_(radius), height_(start.z()) {
    for (const ScenarioObstacle& obstacle : scenario.obstacles) obstacles_.push_back(makeObstacle(obstacle));
    columns_ = static_cast<int>((box_.max.x() - box_.min.x()) / kCell);
    rows_ = static_cast<int>((box_.max.y() - box_.min.y()) / kCell);
    reached_.assign(static_cast<std::size_t>(columns_ * rows_), false);
    std::vector<std::pair<int, int>> open = {cellOf(start)};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (i < 0 || j < 0 || i >= columns_ || j >= rows_ || reached_[index(i, j)] || !isFree(i, j)) continue;
      reached_[index(i, j)] = true;
      for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) open.push_back({i + di, j + dj});
    }
  }

  bool reaches(const Vector3& p) const { return reached_[index(cellOf(p).first, cellOf(p).second)]; }

 private:
  static constexpr double kCell = 0.05;

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j * columns_ + i); }
  std::pair<int, int> cellOf(const Vector3& p) const {
    return {static_cast<int>((p.x() - box_.min.x()) / kCell), static_cast<int>((p.y() - box_.min.y()) / kCell)};
  }
  bool isFree(int i, int j) const {
    const Vector3 p(box_.min.x() + kCell * (i + 0.5), box_.min.y() + kCell * (j + 0.5), height_);
    return std::all_of(obstacles_.begin(), obstacles_.end(), [&](const Superellipsoid& obstacle) {
      return obstacle.distanceLowerBound(p) >= radius_ || obstacle.signedDistance(p) >= radius_;
    });
  }

  Workspace box_;
  std::vector<Superellipsoid> obstacles_;
  double radius_, height_;
  int columns_ = 0, rows_ = 0;
  std::vector<bool> reached_;
};

void expectWays(const Scenario& scenario) {
  const LimitParameters limits = makeMission(scenario, {}, scenario.name).parameters.limits;
  const FloodFill fill(scenario, limits.uav_radius + limits.tracking_margin, scenario.uavs.front().start);
  for (const ScenarioUav& uav : scenario.uavs) {
    EXPECT_TRUE(fill.reaches(uav.start) && fill.reaches(uav.reference.back())) << scenario.name << ", " << uav.name;
  }
}

TEST(Forest, AWayExistsForEveryUav) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    expectWays(forest(10, kForestGap, seed));
    expectWays(forest(10, 0.0, seed));
    expectWays(smallForest(20, seed));
  }
  Scenario walled = smallForest(1, 0);
  ScenarioObstacle wall = walled.obstacles.front();
  wall.radii = Vector3(0.3, 20.0, 6.0);
  walled.obstacles = {wall};
  EXPECT_FALSE(FloodFill(walled, 0.15, walled.uavs[0].start).reaches(walled.uavs[0].reference.back()));
}

/// The narrowest gap between two trees that leave one [m].
double narrowestGap(const Scenario& scenario) {
  double least = 1e9;
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const ScenarioObstacle &a = scenario.obstacles[i], &b = scenario.obstacles[j];
      const double gap = (a.center - b.center).norm() - a.radii.x() - b.radii.x();
      if (gap > 0.0) least = std::min(least, gap);
    }
  }
  return least;
}

TEST(Forest, GapsAreWideEnoughForAUavOrThereIsNone) {
  int touching = 0;
  const LimitParameters limits = makeMission(forest(10, kForestGap, 0), {}, "forest").parameters.limits;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Scenario scenario = forest(10, kForestGap, seed);
    ASSERT_EQ(scenario.obstacles.size(), 90u);
    EXPECT_GE(narrowestGap(scenario), 2.0 * (limits.uav_radius + limits.tracking_margin)) << seed;
    EXPECT_GE(narrowestGap(smallForest(20, seed)), 0.5 - 1e-9) << seed;
    for (const ScenarioObstacle& tree : scenario.obstacles) {
      EXPECT_LE(tree.center.head<2>().lpNorm<Eigen::Infinity>(), 15.0);
      touching += std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(), [&](const auto& other) {
        const double between = (other.center - tree.center).norm() - other.radii.x() - tree.radii.x();
        return other.id != tree.id && between <= 0.0;
      });
    }
  }
  EXPECT_GT(touching, 100) << "some trees stand in each other: dead ends";
  EXPECT_LT(narrowestGap(forest(10, 0.0, 0)), 0.6) << "without the rule some gaps are too narrow";
}

/// The least clearance of the straight line between two points from all obstacles [m].
double clearanceOnWay(const Scenario& scenario, const Vector3& from, const Vector3& to) {
  double least = 1e9;
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    const Superellipsoid shape = makeObstacle(obstacle);
    for (double t = 0.0; t <= 1.0; t += 0.002) least = std::min(least, shape.signedDistance(from + t * (to - from)));
  }
  return least;
}

TEST(Gap, HasRoomForOneAndNotForTwo) {
  const Scenario scenario = gap(8, kPerturbation, 0);
  const LimitParameters limits = makeMission(scenario, {}, "gap").parameters.limits;
  const Vector3 middle(0.0, 0.0, 3.5), along(3.0, 0.0, 0.0);
  const double room = clearanceOnWay(scenario, middle - along, middle + along) - limits.uav_radius;
  EXPECT_GT(room, limits.tracking_margin);
  // Two in the opening at a time are no farther apart than its corners.
  EXPECT_LT(2.0 * room * std::sqrt(2.0), limits.pair_distance);
  for (const ScenarioUav& uav : scenario.uavs) {
    EXPECT_LT(clearanceOnWay(scenario, uav.start, uav.reference.back()), 0.0) << uav.name << " is to meet the wall";
  }
  // Nothing but the opening: everywhere else there is wall.
  const Workspace& box = *scenario.workspace;
  for (double y = box.min.y(); y <= box.max.y(); y += 0.1) {
    for (double z = box.min.z(); z <= box.max.z(); z += 0.1) {
      if (std::max(std::abs(y), std::abs(z - 3.5)) < 0.75) continue;  // the opening and its rounded edges
      EXPECT_TRUE(
          std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(),
                      [&](const auto& slab) { return makeObstacle(slab).sum(Vector3(0.0, y, z) - slab.center) < 1.0; }))
          << y << " " << z;
    }
  }
}

TEST(BoxHeadOn, EveryUavMeetsAFaceThatGivesNoSide) {
  const Scenario scenario = boxHeadOn(4, kPerturbation, 0);
  ASSERT_EQ(scenario.obstacles.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Superellipsoid box = makeObstacle(scenario.obstacles[i]);
    EXPECT_GE(box.exponents().minCoeff(), 8.0);
    const Vector3 met(-box.radii().x() - 1.0, scenario.uavs[i].start.y(), scenario.uavs[i].start.z());
    const Vector3 gradient = box.gauge(met - box.center()).gradient;
    EXPECT_LT(gradient.tail<2>().norm(), 1e-9 * gradient.norm());
  }
}

TEST(UTrap, ReferencesLeadIntoTheDeadEndAndAWayLeadsRound) {
  const Scenario scenario = uTrap(3, kPerturbation, 0);
  expectWays(scenario);
  for (const ScenarioUav& uav : scenario.uavs) {
    EXPECT_LT(clearanceOnWay(scenario, uav.start, uav.reference.back()), 0.0);
    EXPECT_GT(clearanceOnWay(scenario, uav.start, uav.start + Vector3(19.0, 0.0, 0.0)), 0.3) << "free into the trap";
  }
  Scenario low = scenario;
  low.workspace->max.y() = 7.0;
  low.workspace->min.y() = -7.0;
  EXPECT_FALSE(FloodFill(low, 0.3, low.uavs[0].start).reaches(low.uavs[0].reference.back())) << "only the way round";
}

TEST(SameGoal, AllAreSentToOnePoint) {
  for (const std::uint64_t seed : {0u, 5u}) {
    const Scenario scenario = sameGoal(6, kPerturbation, seed);
    for (const ScenarioUav& uav : scenario.uavs) {
      EXPECT_EQ(uav.reference.back(), Vector3(0.0, 0.0, 10.0));
      EXPECT_EQ(uav.reference.front(), uav.start);
    }
  }
}

class Rooms : public testing::TestWithParam<int> {};

TEST_P(Rooms, HaveTheSameSpaceForEachUav) {
  const int uavs = GetParam();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Scenario room = denseRoom(uavs, seed);
    const Vector3 size = room.workspace->max - room.workspace->min;
    EXPECT_NEAR(size.x() * size.y(), 1.6 * uavs, 0.01 * uavs);
    EXPECT_EQ(room.obstacles.size(), static_cast<std::size_t>(std::lround(1.6 * uavs)));
    EXPECT_NO_THROW(makeMission(room, {}, room.name));
    const Scenario swap = swapInRoom(uavs, seed);
    EXPECT_NO_THROW(makeMission(swap, {}, swap.name));
    const double radius = std::sqrt(1.6 * uavs / M_PI);
    for (const ScenarioUav& uav : swap.uavs) {
      EXPECT_NEAR(uav.start.head<2>().norm(), radius, 0.12 * std::sqrt(2.0) + 1e-6);
      EXPECT_LT((uav.start + uav.reference.back()).head<2>().lpNorm<Eigen::Infinity>(), 0.2401) << "opposite";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Rooms, testing::Values(6, 12, 16, 32, 64));

TEST(CircleSwapSeeds, ThePerturbationIsAsLargeAsTold) {
  double most = 0.0;
  const Scenario exact = circleSwap(10, 10.0, 0), moved = circleSwap(10, 10.0, 3, 0.5);
  for (std::size_t i = 0; i < exact.uavs.size(); ++i) {
    most = std::max(most, (exact.uavs[i].start - moved.uavs[i].start).lpNorm<Eigen::Infinity>());
  }
  EXPECT_GT(most, 0.4);
  EXPECT_LE(most, 0.5 + 1e-9);
}

TEST(Generators, RefuseNonsense) {
  EXPECT_THROW(forest(0, kForestGap, 0), std::invalid_argument);
  EXPECT_THROW(forest(10, -1.0, 0), std::invalid_argument);
  EXPECT_THROW(forest(10, std::nan(""), 0), std::invalid_argument);
  EXPECT_THROW(smallForest(0, 0), std::invalid_argument);
  EXPECT_THROW(gap(0, 0.1, 0), std::invalid_argument);
  EXPECT_THROW(boxHeadOn(4, -0.1, 0), std::invalid_argument);
  EXPECT_THROW(uTrap(0, 0.1, 0), std::invalid_argument);
  EXPECT_THROW(sameGoal(3, std::nan(""), 0), std::invalid_argument);
  EXPECT_THROW(denseRoom(5, 0), std::invalid_argument);
  EXPECT_THROW(swapInRoom(0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
