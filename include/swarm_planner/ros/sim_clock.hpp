// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

namespace swarm_planner {

/// The simulation's time. At speed 1 it is ROS time, whoever makes it. At any other speed this clock makes ROS time
/// itself: wall time times the speed, published on /clock.
class SimClock {
 public:
  explicit SimClock(double speed);

  bool makesRosTime() const { return makes_ros_time_; }
  /// [s]. Slows down rather than jump when the machine cannot keep up with the speed.
  double now();
  /// Tells everyone that it is `time` [s] now, if this clock makes ROS time.
  void publish(double time) const;

 private:
  const double speed_;
  const bool makes_ros_time_;
  ros::Publisher publisher_;
  ros::SteadyTime last_wall_;
  double time_;
};

}  // namespace swarm_planner
