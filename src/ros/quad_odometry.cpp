// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/quad_odometry.hpp"

#include <cmath>

#include "swarm_planner/ros/geometry_conversion.hpp"

namespace swarm_planner {

Eigen::Quaterniond orientationOf(const QuadState& state) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(state.theta, Vector3::UnitY()) *
                            Eigen::AngleAxisd(state.phi, Vector3::UnitX()));
}

Vector3 bodyRates(const QuadState& state) {
  return Vector3(state.phi_rate, state.theta_rate * std::cos(state.phi), -state.theta_rate * std::sin(state.phi));
}

void setPoseAndTwist(const UavMeasurement& measured, const QuadState& state, nav_msgs::Odometry& message) {
  const Eigen::Quaterniond orientation = orientationOf(state);
  message.pose.pose.position = toPoint(measured.p);
  message.pose.pose.orientation = toQuaternionMessage(orientation);
  message.twist.twist.linear = toVector3Message(orientation.conjugate() * measured.v);
  message.twist.twist.angular = toVector3Message(bodyRates(state));
}

}  // namespace swarm_planner
