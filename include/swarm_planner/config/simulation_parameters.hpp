// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace swarm_planner {

/// The simulated quadrotor's controller, sensors and rates, the wind, and the links between vehicles and ground
/// station.
struct SimulationParameters {
  double step = 0.005;               ///< integration step of the dynamics [s]
  double odometry_rate = 50.0;       ///< [Hz]
  double track_rate = 10.0;          ///< of obstacle tracks [Hz]
  double position_gain = 4.0;        ///< acceleration per position error [1/s^2]
  double velocity_gain = 3.0;        ///< acceleration per velocity error [1/s]
  double attitude_gain = 200.0;      ///< angular acceleration per angle error [1/s^2]
  double attitude_rate_gain = 25.0;  ///< angular acceleration per rate error [1/s]
  double max_tilt = 1.2;             ///< commanded roll and pitch saturate here [rad]
  double position_noise = 0.0;       ///< standard deviation of measured position [m]
  double velocity_noise = 0.0;       ///< standard deviation of measured velocity [m/s]
  double position_bias = 0.0;        ///< length of each UAV's constant error of measured position [m]
  double wind = 0.0;                 ///< standard deviation of the gusts' velocity on each axis [m/s]
  double gust_time = 2.0;            ///< correlation time of the gusts [s]
  double latency = 0.0;              ///< delay of every message: odometry, tracks and setpoints [s]
  double jitter = 0.0;               ///< further delay, uniform between 0 and this, per message [s]
  double drop = 0.0;                 ///< probability that a message is lost
  int seed = 0;                      ///< of noise, bias, gusts, jitter and losses
};

}  // namespace swarm_planner
