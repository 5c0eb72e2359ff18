// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/ObstacleTrackArray.h"
#include "swarm_planner/ros/frame_transformer.hpp"
#include "swarm_planner/ros/input_store.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/ros/transform_input.hpp"

namespace swarm_planner {

/// Receives odometry in one thread, obstacle tracks and transforms in another, checks them, brings them into the
/// planning frame and keeps the newest usable ones in a store, so that no callback ever delays the planning cycle, nor
/// a hundred thousand tracks the odometry.
class PlannerInputs {
 public:
  /// Starts receiving.
  PlannerInputs(const std::vector<std::string>& uav_names, const std::string& planning_frame,
                const PlannerNodeOptions& options, const InputParameters& limits);
  ~PlannerInputs();
  PlannerInputs(const PlannerInputs&) = delete;
  PlannerInputs& operator=(const PlannerInputs&) = delete;

  InputStore& store() { return store_; }
  const FrameTransformer& frames() const { return frames_; }
  /// Resolved name of a UAV's odometry topic.
  const std::string& odometryTopic(std::size_t uav) const { return odometry_topics_[uav]; }
  TransformInputReport transforms() const { return transforms_->report(); }
  /// Served by the thread of tracks: for work that may take longer than the cycle can spare.
  ros::CallbackQueue& queue() { return queue_; }

 private:
  void subscribeOdometry(const std::string& topic_pattern);
  void receiveOdometry(std::size_t uav, const nav_msgs::Odometry& message);
  void rejectOdometry(std::size_t uav, InputFault fault, const std::string& why);
  void receiveTracks(const ObstacleTrackArray& message);

  const std::vector<std::string> names_;
  const TwistFrame twist_frame_;
  const InputParameters limits_;
  InputStore store_;
  tf2::BufferCore tf_buffer_;
  FrameTransformer frames_;
  ros::CallbackQueue odometry_queue_, queue_;
  ros::NodeHandle node_;
  std::vector<std::string> odometry_topics_;
  std::vector<ros::WallTime> next_warnings_;  ///< per UAV, so that one cannot hide another's
  std::optional<TransformInput> transforms_;
  std::vector<ros::Subscriber> subscribers_;
  ros::AsyncSpinner odometry_spinner_, spinner_;
};

}  // namespace swarm_planner
