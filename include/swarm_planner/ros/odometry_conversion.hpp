// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nav_msgs/Odometry.h>

#include <Eigen/Geometry>
#include <string>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/ros/frame_transformer.hpp"
#include "swarm_planner/ros/input_fault.hpp"

namespace swarm_planner {

/// In which axes a source gives its twist. nav_msgs/Odometry asks for those of the child frame; some give the world's.
enum class TwistFrame { kBody, kWorld };

/// One measurement of a UAV in the planning frame.
struct OdometrySample {
  double stamp = 0.0;           ///< [s]
  Vector3 p = Vector3::Zero();  ///< [m]
  Vector3 v = Vector3::Zero();  ///< [m/s]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// A usable sample, or a fault and what exactly is wrong.
struct OdometryResult {
  InputFault fault = InputFault::kNone;
  std::string why;
  OdometrySample sample;
};

/// Checks a message and brings it into the planning frame: p = T_PH p_H, v = R_PH q_HB v_B, where H is
/// header.frame_id and B the body (v = R_PH v_H for sources with twists in the world's axes).
/// `now` [s] judges the stamp: neither from the future nor older than `timeout` [s].
OdometryResult convertOdometry(const nav_msgs::Odometry& message, const FrameTransformer& frames,
                               TwistFrame twist_frame, double now, double timeout);

}  // namespace swarm_planner
