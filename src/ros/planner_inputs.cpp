// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planner_inputs.hpp"

#include <ros/console.h>

#include <utility>

#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// Of transforms [s]: as long as tf2's own listener remembers them.
constexpr double kTransformMemory = 10.0;

}  // namespace

PlannerInputs::PlannerInputs(const std::vector<std::string>& uav_names, const std::string& planning_frame,
                             const PlannerNodeOptions& options, const InputParameters& limits)
    : names_(uav_names),
      twist_frame_(options.odometry_twist_frame),
      limits_(limits),
      store_(uav_names.size(), limits.track_timeout, static_cast<std::size_t>(limits.max_tracks)),
      tf_buffer_(ros::Duration(kTransformMemory)),
      frames_(tf_buffer_, planning_frame, limits.odometry_timeout),
      next_warnings_(uav_names.size()),
      odometry_spinner_(1, &odometry_queue_),
      spinner_(1, &queue_) {
  subscribeOdometry(options.odometry_topic);
  node_.setCallbackQueue(&queue_);
  transforms_.emplace(node_, tf_buffer_);
  subscribers_.push_back(subscribeGuarded<ObstacleTrackArray>(
      node_, kObstacleTracksTopic, {kObstacleTracksQueueSize, kMostTrackBytes},
      [this](const ObstacleTrackArray& message) { receiveTracks(message); },
      [this](InputFault fault, const std::string& why) {
        store_.reject(fault, "obstacle tracks: " + why);
        ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, "Obstacle tracks cannot be used: " << why);
      }));
  odometry_spinner_.start();
  spinner_.start();
}

PlannerInputs::~PlannerInputs() {
  odometry_spinner_.stop();
  spinner_.stop();
}

void PlannerInputs::subscribeOdometry(const std::string& topic_pattern) {
  ros::NodeHandle node;
  node.setCallbackQueue(&odometry_queue_);
  for (std::size_t uav = 0; uav < names_.size(); ++uav) {
    subscribers_.push_back(subscribeGuarded<nav_msgs::Odometry>(
        node, nameForUav(topic_pattern, names_[uav]), {kOdometryQueueSize, kMostOdometryBytes},
        [this, uav](const nav_msgs::Odometry& message) { receiveOdometry(uav, message); },
        [this, uav](InputFault fault, const std::string& why) { rejectOdometry(uav, fault, "odometry: " + why); }));
    odometry_topics_.push_back(subscribers_.back().getTopic());
  }
}

void PlannerInputs::receiveOdometry(std::size_t uav, const nav_msgs::Odometry& message) {
  const double now = toSeconds(ros::Time::now());
  if (now == 0.0) return;  // /clock has not come yet: no stamp can be judged
  const OdometryResult result = convertOdometry(message, frames_, twist_frame_, now, limits_.odometry_timeout);
  if (result.fault == InputFault::kNone) {
    store_.accept(uav, result.sample);
  } else {
    rejectOdometry(uav, result.fault, result.why);
  }
}

void PlannerInputs::rejectOdometry(std::size_t uav, InputFault fault, const std::string& why) {
  store_.reject(uav, fault, why);
  const ros::WallTime wall = ros::WallTime::now();
  if (wall < next_warnings_[uav]) return;
  next_warnings_[uav] = wall + ros::WallDuration(kWarningPeriod);
  ROS_WARN_STREAM(names_[uav] << ": " << why << " (" << odometry_topics_[uav] << "), message dropped");
}

void PlannerInputs::receiveTracks(const ObstacleTrackArray& message) {
  const double now = toSeconds(ros::Time::now());
  if (now == 0.0) return;
  TrackBatch batch = convertTracks(message, frames_, now, limits_.track_timeout);
  std::string text;
  for (const std::string& fault : batch.faults) text += "\n  " + fault;
  const std::uint64_t dropped = batch.dropped.total();
  if (dropped > batch.faults.size()) text += "\n  and " + std::to_string(dropped - batch.faults.size()) + " more";
  if (dropped > 0) ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "Bad obstacle tracks:" << text);
  if (batch.tracks.size() > static_cast<std::size_t>(limits_.max_tracks)) {
    ROS_ERROR_THROTTLE(kWarningPeriod, "%zu obstacle tracks in one message: the %d nearest to the UAVs are used",
                       batch.tracks.size(), limits_.max_tracks);
  }
  store_.accept(std::move(batch));
}

}  // namespace swarm_planner
