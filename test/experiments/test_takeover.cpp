// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A planner that dies in flight is replaced after a random time. Nobody may collide, setpoints may not jump, and
// everybody has to arrive.
#include <gtest/gtest.h>

#include <cmath>

#include "replaced_planner.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"

namespace swarm_planner {
namespace {

struct Flown {
  int collisions = 0;
  int not_arrived = 0;
  int never_back = 0;    ///< not all UAVs were planned for again
  double slowest = 0.0;  ///< from the new planner's first cycle until it planned for all [s]
  double jump_p = 0.0, jump_v = 0.0, jump_a = 0.0;
};

/// Uniform in [0, 1): the same on every machine.
double chance(std::uint64_t& state) {
  state = state * 6364136223846793005 + 1442695040888963407;
  return static_cast<double>(state >> 11) * 0x1p-53;
}

Replacement randomly(double latest_death, std::uint64_t seed) {
  std::uint64_t state = 2 * seed + 1;
  for (int i = 0; i < 8; ++i) chance(state);
  Replacement replacement;
  replacement.death = 1.0 + latest_death * chance(state);
  replacement.gap = 0.5 + 9.5 * std::pow(chance(state), 2);
  replacement.newest_unsent = chance(state) < 0.3;
  replacement.blind = chance(state) < 0.5 ? 1.0 : 0.0;
  return replacement;
}

void fly(const Scenario& scenario, const ParameterMap& given, const Replacement& replacement, std::uint64_t seed,
         Flown& total) {
  const Mission mission = makeMission(scenario, given, scenario.name);
  ReplacedPlanner planner(mission, replacement);
  JumpWatch jumps(scenario.uavs.size());
  jumps.lookAt(replacement.death, replacement.death + replacement.gap + 4.0);
  const RunResult result = ClosedLoopRun(mission, planner, seed).fly({&jumps});
  total.collisions += static_cast<int>(result.flown.collisions.size());
  total.not_arrived += static_cast<int>(scenario.uavs.size()) - result.flown.arrived_uavs;
  const double patience = 5.0;
  if (planner.replaced() && !planner.returned() && result.flown.mission_time > *planner.replaced() + patience) {
    ++total.never_back;
  }
  if (planner.returned()) total.slowest = std::max(total.slowest, *planner.returned() - *planner.replaced());
  total.jump_p = std::max(total.jump_p, jumps.p());
  total.jump_v = std::max(total.jump_v, jumps.v());
  total.jump_a = std::max(total.jump_a, jumps.a());
}

constexpr std::uint64_t kSeeds = 12;

/// `noise`: of odometry [m, m/s]; messages are late then, too.
Flown flySwaps(bool memory, double noise) {
  Flown total;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Replacement replacement = randomly(5.0, seed);
    replacement.memory = memory;
    fly(circleSwap(10, 10.0, seed),
        {{"position_noise", noise}, {"velocity_noise", noise}, {"latency", noise > 0.0 ? 0.1 : 0.0}}, replacement, seed,
        total);
  }
  return total;
}

Flown flyAmongObstacles(bool memory, double noise) {
  Flown total;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Replacement replacement = randomly(12.0, seed);
    replacement.memory = memory;
    fly(movingObstacles(6, 8, seed),
        {{"position_noise", noise}, {"velocity_noise", noise}, {"latency", noise > 0.0 ? 0.1 : 0.0}}, replacement, seed,
        total);
  }
  return total;
}

TEST(Takeover, FromARecordIsNotToBeSeenInTheSetpoints) {
  for (const Flown& flown : {flySwaps(true, 0.0), flyAmongObstacles(true, 0.0)}) {
    EXPECT_EQ(flown.collisions, 0);
    EXPECT_EQ(flown.not_arrived, 0);
    EXPECT_EQ(flown.never_back, 0);
    EXPECT_LT(flown.jump_p, 0.03) << "tracking_error";
    EXPECT_LT(flown.jump_v, 0.1);
    EXPECT_LT(flown.jump_a, 0.5) << "10 ms of the jerk that plans have";
  }
}

TEST(Takeover, FromARecordWithNoisyOdometryIsSafe) {
  for (const Flown& flown : {flySwaps(true, 0.05), flyAmongObstacles(true, 0.05)}) {
    EXPECT_EQ(flown.collisions, 0);
    EXPECT_EQ(flown.not_arrived, 0);
    EXPECT_EQ(flown.never_back, 0);
  }
}

// Without a record the acceleration comes from three measurements.
TEST(Takeover, FromOdometryAloneIsSafe) {
  for (const double noise : {0.0, 0.05}) {
    for (const Flown& flown : {flySwaps(false, noise), flyAmongObstacles(false, noise)}) {
      EXPECT_EQ(flown.collisions, 0);
      EXPECT_EQ(flown.not_arrived, 0);
      EXPECT_EQ(flown.never_back, 0);
      EXPECT_LT(flown.jump_p, noise > 0.0 ? 0.4 : 0.15);
    }
  }
}

}  // namespace
}  // namespace swarm_planner
