// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A flight without collision shows that a protection works only if the same flight without it has one.
#include <gtest/gtest.h>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/config/tight_scenarios.hpp"
#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/experiments/negative_controls.hpp"

namespace swarm_planner {
namespace {

struct CollisionCount {
  int with_uav = 0;
  int with_obstacle = 0;
};

RunResult flown(const Scenario& scenario, std::uint64_t seed, const ParameterMap& given) {
  const Mission mission = makeMission(scenario, given, scenario.name);
  IterativePlanner planner(mission);
  return ClosedLoopRun(mission, planner, seed).fly();
}

void count(const RunResult& run, CollisionCount& total) {
  for (const Collision& collision : run.flown.collisions)
    ++(collision.with_obstacle ? total.with_obstacle : total.with_uav);
}

CollisionCount ofSwaps(std::uint64_t last_seed, const ParameterMap& given) {
  CollisionCount total;
  for (std::uint64_t seed = 0; seed <= last_seed; ++seed) count(flown(circleSwap(10, 10.0, seed), seed, given), total);
  return total;
}

CollisionCount amongMovingObstacles(std::uint64_t last_seed, const ParameterMap& given) {
  CollisionCount total;
  for (std::uint64_t seed = 0; seed <= last_seed; ++seed) count(flown(movingObstacles(6, 8, seed), seed, given), total);
  return total;
}

// Either keeps UAVs apart between the samples, the solver's rows and the check.
TEST(NegativeControls, WithoutSegmentConstraintsAndCheckUavsMeetBetweenTheSamples) {
  EXPECT_EQ(ofSwaps(3, {}).with_uav, 0);
  EXPECT_EQ(ofSwaps(3, {{"segment_constraints", false}}).with_uav, 0);
  EXPECT_GT(ofSwaps(3, {{"segment_constraints", false}, {"plan_check", false}}).with_uav, 0);
}

TEST(NegativeControls, WithoutSegmentConstraintsAndCheckUavsCutThroughObstaclesBetweenTheSamples) {
  const CollisionCount with = amongMovingObstacles(9, {});
  EXPECT_EQ(with.with_obstacle, 0);
  EXPECT_EQ(with.with_uav, 0);
  EXPECT_EQ(amongMovingObstacles(9, {{"segment_constraints", false}}).with_obstacle, 0);
  EXPECT_GT(amongMovingObstacles(9, {{"segment_constraints", false}, {"plan_check", false}}).with_obstacle, 0);
}

TEST(NegativeControls, WithoutLatencyCompensationLateMeasurementsMeanCollisions) {
  EXPECT_EQ(ofSwaps(9, {{"latency", 0.3}}).with_uav, 0);
  EXPECT_GT(ofSwaps(9, {{"latency", 0.3}, {"latency_compensation", false}}).with_uav, 0);
}

// Wind takes vehicles off their motions: by up to 0.6 m here. tracking_error has to hold what they do.
TEST(NegativeControls, WithoutRoomForTrackingErrorsWindMeansCollisions) {
  const ParameterMap roomy = {{"wind", 2.0}, {"tracking_margin", 0.4}, {"pair_margin", 0.8}};
  EXPECT_EQ(ofSwaps(4, roomy).with_uav, 0);
  EXPECT_GT(ofSwaps(4, {{"wind", 2.0}}).with_uav, 0);
}

// What the argument for safety assumes of vehicles is what those of the simulator do, where the margins are least.
TEST(NegativeControls, InRoomsVehiclesStayWithinTheTrackingErrorUnlessTheyCannotTilt) {
  const Scenario room = swapInRoom(16, 0);
  const double assumed = makeMission(room, {}, room.name).parameters.limits.tracking_error;
  const RunResult flight = flown(room, 0, {});
  EXPECT_LT(flight.flown.tracking_error.max, 0.5 * assumed);
  const RunResult upright = flown(room, 0, {{"max_tilt", 0.2}});
  EXPECT_GT(upright.flown.tracking_error.max, assumed);
}

TEST(NegativeControls, AreToldInTheResult) {
  EXPECT_TRUE(leftOut(LimitParameters()).empty());
  for (const NegativeControl& control : kNegativeControls) {
    const RunResult run = flown(circleSwap(1, 1.0, 0), 0, {{control.parameter, false}});
    EXPECT_EQ(run.left_out, std::vector<std::string>{control.name});
  }
}

}  // namespace
}  // namespace swarm_planner
