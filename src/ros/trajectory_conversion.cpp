// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/trajectory_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "swarm_planner/config/plausible.hpp"
#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/time_conversion.hpp"
#include "swarm_planner/simulation/setpoint_track.hpp"

namespace swarm_planner {

void toMessage(const SetpointTrajectory& trajectory, const std::string& frame,
               trajectory_msgs::MultiDOFJointTrajectory& message) {
  message.header.stamp = toRosTime(trajectory.epoch);
  message.header.frame_id = frame;
  message.joint_names.assign(1, "base_link");
  message.points.resize(trajectory.points.size());
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const Setpoint& setpoint = trajectory.points[i];
    trajectory_msgs::MultiDOFJointTrajectoryPoint& point = message.points[i];
    point.time_from_start = ros::Duration(setpoint.time_from_start);
    point.transforms.resize(1);
    point.transforms[0].translation = toVector3Message(setpoint.p);
    point.transforms[0].rotation = toQuaternionMessage(yawRotation(setpoint.yaw));
    point.velocities.resize(1);
    point.velocities[0].linear = toVector3Message(setpoint.v);
    point.accelerations.resize(1);
    point.accelerations[0].linear = toVector3Message(setpoint.a);
  }
}

InputFault faultOf(const trajectory_msgs::MultiDOFJointTrajectory& message) {
  const auto lacks_transform = [](const auto& point) { return point.transforms.empty(); };
  if (message.points.empty()) return InputFault::kMalformed;
  if (std::any_of(message.points.begin(), message.points.end(), lacks_transform)) return InputFault::kMalformed;
  const SetpointTrajectory trajectory = toSetpoints(message);
  const auto is_finite = [](const Setpoint& x) {
    return x.p.allFinite() && x.v.allFinite() && x.a.allFinite() && std::isfinite(x.yaw);
  };
  if (!std::all_of(trajectory.points.begin(), trajectory.points.end(), is_finite)) return InputFault::kNotFinite;
  const auto is_plausible = [](const Setpoint& x) {
    return isWithin(x.p, kMostSetpoint) && isWithin(x.v, kMostSetpoint) && isWithin(x.a, kMostSetpoint);
  };
  if (!std::all_of(trajectory.points.begin(), trajectory.points.end(), is_plausible)) return InputFault::kAbsurd;
  return isFlyable(trajectory) ? InputFault::kNone : InputFault::kOutOfOrder;
}

SetpointTrajectory toSetpoints(const trajectory_msgs::MultiDOFJointTrajectory& message) {
  SetpointTrajectory trajectory;
  trajectory.epoch = toSeconds(message.header.stamp);
  trajectory.points.reserve(message.points.size());
  for (const auto& point : message.points) {
    if (point.transforms.empty()) throw std::invalid_argument("a trajectory point has no transform");
    Setpoint setpoint;
    setpoint.time_from_start = point.time_from_start.toSec();
    setpoint.p = toVector3(point.transforms[0].translation);
    setpoint.yaw = yawOf(toQuaternion(point.transforms[0].rotation));
    if (!point.velocities.empty()) setpoint.v = toVector3(point.velocities[0].linear);
    if (!point.accelerations.empty()) setpoint.a = toVector3(point.accelerations[0].linear);
    trajectory.points.push_back(setpoint);
  }
  return trajectory;
}

void toMessage(const CommittedMotion& motion, const std::string& uav, UavPlan& message) {
  message.name = uav;
  message.epoch = toRosTime(motion.epoch());
  message.dt = motion.dt();
  message.jerks.resize(3 * static_cast<std::size_t>(motion.pieces()));
  const KinematicState start = motion.after(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    message.position[i] = start.p[axis];
    message.velocity[i] = start.v[axis];
    message.acceleration[i] = start.a[axis];
  }
  for (int k = 0; k < motion.pieces(); ++k) {
    const Vector3 jerk = motion.jerk(k);
    for (int axis = 0; axis < 3; ++axis) message.jerks[3 * static_cast<std::size_t>(k) + axis] = jerk[axis];
  }
}

}  // namespace swarm_planner
