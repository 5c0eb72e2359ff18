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

TEST(ParameterRules, DefaultsAreThePapers) {
  const Parameters parameters = resolved({});
  EXPECT_DOUBLE_EQ(parameters.time.sampling_time, 0.3);
  EXPECT_DOUBLE_EQ(parameters.time.cycle_period, 0.3);
  EXPECT_DOUBLE_EQ(parameters.cost.alpha, 0.5);
  EXPECT_DOUBLE_EQ(parameters.cost.beta, 0.5);
  EXPECT_DOUBLE_EQ(parameters.cost.eta, 0.1);
  EXPECT_DOUBLE_EQ(parameters.cost.zeta, 0.2);
  EXPECT_DOUBLE_EQ(parameters.cost.velocity_time, 1.0);
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
  EXPECT_DOUBLE_EQ(parameters.cost.zeta, 0.2 / 64.0);
  EXPECT_DOUBLE_EQ(parameters.cost.velocity_time, 0.5);
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

/// Sets each parameter of the table to a value of its own and looks whether it arrives: a slot that two parameters
/// share, or that belongs to another parameter, would be seen.
TEST(ParameterTable, EveryParameterHasAPlaceOfItsOwn) {
  const ParameterMap given = {{"max_speed", 4.1},
                              {"max_acceleration", 12.0},
                              {"max_thrust_ratio", 1.9},
                              {"min_thrust_ratio", 0.3},
                              {"uav_radius", 0.4},
                              {"pair_distance", 2.1},
                              {"pair_distance_vertical", 2.2},
                              {"tracking_margin", 0.11},
                              {"avoidance", false},
                              {"sampling_time", 0.21},
                              {"cycle_period", 0.22},
                              {"alpha", 0.51},
                              {"beta", 0.52},
                              {"eta", 0.53},
                              {"zeta", 0.54},
                              {"velocity_time", 0.55},
                              {"robustness_gain", 0.56},
                              {"robustness_inner", 1.57},
                              {"robustness_outer", 1.58},
                              {"epsilon_s", 0.059},
                              {"max_iterations", 7},
                              {"step_tolerance", 0.06},
                              {"slack_linear", 61.0},
                              {"slack_quadratic", 62.0},
                              {"threads", 3},
                              {"odometry_timeout", 0.63},
                              {"track_timeout", 0.64},
                              {"tracking_time", 0.65},
                              {"autostart", false},
                              {"mass", 0.47},
                              {"gravity", 9.8},
                              {"arm_length", 0.26},
                              {"drag_x", 0.271},
                              {"drag_y", 0.272},
                              {"drag_z", 0.273},
                              {"force_constant", 2.8e-6},
                              {"rotor_drag_constant", 1.2e-7},
                              {"inertia_x", 0.0041},
                              {"inertia_y", 0.0042},
                              {"inertia_z", 0.0043},
                              {"max_rotor_speed", 1001.0},
                              {"step", 0.004},
                              {"odometry_rate", 51.0},
                              {"track_rate", 11.0},
                              {"position_gain", 4.5},
                              {"velocity_gain", 3.5},
                              {"attitude_gain", 210.0},
                              {"attitude_rate_gain", 26.0},
                              {"max_tilt", 1.1},
                              {"position_noise", 0.012},
                              {"velocity_noise", 0.013},
                              {"seed", 14}};
  ASSERT_EQ(given.size(), parameterTable().size());
  const Parameters p = resolved(given);
  const ParameterMap arrived = {{"max_speed", p.limits.max_speed},
                                {"max_acceleration", p.limits.max_acceleration},
                                {"max_thrust_ratio", p.limits.max_thrust_ratio},
                                {"min_thrust_ratio", p.limits.min_thrust_ratio},
                                {"uav_radius", p.limits.uav_radius},
                                {"pair_distance", p.limits.pair_distance},
                                {"pair_distance_vertical", p.limits.pair_distance_vertical},
                                {"tracking_margin", p.limits.tracking_margin},
                                {"avoidance", p.limits.avoidance},
                                {"sampling_time", p.time.sampling_time},
                                {"cycle_period", p.time.cycle_period},
                                {"alpha", p.cost.alpha},
                                {"beta", p.cost.beta},
                                {"eta", p.cost.eta},
                                {"zeta", p.cost.zeta},
                                {"velocity_time", p.cost.velocity_time},
                                {"robustness_gain", p.cost.robustness_gain},
                                {"robustness_inner", p.cost.robustness_inner},
                                {"robustness_outer", p.cost.robustness_outer},
                                {"epsilon_s", p.cost.epsilon_s},
                                {"max_iterations", p.sqp.max_iterations},
                                {"step_tolerance", p.sqp.step_tolerance},
                                {"slack_linear", p.sqp.slack_linear},
                                {"slack_quadratic", p.sqp.slack_quadratic},
                                {"threads", p.compute.threads},
                                {"odometry_timeout", p.input.odometry_timeout},
                                {"track_timeout", p.input.track_timeout},
                                {"tracking_time", p.input.tracking_time},
                                {"autostart", p.input.autostart},
                                {"mass", p.vehicle.mass},
                                {"gravity", p.vehicle.gravity},
                                {"arm_length", p.vehicle.arm_length},
                                {"drag_x", p.vehicle.drag_x},
                                {"drag_y", p.vehicle.drag_y},
                                {"drag_z", p.vehicle.drag_z},
                                {"force_constant", p.vehicle.force_constant},
                                {"rotor_drag_constant", p.vehicle.rotor_drag_constant},
                                {"inertia_x", p.vehicle.inertia_x},
                                {"inertia_y", p.vehicle.inertia_y},
                                {"inertia_z", p.vehicle.inertia_z},
                                {"max_rotor_speed", p.vehicle.max_rotor_speed},
                                {"step", p.simulation.step},
                                {"odometry_rate", p.simulation.odometry_rate},
                                {"track_rate", p.simulation.track_rate},
                                {"position_gain", p.simulation.position_gain},
                                {"velocity_gain", p.simulation.velocity_gain},
                                {"attitude_gain", p.simulation.attitude_gain},
                                {"attitude_rate_gain", p.simulation.attitude_rate_gain},
                                {"max_tilt", p.simulation.max_tilt},
                                {"position_noise", p.simulation.position_noise},
                                {"velocity_noise", p.simulation.velocity_noise},
                                {"seed", p.simulation.seed}};
  EXPECT_EQ(arrived, given);
}

}  // namespace
}  // namespace swarm_planner
