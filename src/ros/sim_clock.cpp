// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/sim_clock.hpp"

#include <rosgraph_msgs/Clock.h>

#include <algorithm>

#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// ROS time zero means "no time yet", so the clock starts later [s].
constexpr double kStart = 1.0;
// Simulated time made up for in one go [s].
constexpr double kMostCatchUp = 0.05;

}  // namespace

SimClock::SimClock(double speed)
    : speed_(speed), makes_ros_time_(speed != 1.0), last_wall_(ros::SteadyTime::now()), time_(kStart) {
  if (makes_ros_time_) publisher_ = ros::NodeHandle().advertise<rosgraph_msgs::Clock>(kClockTopic, kClockQueueSize);
}

double SimClock::now() {
  if (!makes_ros_time_) return toSeconds(ros::Time::now());
  const ros::SteadyTime wall = ros::SteadyTime::now();
  time_ += std::min(kMostCatchUp, speed_ * (wall - last_wall_).toSec());
  last_wall_ = wall;
  return time_;
}

void SimClock::publish(double time) const {
  if (!makes_ros_time_) return;
  rosgraph_msgs::Clock message;
  message.clock = toRosTime(time);
  publisher_.publish(message);
}

}  // namespace swarm_planner
