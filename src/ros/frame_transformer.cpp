// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/frame_transformer.hpp"

#include <geometry_msgs/TransformStamped.h>
#include <tf2/exceptions.h>

#include <cmath>
#include <utility>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/input_fault.hpp"

namespace swarm_planner {
namespace {

Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = toQuaternion(transform.rotation).normalized().toRotationMatrix();
  pose.translation() = toVector3(transform.translation);
  return pose;
}

// tf1 users still write "/map"; tf2 refuses it.
std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace

FrameTransformer::FrameTransformer(const tf2::BufferCore& buffer, std::string planning_frame, double max_lag)
    : buffer_(buffer), planning_frame_(withoutSlash(planning_frame)), max_lag_(max_lag) {}

std::optional<Eigen::Isometry3d> FrameTransformer::toPlanning(const std::string& frame, const ros::Time& stamp,
                                                              std::string& why) const {
  const std::string source = withoutSlash(frame);
  if (source.empty()) {
    why = "header.frame_id is empty";
    return std::nullopt;
  }
  if (source.size() > kLongestName) {
    why = "header.frame_id is no name of a frame: '" + shortened(source) + "'";
    return std::nullopt;
  }
  if (source == planning_frame_) return Eigen::Isometry3d::Identity();
  try {
    try {
      return toIsometry(buffer_.lookupTransform(planning_frame_, source, stamp).transform);
    } catch (const tf2::ExtrapolationException&) {
      const auto newest = buffer_.lookupTransform(planning_frame_, source, ros::Time(0));
      const double lag = (stamp - newest.header.stamp).toSec();
      if (std::abs(lag) <= max_lag_) return toIsometry(newest.transform);
      throw;
    }
  } catch (const tf2::TransformException& error) {
    why = "no transform from '" + shortened(source) + "' to '" + planning_frame_ + "': " + shortened(error.what(), 200);
    return std::nullopt;
  }
}

}  // namespace swarm_planner
