// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/time.h>

namespace swarm_planner {

/// Seconds of the core's time base, which is ROS time. At today's system time a double resolves 0.24 microseconds.
double toSeconds(const ros::Time& time);

/// The nearest ROS time; what ROS time cannot hold (negative, not finite, past 2106) becomes its nearest end, not a
/// number that is not one: zero.
ros::Time toRosTime(double seconds);

}  // namespace swarm_planner
