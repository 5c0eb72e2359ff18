// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <limits>

#include "swarm_planner/config/simulation_parameters.hpp"
#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// The quadrotor, Table 1 of the paper (its labels of k and b are swapped there: hover takes about
/// 620 rad/s with the values below).
struct VehicleParameters {
  double mass = 0.468;                   ///< M [kg]
  double gravity = 9.81;                 ///< g [m/s^2]
  double arm_length = 0.255;             ///< L, half the distance of two opposite rotors [m]
  double drag_x = 0.25;                  ///< k_dx [N s/m]
  double drag_y = 0.25;                  ///< k_dy [N s/m]
  double drag_z = 0.25;                  ///< k_dz [N s/m]
  double force_constant = 2.98e-6;       ///< k [N s^2/rad^2]
  double rotor_drag_constant = 1.14e-7;  ///< b [N m s^2/rad^2]
  double inertia_x = 4.856e-3;           ///< I_x [kg m^2]
  double inertia_y = 4.856e-3;           ///< I_y [kg m^2]
  double inertia_z = 8.801e-3;           ///< I_z [kg m^2]
  double max_rotor_speed = 1000.0;       ///< saturation of each rotor [rad/s]

  /// Drag over mass per axis [1/s]: k_d / M of (3).
  Vector3 dragOverMass() const { return Vector3(drag_x, drag_y, drag_z) / mass; }
};

/// Hard limits of flight and the distances to keep.
struct LimitParameters {
  double max_speed = 5.0;                                             ///< Euclidean norm [m/s]
  double max_acceleration = std::numeric_limits<double>::infinity();  ///< Euclidean norm [m/s^2]
  double max_jerk = 30.0;               ///< Euclidean norm; no plan that asks for more flies [m/s^3]
  double max_thrust_ratio = 2.0;        ///< T_max / (M g) of (6)
  double min_thrust_ratio = 0.2;        ///< least (A_z + g) / g, keeps the vehicle upright
  double uav_radius = 0.3;              ///< least distance of a UAV's centre to an obstacle's surface [m]
  double pair_distance = 2.0;           ///< R_CA of (14), horizontal [m]
  double pair_distance_vertical = 2.0;  ///< vertical semi-axis of the pair ellipsoid [m]; unset: pair_distance
  double tracking_margin = 0.2;         ///< kept on top of uav_radius by the planner [m]; unset: by rule
  double pair_margin = 0.2;             ///< kept on top of the pair distances by the planner [m]; unset: by rule
  double tracking_error = 0.05;         ///< how far a vehicle may stray from its motion, part of the margins [m];
                                        ///< unset: by rule

  // False only for negative controls:
  bool avoidance = true;             ///< obstacle and pair constraints
  bool plan_check = true;            ///< plans are checked before they fly
  bool segment_constraints = true;   ///< constraints hold between the samples; false: at the samples alone
  bool guide = true;                 ///< ways round what blocks references are searched
  bool right_of_way = true;          ///< UAVs give way to each other where none gets on
  bool latency_compensation = true;  ///< the age of measurements and the time until plans begin are allowed for

  bool as_paper =
      false;  ///< the paper's method alone, for comparison: see doc/experiments.md; the five above are false
};

/// How UAVs land.
struct LandingParameters {
  double speed = 0.5;          ///< of the descent [m/s]
  double ground_height = 0.0;  ///< z of a landed UAV's centre in the planning frame [m]
};

/// Sampling of the horizon and the cycle.
struct TimeParameters {
  double sampling_time = 0.3;  ///< dt of the horizon [s]; unset: by rule
  double cycle_period = 0.3;   ///< a new plan every so often [s]; unset: sampling_time
};

/// Weights of cost (16) and of the robustness function (8)-(13).
struct CostParameters {
  double alpha = 0.5;             ///< horizontal deviation from the reference path
  double beta = 0.5;              ///< vertical deviation from the reference path
  double eta = 0.3;               ///< distance of the state from the moving target's state
  double zeta = 0.05;             ///< rate of change of the control (jerk); unset: by rule
  double velocity_time = 0.8;     ///< makes velocity comparable to position in eta's term [s]; unset: by rule
  double stop_weight = 5.0;       ///< velocity and acceleration at a plan's end, which is to be nearly at rest
  double robustness_gain = 1.0;   ///< q of (9); 0 switches the robustness function off
  double robustness_inner = 1.2;  ///< r_a of (11), 1 < r_a < r_b
  double robustness_outer = 2.5;  ///< r_b of (11)
  double epsilon_s = 0.01;        ///< eps_s of (7) and (8)
};

/// Limit of SqpParameters::max_iterations; memory for so many is set aside.
constexpr int kMostSqpIterations = 50;

/// Sequential quadratic programming and penalties of violated constraints.
struct SqpParameters {
  int max_iterations = 5;          ///< most QPs per UAV and cycle
  double step_tolerance = 0.01;    ///< converged when no knot moves by more [m]
  double slack_linear = 200.0;     ///< L1 penalty per metre of violation
  double slack_quadratic = 200.0;  ///< quadratic penalty per square metre of violation
};

/// How the planner uses the machine.
struct ComputeParameters {
  int threads = 1;  ///< UAVs planned at the same time; the plans do not depend on it
};

/// Clocks of different computers let a stamp lie so far in the future without being wrong [s].
constexpr double kClockTolerance = 0.05;

/// Inputs of the planner and how long they are believed.
struct InputParameters {
  double odometry_timeout = 0.5;      ///< older odometry is not used [s]
  double track_timeout = 1.0;         ///< an obstacle track is predicted for at most so long [s]
  int max_tracks = 1000;              ///< of more obstacle tracks those nearest to the UAVs are used
  double track_sigmas = 3.0;          ///< how many standard deviations of a track are kept clear of
  double track_growth_time = 2.0;     ///< the velocity of a track is in doubt for at most so long after its stamp [s]
  double tracking_time = 0.5;         ///< time constant with which a vehicle's tracking deviation decays [s]
  double odometry_noise = 0.15;       ///< deviations up to this may be noise alone [m]
  double odometry_doubt_time = 1.0;   ///< how long a standstill or a deviation is put up with [s]
  double relocalisation_time = 10.0;  ///< after a jump, or a drift, other odometry is believed after this time [s]
  double off_plan_distance = 1.0;     ///< a UAV so far from its motion for odometry_doubt_time is planned for anew [m]
  double lost_growth_rate = 0.3;      ///< by which others keep farther from a UAV that is not seen [m/s]
  double lost_growth_limit = 2.0;     ///< up to this [m]; unset: pair_distance
  int lost_setpoints = 1;             ///< so many trajectories in a row may fail to reach a vehicle: 0 or 1
  int setpoint_repeats = 0;           ///< each trajectory is sent so many times more, spread over its cycle; unset: by
                                      ///< rule
  bool autostart = true;              ///< start as soon as every UAV's odometry has arrived
};

/// Every parameter of planner, vehicle and simulation. Loaded and validated by config/parameter_io.hpp.
struct Parameters {
  VehicleParameters vehicle;
  LimitParameters limits;
  LandingParameters landing;
  TimeParameters time;
  CostParameters cost;
  SqpParameters sqp;
  ComputeParameters compute;
  InputParameters input;
  SimulationParameters simulation;
};

}  // namespace swarm_planner
