// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Figures from tight places compare only if the places are what they are said to be: the same on every machine, with a
// way through, and as tight as told.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

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

TEST_P(TightScenario, IsAValidMissionForEverySeed) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    EXPECT_NO_THROW(makeMission(GetParam().make(seed), {}, GetParam().name)) << "seed " << seed;
  }
}

TEST_P(TightScenario, EveryGoalCanBeHeld) {
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
                    Family{"dens_64", [](std::uint64_t seed) { return denseRoom(64, seed); }},
                    Family{"swapj_6", [](std::uint64_t seed) { return swapInRoom(6, seed); }},
                    Family{"swapj_64", [](std::uint64_t seed) { return swapInRoom(64, seed); }}),
    [](const auto& family) { return family.param.name; });

TEST(Generators, RefuseNonsense) {
  EXPECT_THROW(forest(0, kForestGap, 0), std::invalid_argument);
  EXPECT_THROW(forest(10, -1.0, 0), std::invalid_argument);
  EXPECT_THROW(forest(10, std::nan(""), 0), std::invalid_argument);
  EXPECT_THROW(smallForest(0, 0), std::invalid_argument);
  EXPECT_THROW(gap(0, 0.1, 0), std::invalid_argument);
  EXPECT_THROW(boxHeadOn(4, -0.1, 0), std::invalid_argument);
  EXPECT_THROW(uTrap(0, 0.1, 0), std::invalid_argument);
  EXPECT_THROW(sameGoal(3, std::nan(""), 0), std::invalid_argument);
  EXPECT_THROW(denseRoom(0, 0), std::invalid_argument);
  EXPECT_THROW(swapInRoom(0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
