// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A name that sets another parameter than its own would fly with limits that nobody chose.
#include <gtest/gtest.h>

#include <set>

#include "swarm_planner/config/parameter_io.hpp"

namespace swarm_planner {
namespace {

/// A value that no other parameter has, and where it has to arrive.
struct Place {
  const char* name;
  ParameterValue value;
  ParameterValue (*get)(const Parameters&);
};

const Place kPlaces[] = {
    {"max_speed", 4.1, [](const Parameters& p) -> ParameterValue { return p.limits.max_speed; }},
    {"max_acceleration", 12.0, [](const Parameters& p) -> ParameterValue { return p.limits.max_acceleration; }},
    {"max_jerk", 33.0, [](const Parameters& p) -> ParameterValue { return p.limits.max_jerk; }},
    {"max_thrust_ratio", 1.9, [](const Parameters& p) -> ParameterValue { return p.limits.max_thrust_ratio; }},
    {"min_thrust_ratio", 0.3, [](const Parameters& p) -> ParameterValue { return p.limits.min_thrust_ratio; }},
    {"uav_radius", 0.4, [](const Parameters& p) -> ParameterValue { return p.limits.uav_radius; }},
    {"pair_distance", 2.1, [](const Parameters& p) -> ParameterValue { return p.limits.pair_distance; }},
    {"pair_distance_vertical", 2.2,
     [](const Parameters& p) -> ParameterValue { return p.limits.pair_distance_vertical; }},
    {"tracking_margin", 0.11, [](const Parameters& p) -> ParameterValue { return p.limits.tracking_margin; }},
    {"pair_margin", 0.23, [](const Parameters& p) -> ParameterValue { return p.limits.pair_margin; }},
    {"tracking_error", 0.07, [](const Parameters& p) -> ParameterValue { return p.limits.tracking_error; }},
    {"land_speed", 0.61, [](const Parameters& p) -> ParameterValue { return p.landing.speed; }},
    {"ground_height", -0.62, [](const Parameters& p) -> ParameterValue { return p.landing.ground_height; }},
    {"avoidance", false, [](const Parameters& p) -> ParameterValue { return p.limits.avoidance; }},
    {"plan_check", false, [](const Parameters& p) -> ParameterValue { return p.limits.plan_check; }},
    {"segment_constraints", false, [](const Parameters& p) -> ParameterValue { return p.limits.segment_constraints; }},
    {"right_of_way", false, [](const Parameters& p) -> ParameterValue { return p.limits.right_of_way; }},
    {"guide", false, [](const Parameters& p) -> ParameterValue { return p.limits.guide; }},
    {"latency_compensation", false,
     [](const Parameters& p) -> ParameterValue { return p.limits.latency_compensation; }},
    {"as_paper", true, [](const Parameters& p) -> ParameterValue { return p.limits.as_paper; }},
    {"sampling_time", 0.21, [](const Parameters& p) -> ParameterValue { return p.time.sampling_time; }},
    {"cycle_period", 0.22, [](const Parameters& p) -> ParameterValue { return p.time.cycle_period; }},
    {"alpha", 0.51, [](const Parameters& p) -> ParameterValue { return p.cost.alpha; }},
    {"beta", 0.52, [](const Parameters& p) -> ParameterValue { return p.cost.beta; }},
    {"eta", 0.53, [](const Parameters& p) -> ParameterValue { return p.cost.eta; }},
    {"zeta", 0.54, [](const Parameters& p) -> ParameterValue { return p.cost.zeta; }},
    {"velocity_time", 0.55, [](const Parameters& p) -> ParameterValue { return p.cost.velocity_time; }},
    {"stop_weight", 0.555, [](const Parameters& p) -> ParameterValue { return p.cost.stop_weight; }},
    {"robustness_gain", 0.56, [](const Parameters& p) -> ParameterValue { return p.cost.robustness_gain; }},
    {"robustness_inner", 1.57, [](const Parameters& p) -> ParameterValue { return p.cost.robustness_inner; }},
    {"robustness_outer", 1.58, [](const Parameters& p) -> ParameterValue { return p.cost.robustness_outer; }},
    {"epsilon_s", 0.059, [](const Parameters& p) -> ParameterValue { return p.cost.epsilon_s; }},
    {"max_iterations", 7, [](const Parameters& p) -> ParameterValue { return p.sqp.max_iterations; }},
    {"max_tracks", 77, [](const Parameters& p) -> ParameterValue { return p.input.max_tracks; }},
    {"step_tolerance", 0.06, [](const Parameters& p) -> ParameterValue { return p.sqp.step_tolerance; }},
    {"slack_linear", 61.0, [](const Parameters& p) -> ParameterValue { return p.sqp.slack_linear; }},
    {"slack_quadratic", 62.0, [](const Parameters& p) -> ParameterValue { return p.sqp.slack_quadratic; }},
    {"threads", 3, [](const Parameters& p) -> ParameterValue { return p.compute.threads; }},
    {"odometry_timeout", 0.63, [](const Parameters& p) -> ParameterValue { return p.input.odometry_timeout; }},
    {"track_timeout", 0.64, [](const Parameters& p) -> ParameterValue { return p.input.track_timeout; }},
    {"track_sigmas", 2.1, [](const Parameters& p) -> ParameterValue { return p.input.track_sigmas; }},
    {"track_growth_time", 2.2, [](const Parameters& p) -> ParameterValue { return p.input.track_growth_time; }},
    {"tracking_time", 0.65, [](const Parameters& p) -> ParameterValue { return p.input.tracking_time; }},
    {"odometry_noise", 0.16, [](const Parameters& p) -> ParameterValue { return p.input.odometry_noise; }},
    {"relocalisation_time", 7.0, [](const Parameters& p) -> ParameterValue { return p.input.relocalisation_time; }},
    {"odometry_doubt_time", 1.1, [](const Parameters& p) -> ParameterValue { return p.input.odometry_doubt_time; }},
    {"off_plan_distance", 1.2, [](const Parameters& p) -> ParameterValue { return p.input.off_plan_distance; }},
    {"lost_growth_rate", 0.4, [](const Parameters& p) -> ParameterValue { return p.input.lost_growth_rate; }},
    {"lost_growth_limit", 3.0, [](const Parameters& p) -> ParameterValue { return p.input.lost_growth_limit; }},
    {"setpoint_repeats", 2, [](const Parameters& p) -> ParameterValue { return p.input.setpoint_repeats; }},
    {"lost_setpoints", 0, [](const Parameters& p) -> ParameterValue { return p.input.lost_setpoints; }},
    {"autostart", false, [](const Parameters& p) -> ParameterValue { return p.input.autostart; }},
    {"mass", 0.47, [](const Parameters& p) -> ParameterValue { return p.vehicle.mass; }},
    {"gravity", 9.8, [](const Parameters& p) -> ParameterValue { return p.vehicle.gravity; }},
    {"arm_length", 0.26, [](const Parameters& p) -> ParameterValue { return p.vehicle.arm_length; }},
    {"drag_x", 0.271, [](const Parameters& p) -> ParameterValue { return p.vehicle.drag_x; }},
    {"drag_y", 0.272, [](const Parameters& p) -> ParameterValue { return p.vehicle.drag_y; }},
    {"drag_z", 0.273, [](const Parameters& p) -> ParameterValue { return p.vehicle.drag_z; }},
    {"force_constant", 2.8e-6, [](const Parameters& p) -> ParameterValue { return p.vehicle.force_constant; }},
    {"rotor_drag_constant", 1.2e-7,
     [](const Parameters& p) -> ParameterValue { return p.vehicle.rotor_drag_constant; }},
    {"inertia_x", 0.0041, [](const Parameters& p) -> ParameterValue { return p.vehicle.inertia_x; }},
    {"inertia_y", 0.0042, [](const Parameters& p) -> ParameterValue { return p.vehicle.inertia_y; }},
    {"inertia_z", 0.0043, [](const Parameters& p) -> ParameterValue { return p.vehicle.inertia_z; }},
    {"max_rotor_speed", 1001.0, [](const Parameters& p) -> ParameterValue { return p.vehicle.max_rotor_speed; }},
    {"step", 0.004, [](const Parameters& p) -> ParameterValue { return p.simulation.step; }},
    {"odometry_rate", 51.0, [](const Parameters& p) -> ParameterValue { return p.simulation.odometry_rate; }},
    {"track_rate", 11.0, [](const Parameters& p) -> ParameterValue { return p.simulation.track_rate; }},
    {"position_gain", 4.5, [](const Parameters& p) -> ParameterValue { return p.simulation.position_gain; }},
    {"velocity_gain", 3.5, [](const Parameters& p) -> ParameterValue { return p.simulation.velocity_gain; }},
    {"attitude_gain", 210.0, [](const Parameters& p) -> ParameterValue { return p.simulation.attitude_gain; }},
    {"attitude_rate_gain", 26.0, [](const Parameters& p) -> ParameterValue { return p.simulation.attitude_rate_gain; }},
    {"max_tilt", 1.1, [](const Parameters& p) -> ParameterValue { return p.simulation.max_tilt; }},
    {"position_noise", 0.012, [](const Parameters& p) -> ParameterValue { return p.simulation.position_noise; }},
    {"velocity_noise", 0.013, [](const Parameters& p) -> ParameterValue { return p.simulation.velocity_noise; }},
    {"position_bias", 0.014, [](const Parameters& p) -> ParameterValue { return p.simulation.position_bias; }},
    {"wind", 1.5, [](const Parameters& p) -> ParameterValue { return p.simulation.wind; }},
    {"gust_time", 1.6, [](const Parameters& p) -> ParameterValue { return p.simulation.gust_time; }},
    {"latency", 0.017, [](const Parameters& p) -> ParameterValue { return p.simulation.latency; }},
    {"jitter", 0.018, [](const Parameters& p) -> ParameterValue { return p.simulation.jitter; }},
    {"drop", 0.019, [](const Parameters& p) -> ParameterValue { return p.simulation.drop; }},
    {"seed", 14, [](const Parameters& p) -> ParameterValue { return p.simulation.seed; }},
};

TEST(ParameterTable, EveryParameterIsStoredInItsOwnPlace) {
  ParameterMap given;
  for (const Place& place : kPlaces) given[place.name] = place.value;
  Faults faults;
  const Parameters parameters = resolveParameters(given, {}, "", faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  for (const Place& place : kPlaces) EXPECT_EQ(place.get(parameters), place.value) << place.name;
}

TEST(ParameterTable, EveryParameterIsAmongTheOnesChecked) {
  std::set<std::string> table, checked;
  for (const ParameterInfo& info : parameterTable()) table.insert(info.name);
  for (const Place& place : kPlaces) checked.insert(place.name);
  EXPECT_EQ(table, checked);
  EXPECT_EQ(table.size(), parameterTable().size()) << "two parameters of one name";
}

TEST(ParameterTable, DefaultsAreThoseOfTheStruct) {
  Faults faults;
  const Parameters resolved = resolveParameters({}, {}, "", faults);
  for (const Place& place : kPlaces) {
    for (const ParameterInfo& info : parameterTable()) {
      if (info.name != place.name || info.has_rule) continue;
      EXPECT_EQ(place.get(resolved), info.default_value) << info.name;
    }
  }
}

}  // namespace
}  // namespace swarm_planner
