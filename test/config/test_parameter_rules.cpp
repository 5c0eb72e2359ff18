// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Scenarios state limits and distances; weights, sampling and margins that they do not set must follow by the rules
// of doc/parameters.md, or a swarm in a room would fly with the paper's outdoor tuning.
#include <gtest/gtest.h>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/config/parameter_io.hpp"

namespace swarm_planner {
namespace {

Parameters resolved(const ParameterMap& given, const std::map<std::string, double>& overrides = {}) {
  Faults faults;
  const Parameters parameters = resolveParameters(given, overrides, "file.yaml", faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  return parameters;
}

TEST(ParameterRules, DefaultsAreThoseOfTheDocumentedRules) {
  const Parameters parameters = resolved({});
  EXPECT_DOUBLE_EQ(parameters.time.sampling_time, 0.3);
  EXPECT_DOUBLE_EQ(parameters.time.cycle_period, 0.3);
  EXPECT_DOUBLE_EQ(parameters.cost.alpha, 0.5);
  EXPECT_DOUBLE_EQ(parameters.cost.beta, 0.5);
  EXPECT_DOUBLE_EQ(parameters.cost.eta, 0.3);
  EXPECT_DOUBLE_EQ(parameters.cost.zeta, 0.05);
  EXPECT_DOUBLE_EQ(parameters.cost.velocity_time, 0.8);
  EXPECT_DOUBLE_EQ(parameters.limits.max_speed, 5.0);
  EXPECT_DOUBLE_EQ(parameters.limits.pair_distance_vertical, 2.0);
  EXPECT_DOUBLE_EQ(parameters.limits.tracking_margin, 0.06);
}

TEST(ParameterRules, SamplingTimeIsDistanceOverSpeedInTwentiethsOfASecond) {
  const struct {
    double pair_distance, max_speed, sampling_time;
  } cases[] = {{2.0, 5.0, 0.3},   {1.0, 5.0, 0.2},  {0.9, 5.0, 0.15},   {1.2499, 5.0, 0.2},
               {1.25, 5.0, 0.25}, {0.2, 1.5, 0.15}, {0.01, 10.0, 0.15}, {0.3, 1.0, 0.3}};
  for (const auto& expected : cases) {
    const Parameters parameters =
        resolved({}, {{"pair_distance", expected.pair_distance}, {"max_speed", expected.max_speed}});
    EXPECT_DOUBLE_EQ(parameters.time.sampling_time, expected.sampling_time)
        << expected.pair_distance << " m at " << expected.max_speed << " m/s";
  }
}

TEST(ParameterRules, CycleAndWeightsFollowTheSamplingTime) {
  const Parameters parameters = resolved({}, {{"sampling_time", 0.15}});
  EXPECT_DOUBLE_EQ(parameters.time.cycle_period, 0.15);
  EXPECT_DOUBLE_EQ(parameters.cost.zeta, 0.05 / 8.0);
  EXPECT_DOUBLE_EQ(parameters.cost.velocity_time, 0.4);
}

TEST(ParameterRules, MarginIsATenthOfTheSmallerDistanceWithinBounds) {
  const struct {
    double uav_radius, pair_distance, margin;
  } cases[] = {{0.3, 2.0, 0.06},  {0.3, 0.4, 0.04}, {0.1, 0.2, 0.02},
               {0.01, 5.0, 0.02}, {0.9, 5.0, 0.18}, {3.0, 9.0, 0.2}};
  for (const auto& expected : cases) {
    const Parameters parameters =
        resolved({}, {{"uav_radius", expected.uav_radius}, {"pair_distance", expected.pair_distance}});
    EXPECT_DOUBLE_EQ(parameters.limits.tracking_margin, expected.margin);
    EXPECT_DOUBLE_EQ(parameters.limits.pair_distance_vertical, expected.pair_distance);
  }
}

TEST(ParameterRules, PairMarginIsATenthOfThePairDistanceWithinBounds) {
  const struct {
    double uav_radius, pair_distance, margin;
  } cases[] = {{0.3, 2.0, 0.2}, {0.3, 1.0, 0.1}, {0.3, 9.0, 0.2}, {0.3, 0.65, 0.065}, {0.01, 0.1, 0.02}};
  for (const auto& expected : cases) {
    const Parameters parameters =
        resolved({}, {{"uav_radius", expected.uav_radius}, {"pair_distance", expected.pair_distance}});
    EXPECT_DOUBLE_EQ(parameters.limits.pair_margin, expected.margin) << expected.pair_distance;
  }
  EXPECT_DOUBLE_EQ(resolved({{"tracking_margin", 0.5}}).limits.pair_margin, 0.5) << "never less than tracking_margin";
}

// Plans may use up what the margins hold beyond it: all the error, and none of the rest, must be kept for good.
TEST(ParameterRules, TrackingErrorIsHalfOfTheSmallerMargin) {
  EXPECT_DOUBLE_EQ(resolved({}).limits.tracking_error, 0.03);
  EXPECT_DOUBLE_EQ(resolved({{"tracking_margin", 0.3}, {"pair_margin", 0.5}}).limits.tracking_error, 0.125);
  EXPECT_DOUBLE_EQ(resolved({{"tracking_margin", 0.3}, {"pair_margin", 0.1}}).limits.tracking_error, 0.025);
  EXPECT_DOUBLE_EQ(resolved({{"tracking_margin", 0.0}}).limits.tracking_error, 0.0);
  EXPECT_DOUBLE_EQ(resolved({{"tracking_margin", 0.3}, {"tracking_error", 0.01}}).limits.tracking_error, 0.01);
}

TEST(ParameterRules, AUavThatIsNotSeenIsGivenTwiceThePairDistanceAtMost) {
  EXPECT_EQ(resolved({}).input.lost_growth_limit, 2.0);
  EXPECT_EQ(resolved({{"pair_distance", 0.5}}).input.lost_growth_limit, 0.5);
  EXPECT_EQ(resolved({{"pair_distance", 0.5}, {"lost_growth_limit", 3.0}}).input.lost_growth_limit, 3.0);
}

// Sent once, three trajectories in a row are lost too often; over links that lose nothing repeats only cost.
TEST(ParameterRules, TrajectoriesAreRepeatedWhereMessagesAreLost) {
  EXPECT_EQ(resolved({}).input.setpoint_repeats, 0);
  EXPECT_EQ(resolved({{"drop", 0.01}}).input.setpoint_repeats, 1);
  EXPECT_EQ(resolved({{"drop", 0.2}, {"setpoint_repeats", 0}}).input.setpoint_repeats, 0);
  EXPECT_EQ(resolved({{"setpoint_repeats", 3}}).input.setpoint_repeats, 3);
}

TEST(ParameterRules, TrackingErrorHasRoomInBothMargins) {
  const auto faults = [](double tracking_margin, double pair_margin, double error) {
    Faults found;
    resolveParameters({{"tracking_margin", tracking_margin}, {"pair_margin", pair_margin}, {"tracking_error", error}},
                      {}, "", found);
    return found.text();
  };
  EXPECT_EQ(faults(0.2, 0.4, 0.2), "");
  EXPECT_NE(faults(0.2, 0.5, 0.21).find("tracking_error"), std::string::npos);
  EXPECT_NE(faults(0.5, 0.4, 0.21).find("half of pair_margin"), std::string::npos)
      << "two UAVs stray towards each other";
  EXPECT_EQ(faults(0.0, 0.0, 0.0), "");
}

TEST(ParameterRules, WhatIsGivenStands) {
  const Parameters parameters = resolved({{"sampling_time", 0.2},
                                          {"cycle_period", 0.1},
                                          {"zeta", 0.7},
                                          {"velocity_time", 0},
                                          {"pair_distance_vertical", 3},
                                          {"tracking_margin", 0.0}});
  EXPECT_EQ(parameters.time.sampling_time, 0.2);
  EXPECT_EQ(parameters.time.cycle_period, 0.1);
  EXPECT_EQ(parameters.cost.zeta, 0.7);
  EXPECT_EQ(parameters.cost.velocity_time, 0.0);
  EXPECT_EQ(parameters.limits.pair_distance_vertical, 3.0);
  EXPECT_EQ(parameters.limits.tracking_margin, 0.0);
}

TEST(ParameterRules, ScenarioComesBeforeWhatIsGivenAndThatBeforeTheDefault) {
  const ParameterMap given = {{"max_speed", 4.0}, {"mass", 0.5}, {"sampling_time", std::string("auto")}};
  const Parameters parameters = resolved(given, {{"max_speed", 3.0}, {"max_iterations", 2.0}});
  EXPECT_EQ(parameters.limits.max_speed, 3.0);
  EXPECT_EQ(parameters.vehicle.mass, 0.5);
  EXPECT_EQ(parameters.vehicle.gravity, 9.81);
  EXPECT_EQ(parameters.sqp.max_iterations, 2);
  EXPECT_DOUBLE_EQ(parameters.time.sampling_time, 0.3);
}

TEST(ParameterRules, PaperScenariosKeepThePapersWeightsWhateverIsGiven) {
  const ParameterMap given = {{"alpha", 3.0},     {"beta", 3.0},          {"eta", 3.0},
                              {"zeta", 3.0},      {"sampling_time", 0.2}, {"cycle_period", 0.2},
                              {"max_speed", 2.0}, {"velocity_time", 3.0}};
  const Parameters parameters = resolved(given, paperScaling(16).overrides);
  EXPECT_EQ(parameters.cost.alpha, 0.5);
  EXPECT_EQ(parameters.cost.beta, 0.5);
  EXPECT_EQ(parameters.cost.eta, 0.1);
  EXPECT_EQ(parameters.cost.zeta, 0.2);
  EXPECT_EQ(parameters.cost.velocity_time, 1.0);
  EXPECT_EQ(parameters.time.sampling_time, 0.3);
  EXPECT_EQ(parameters.time.cycle_period, 0.3);
  EXPECT_EQ(parameters.limits.max_speed, 5.0);
}

}  // namespace
}  // namespace swarm_planner
