// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Vector3.h>

#include <Eigen/Geometry>
#include <cmath>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

inline geometry_msgs::Point toPoint(const Vector3& vector) {
  geometry_msgs::Point message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

inline geometry_msgs::Vector3 toVector3Message(const Vector3& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

/// From geometry_msgs Point or Vector3.
template <typename Message>
Vector3 toVector3(const Message& message) {
  return Vector3(message.x, message.y, message.z);
}

inline geometry_msgs::Quaternion toQuaternionMessage(const Eigen::Quaterniond& rotation) {
  geometry_msgs::Quaternion message;
  message.x = rotation.x();
  message.y = rotation.y();
  message.z = rotation.z();
  message.w = rotation.w();
  return message;
}

/// As it stands: not normalised.
inline Eigen::Quaterniond toQuaternion(const geometry_msgs::Quaternion& message) {
  return Eigen::Quaterniond(message.w, message.x, message.y, message.z);
}

inline Eigen::Quaterniond yawRotation(double yaw) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3::UnitZ()));
}

/// Heading of the rotated x axis in the horizontal plane [rad].
inline double yawOf(const Eigen::Quaterniond& rotation) {
  const Vector3 forward = rotation * Vector3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

/// True if `rotation` is finite and its norm 1 within what rounding to a few digits leaves.
inline bool isUnit(const Eigen::Quaterniond& rotation) { return std::abs(rotation.norm() - 1.0) < 0.01; }

}  // namespace swarm_planner
