// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "swarm_planner/ros/input_fault.hpp"

namespace swarm_planner {

/// What is known of transforms.
struct TransformInputReport {
  std::uint64_t accepted = 0;
  FaultCounts dropped;     ///< transforms and messages
  std::string last_fault;  ///< empty if there was none
};

/// Listens to /tf and /tf_static as tf2_ros::TransformListener does, but takes only what a transform can be: that one
/// remembers a frame for every name that it hears and writes each bad transform to the console, name and all, and one
/// transform of tomorrow makes it forget those of today.
class TransformInput {
 public:
  /// `node`: its queue is served by the thread that is to receive. `buffer` outlives this.
  TransformInput(ros::NodeHandle& node, tf2::BufferCore& buffer);

  TransformInputReport report() const;

 private:
  void receive(const tf2_msgs::TFMessage& message, bool is_static);
  InputFault judge(const geometry_msgs::TransformStamped& transform, bool is_static, double now);
  void refuse(InputFault fault, const std::string& why);

  tf2::BufferCore& buffer_;
  double last_now_ = 0.0;  ///< ROS time of the last message [s]; when it jumps back, all but static ones are forgotten
  /// Of the newest transform of each child frame, by name [s]; parents are there too, and count.
  std::unordered_map<std::string, double> stamps_;
  mutable std::mutex mutex_;  ///< of the report
  TransformInputReport report_;
  std::vector<ros::Subscriber> subscribers_;
};

/// Why a transform cannot be one, by its names and numbers alone.
InputFault faultOf(const geometry_msgs::TransformStamped& transform);

}  // namespace swarm_planner
