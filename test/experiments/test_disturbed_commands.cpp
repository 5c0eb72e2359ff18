// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Commands at any time to vehicles that are measured badly, late, and blown about: what holds for perfect ones
// (test/swarm/test_random_commands.cpp) has to hold in the air.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/experiments/cycle_planner.hpp"

namespace swarm_planner {
namespace {

/// Commands to some or all at random times until 20 s, then everybody is to fly.
class DisturbedOperator : public RunDirector {
 public:
  DisturbedOperator(const Mission& mission, IterativePlanner& planner, int seed)
      : mission_(mission), planner_(planner), random_(static_cast<unsigned>(seed)) {}

  void beforeCycle(double now, const std::vector<QuadSimulator>& vehicles, bool) override {
    farthest = 0.0;
    for (std::size_t uav = 0; uav < vehicles.size(); ++uav) {
      const Vector3& end = mission_.scenario.uavs[uav].reference.back();
      farthest = std::max(farthest, (vehicles[uav].state().p - end).norm());
    }
    if (now < 0.5) return;
    const bool is_over = now > 20.0;
    if (!is_over && draw(4) != 0) return;
    const FlightCommand command = kCommands[draw(4)];
    const bool everybody = draw(3) == 0;
    for (std::size_t uav = 0; uav < vehicles.size(); ++uav) {
      if (is_over) {
        planner_.command(uav, FlightCommand::kStart);
      } else if (everybody || draw(4) == 0) {
        EXPECT_TRUE(planner_.command(uav, command).accepted);
        ++given;
      }
    }
  }
  double obstacleTime(std::size_t, double t) const override { return t; }

  int given = 0;
  double farthest = 0.0;  ///< from its end, of all UAVs in the last cycle [m]

 private:
  static constexpr FlightCommand kCommands[] = {FlightCommand::kStart, FlightCommand::kHold, FlightCommand::kLand,
                                                FlightCommand::kStop};
  std::size_t draw(std::size_t count) { return random_() % count; }

  const Mission& mission_;
  IterativePlanner& planner_;
  std::mt19937 random_;
};

struct Flown {
  std::size_t collisions = 0;
  int given = 0;
  double farthest = 0.0;  ///< of a UAV from its end, when all is over [m]
};

/// A swap of ten with noise of 5 cm and 5 cm/s, gusts of 0.5 m/s and 0.1 s of latency.
Flown fly(int seed, bool avoidance) {
  Scenario scenario = circleSwap(10, 10.0, seed);
  scenario.end = {};
  scenario.end.duration = 50.0;
  const Mission mission = makeMission(scenario,
                                      {{"avoidance", avoidance},
                                       {"land_speed", 1.0},
                                       {"position_noise", 0.05},
                                       {"velocity_noise", 0.05},
                                       {"wind", 0.5},
                                       {"latency", 0.1}},
                                      "circle_swap");
  IterativePlanner planner(mission);
  DisturbedOperator someone(mission, planner, seed);
  ClosedLoopRun run(mission, planner, static_cast<std::uint64_t>(seed));
  run.setDirector(someone);
  const RunResult result = run.fly();
  return {result.flown.collisions.size(), someone.given, someone.farthest};
}

TEST(DisturbedCommands, MakeNobodyCollideAndAllFlyInTheEnd) {
  int given = 0;
  for (int seed = 0; seed < 3; ++seed) {
    const Flown flown = fly(seed, true);
    EXPECT_EQ(flown.collisions, 0u) << "seed " << seed;
    EXPECT_LT(flown.farthest, 0.5) << "seed " << seed;
    given += flown.given;
  }
  EXPECT_GT(given, 150);
}

TEST(DisturbedCommands, WithoutAvoidanceUavsCollide) { EXPECT_GT(fly(0, false).collisions, 0u); }

}  // namespace
}  // namespace swarm_planner
