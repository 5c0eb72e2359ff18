// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Any command to anybody at any time. If these fail, an operator can make UAVs collide, or leave one that never flies
// again.
#include <gtest/gtest.h>

#include <random>

#include "perfect_flight.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"

namespace swarm_planner {
namespace {

/// A swap of ten on a circle.
Mission swapOfTen(int seed, bool avoidance) {
  return makeMission(circleSwap(10, 10.0, seed), {{"avoidance", avoidance}, {"land_speed", 1.0}}, "circle_swap");
}

/// Commands to some or all, at random times.
class Operator {
 public:
  explicit Operator(int seed) : random_(static_cast<unsigned>(seed)) {}

  void act(SwarmPlanner& planner) {
    if (draw(4) != 0) return;
    const FlightCommand command = kFlightCommands[draw(kFlightCommands.size())];
    const bool everybody = draw(3) == 0;
    for (std::size_t uav = 0; uav < planner.uavCount(); ++uav) {
      if (!everybody && draw(4) != 0) continue;
      const FlightMode before = planner.mode(uav);
      const CommandAnswer answer = planner.command(uav, command);
      EXPECT_EQ(planner.mode(uav), answer.mode);
      EXPECT_TRUE(answer.accepted || before == FlightMode::kAbsent) << answer.text;
      ++given_;
    }
  }
  int given() const { return given_; }

 private:
  std::size_t draw(std::size_t count) { return random_() % count; }

  std::mt19937 random_;
  int given_ = 0;
};

// Those who have left fly their last motion to its end, as a driver would.
TEST(RandomCommands, MakeNobodyCollideAndAllFlyInTheEnd) {
  int given = 0;
  for (int seed = 0; seed < 30; ++seed) {
    PerfectFlight flight(swapOfTen(seed, true));
    Operator someone(seed);
    for (int cycle = 0; cycle < 120; ++cycle) {
      someone.act(flight.planner());
      flight.cycle();
    }
    given += someone.given();
    EXPECT_GE(flight.leastPairGauge(), 1.0) << "seed " << seed;
    for (std::size_t uav = 0; uav < 10; ++uav) {
      flight.planner().command(uav, FlightCommand::kJoin);
      EXPECT_TRUE(flight.planner().command(uav, FlightCommand::kStart).accepted);
    }
    flight.cycles(200);
    EXPECT_GE(flight.leastPairGauge(), 1.0) << "seed " << seed;
    for (std::size_t uav = 0; uav < 10; ++uav) {
      const Vector3& end = flight.planner().reference(uav).path.points().back();
      EXPECT_LT((flight.vehicle(uav).p - end).norm(), 0.5) << "seed " << seed << ", UAV " << uav;
    }
  }
  EXPECT_GT(given, 3000);
}

// Negative control: the same commands without avoidance.
TEST(RandomCommands, WithoutAvoidanceUavsCollide) {
  int flights_with_collision = 0;
  for (int seed = 0; seed < 5; ++seed) {
    PerfectFlight flight(swapOfTen(seed, false));
    Operator someone(seed);
    for (int cycle = 0; cycle < 120; ++cycle) {
      someone.act(flight.planner());
      flight.cycle();
    }
    flights_with_collision += flight.leastPairGauge() < 1.0 ? 1 : 0;
  }
  EXPECT_GE(flights_with_collision, 4);
}

}  // namespace
}  // namespace swarm_planner
