// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A monitor that cries wolf grounds UAVs. Noise, latency, losses, bias and gusts are no faults of odometry.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/experiments/closed_loop_run.hpp"

namespace swarm_planner {
namespace {

constexpr Reason kFaults[] = {
    Reason::kOdometryStale, Reason::kOdometryFromFuture, Reason::kOdometryNotFinite, Reason::kOdometryFrozen,
    Reason::kOdometryJumps, Reason::kOdometryBackwards,  Reason::kOdometryDrifts,    Reason::kOffPlan};

void expectNoFault(const Scenario& scenario, const ParameterMap& given, std::uint64_t seed) {
  const Mission mission = makeMission(scenario, given, scenario.name);
  IterativePlanner planner(mission);
  const RunResult run = ClosedLoopRun(mission, planner, seed).fly();
  for (const Reason reason : kFaults) EXPECT_EQ(run.fallbacks.count(reasonText(reason)), 0U) << reasonText(reason);
  EXPECT_GT(run.cycles, 20U);
}

void expectNoFaultAnywhere(const ParameterMap& given) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectNoFault(circleSwap(10, 10.0, seed), given, seed);
    expectNoFault(movingObstacles(6, 8, seed), given, seed);
  }
  expectNoFault(crossing(), given, 0);
}

TEST(FalseAlarms, AreNotRaisedUndisturbed) { expectNoFaultAnywhere({}); }

TEST(FalseAlarms, AreNotRaisedByNoiseAndLosses) {
  expectNoFaultAnywhere({{"position_noise", 0.05}, {"velocity_noise", 0.05}, {"drop", 0.2}, {"latency", 0.1}});
}

TEST(FalseAlarms, AreNotRaisedByThreeTimesTheNoiseLateAndBiased) {
  expectNoFaultAnywhere({{"position_noise", 0.15},
                         {"velocity_noise", 0.15},
                         {"position_bias", 0.1},
                         {"drop", 0.2},
                         {"latency", 0.3},
                         {"jitter", 0.1}});
}

// Without noise, positions that do not change at first are no frozen ones either.
TEST(FalseAlarms, AreNotRaisedByLateSetpointsAlone) { expectNoFaultAnywhere({{"drop", 0.2}, {"latency", 0.3}}); }

TEST(FalseAlarms, AreNotRaisedByWind) {
  expectNoFault(circleSwap(10, 10.0, 0), {{"wind", 2.0}}, 0);
  expectNoFault(circleSwap(10, 10.0, 1), {{"wind", 2.0}, {"position_noise", 0.05}, {"latency", 0.1}}, 1);
}

// Negative control: odometry that is too old because it comes too late is told.
TEST(FalseAlarms, AreTrueOnesWhereOdometryIsTooLate) {
  const Mission mission = makeMission(crossing(), {{"latency", 0.45}, {"jitter", 0.3}}, "crossing");
  IterativePlanner planner(mission);
  const RunResult run = ClosedLoopRun(mission, planner, 0).fly();
  EXPECT_GT(run.fallbacks.count(reasonText(Reason::kOdometryStale)), 0U);
}

}  // namespace
}  // namespace swarm_planner
