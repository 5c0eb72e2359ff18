// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planner_inputs.hpp"

#include <ros/console.h>
#include <ros/transport_hints.h>

#include <boost/function.hpp>

#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// Between warnings about the same source [s].
constexpr double kWarningPeriod = 5.0;

}  // namespace

PlannerInputs::PlannerInputs(const std::vector<std::string>& uav_names, const std::string& planning_frame,
                             const PlannerNodeOptions& options, const InputParameters& limits)
    : names_(uav_names),
      twist_frame_(options.odometry_twist_frame),
      limits_(limits),
      store_(uav_names.size(), limits.track_timeout),
      tf_listener_(tf_buffer_),
      frames_(tf_buffer_, planning_frame, limits.odometry_timeout),
      next_warnings_(uav_names.size()),
      spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  for (std::size_t uav = 0; uav < names_.size(); ++uav) {
    const boost::function<void(const nav_msgs::Odometry::ConstPtr&)> callback =
        [this, uav](const nav_msgs::Odometry::ConstPtr& message) { receiveOdometry(uav, *message); };
    const std::string topic = nameForUav(options.odometry_topic, names_[uav]);
    subscribers_.push_back(node_.subscribe<nav_msgs::Odometry>(topic, kOdometryQueueSize, callback, ros::VoidConstPtr(),
                                                               ros::TransportHints().tcpNoDelay()));
    odometry_topics_.push_back(subscribers_.back().getTopic());
  }
  const boost::function<void(const ObstacleTrackArray::ConstPtr&)> callback =
      [this](const ObstacleTrackArray::ConstPtr& message) { receiveTracks(*message); };
  subscribers_.push_back(node_.subscribe<ObstacleTrackArray>(kObstacleTracksTopic, kObstacleTracksQueueSize, callback,
                                                             ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  spinner_.start();
}

PlannerInputs::~PlannerInputs() { spinner_.stop(); }

void PlannerInputs::receiveOdometry(std::size_t uav, const nav_msgs::Odometry& message) {
  const double now = toSeconds(ros::Time::now());
  if (now == 0.0) return;  // /clock has not come yet: no stamp can be judged
  const OdometryResult result = convertOdometry(message, frames_, twist_frame_, now, limits_.odometry_timeout);
  if (result.fault == OdometryFault::kNone) {
    store_.accept(uav, result.sample);
    return;
  }
  store_.reject(uav, result.fault, result.why);
  const ros::WallTime wall = ros::WallTime::now();
  if (wall < next_warnings_[uav]) return;
  next_warnings_[uav] = wall + ros::WallDuration(kWarningPeriod);
  ROS_WARN_STREAM(names_[uav] << ": " << result.why << " (" << odometry_topics_[uav] << "), message dropped");
}

void PlannerInputs::receiveTracks(const ObstacleTrackArray& message) {
  const double now = toSeconds(ros::Time::now());
  if (now == 0.0) return;
  const TrackBatch batch = convertTracks(message, frames_, now, limits_.track_timeout);
  store_.accept(batch);
  if (batch.faults.empty()) return;
  std::string text;
  for (const std::string& fault : batch.faults) text += "\n  " + fault;
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "Bad obstacle tracks:" << text);
}

}  // namespace swarm_planner
