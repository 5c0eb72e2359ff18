// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nav_msgs/Odometry.h>

#include <Eigen/Geometry>

#include "swarm_planner/model/dynamics.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// Attitude of the reduced model (yaw zero): R = R_y(theta) R_x(phi), so that R e_3 is the direction of thrust in (1).
Eigen::Quaterniond orientationOf(const QuadState& state);

/// Body rates [rad/s]: (phi', theta' cos phi, -theta' sin phi).
Vector3 bodyRates(const QuadState& state);

/// Odometry as REP-147 and nav_msgs ask for it: measured pose in the message's frame, measured velocity and body rates
/// in the body's axes. Sets pose and twist alone.
void setPoseAndTwist(const UavMeasurement& measured, const QuadState& state, nav_msgs::Odometry& message);

}  // namespace swarm_planner
