// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Minutes of flight with random faults of every kind: what the hour of doc/experiments.md shows has to stay true.
#include <gtest/gtest.h>

#include <cmath>

#include "swarm_planner/config/rehearsal.hpp"
#include "swarm_planner/experiments/experiment_flight.hpp"
#include "swarm_planner/experiments/random_missions.hpp"

namespace swarm_planner {
namespace {

constexpr double kDuration = 600.0;  // [s]

RunResult rehearsed(const ParameterMap& given) { return flyExperimentRun(rehearsalRun(6, kDuration, 2, given)); }

TEST(Rehearsal, TenMinutesOfFaultsKeepEverybodyClearAndFlying) {
  const RunResult run = rehearsed({});
  EXPECT_TRUE(run.flown.collisions.empty());
  std::size_t injected = 0;
  for (const FaultTally& tally : run.faults.kinds) {
    injected += tally.injected;
    EXPECT_EQ(tally.recovered, tally.injected) << faultKindInfo(tally.kind).name;
  }
  EXPECT_GE(injected, 80u);
  EXPECT_EQ(run.faults.kinds.size(), faultKinds().size());
  ASSERT_TRUE(run.rehearsal);
  EXPECT_GE(run.rehearsal->fewest_reached, 30u);
  // What a broken link or a mad estimator does is told each time.
  for (const FaultTally& tally : run.faults.kinds) {
    if (tally.kind != FaultKind::kOdometryLost && tally.kind != FaultKind::kOdometryNotFinite &&
        tally.kind != FaultKind::kOdometryStale) {
      continue;
    }
    EXPECT_GT(tally.noticeable, 0u) << faultKindInfo(tally.kind).name;
    EXPECT_EQ(tally.reported, tally.noticeable) << faultKindInfo(tally.kind).name;
  }
}

// Nobody could: all others fly what was checked against its trajectory.
TEST(Rehearsal, NobodyIsToCopeWithAVehicleThatLeavesItsTrajectoryWhileNoPlannerLives) {
  int planners = 0, overlaps = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Scenario scenario = rehearsal(6, 3600.0, seed);
    for (const FaultInjection& death : scenario.faults) {
      if (death.kind != FaultKind::kPlannerDead) continue;
      ++planners;
      for (const FaultInjection& other : scenario.faults) {
        const bool while_dead = other.at >= death.at && other.at <= death.at + death.duration;
        const bool as_it_dies = other.at < death.at && other.at + other.duration >= death.at;
        if (while_dead || as_it_dies) overlaps += &other != &death;
        EXPECT_FALSE(while_dead && other.kind == FaultKind::kSetpointsIgnored) << seed << " " << death.at;
        EXPECT_FALSE(as_it_dies && other.kind == FaultKind::kSetpointsLost) << seed << " " << death.at;
      }
    }
  }
  EXPECT_GT(planners, 300);
  EXPECT_GT(overlaps, 50) << "with other faults it is not alone";
}

TEST(Rehearsal, WithoutMemoryOfLostTracksThereAreCollisions) {
  EXPECT_FALSE(rehearsed({{"track_timeout", 0.5}}).flown.collisions.empty());
}

TEST(Rehearsal, WithoutAvoidanceThereAreCollisions) {
  EXPECT_FALSE(rehearsed({{"avoidance", false}}).flown.collisions.empty());
}

TEST(RandomMissions, WhatMovesComesAgainFromFarAway) {
  const ExperimentRun run = rehearsalRun(6, kDuration, 0);
  IterativePlanner planner(run.mission);
  const RandomMissions missions(run.mission, *run.goals, planner, 0);
  const Workspace& workspace = *run.mission.scenario.workspace;
  for (std::size_t i = 0; i < run.mission.scenario.obstacles.size(); ++i) {
    const Superellipsoid start = makeObstacle(run.mission.scenario.obstacles[i]);
    int returns = 0, visits = 0;
    for (double t = 1.0; t < 3600.0; t += 1.0) {
      const Vector3 before = start.movedBy(missions.obstacleTime(i, t - 1.0)).center();
      const Vector3 after = start.movedBy(missions.obstacleTime(i, t)).center();
      const bool inside =
          (after.array() > workspace.min.array()).all() && (after.array() < workspace.max.array()).all();
      if (inside) ++visits;
      if ((after - before).norm() < 5.0) continue;
      ++returns;
      // Neither where it vanishes nor where it appears is anything within 20 s of it.
      for (const Vector3& place : {before, after}) {
        const Vector3 outside = (workspace.min - place).cwiseMax(place - workspace.max).cwiseMax(Vector3::Zero());
        EXPECT_GT(outside.norm(), 20.0 * start.velocity().norm() + 5.0);
      }
    }
    EXPECT_GT(visits, 600) << i;
    EXPECT_EQ(returns > 5, !start.velocity().isZero()) << i;
  }
}

}  // namespace
}  // namespace swarm_planner
