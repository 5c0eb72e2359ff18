// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <string>

#include "swarm_planner/SwarmPlan.h"
#include "swarm_planner/UavPlan.h"
#include "swarm_planner/model/setpoints.hpp"
#include "swarm_planner/ros/input_fault.hpp"
#include "swarm_planner/swarm/committed_motion.hpp"

namespace swarm_planner {

/// Setpoints as drivers take them: stamp = epoch, frame = `frame`, one "joint" called base_link, position, yaw,
/// velocity and acceleration in every point. Reuses the memory of `message`.
void toMessage(const SetpointTrajectory& trajectory, const std::string& frame,
               trajectory_msgs::MultiDOFJointTrajectory& message);

/// Why a vehicle cannot fly the trajectory of a message; kNone if it can. kOutOfOrder: its times do not increase;
/// kMalformed: it has no point, or a point no transform.
InputFault faultOf(const trajectory_msgs::MultiDOFJointTrajectory& message);

/// The way back. Points that lack a velocity or an acceleration have it zero. Throws std::invalid_argument with the
/// reason if a point has no transform.
SetpointTrajectory toSetpoints(const trajectory_msgs::MultiDOFJointTrajectory& message);

/// The exact motion that one UAV is to fly. Reuses the memory of `message`.
void toMessage(const CommittedMotion& motion, const std::string& uav, UavPlan& message);

}  // namespace swarm_planner
