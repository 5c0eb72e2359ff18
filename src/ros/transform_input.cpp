// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/transform_input.hpp"

#include <ros/console.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "swarm_planner/config/plausible.hpp"
#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// Names that are remembered: those of the largest swarm twice.
constexpr std::size_t kMostFrames = 20000;
// Localisation stamps transforms ahead for as long as it vouches for them; nobody does for longer [s].
constexpr double kMostAhead = 2.0;
// Beyond 0.01 tf2 itself refuses the square of a quaternion's norm, and complains.
constexpr double kMostNormError = 0.009;
constexpr double kNever = -std::numeric_limits<double>::infinity();

bool isName(const std::string& frame) { return !frame.empty() && frame.size() <= kLongestName; }

}  // namespace

InputFault faultOf(const geometry_msgs::TransformStamped& transform) {
  const std::string& parent = transform.header.frame_id;
  const std::string& child = transform.child_frame_id;
  if (!isName(parent) || !isName(child) || parent == child) return InputFault::kFrame;
  const Vector3 translation = toVector3(transform.transform.translation);
  const Eigen::Quaterniond rotation = toQuaternion(transform.transform.rotation);
  if (!translation.allFinite() || !rotation.coeffs().allFinite()) return InputFault::kNotFinite;
  if (!isWithin(translation, kMostCoordinate)) return InputFault::kAbsurd;
  return std::abs(rotation.squaredNorm() - 1.0) < kMostNormError ? InputFault::kNone : InputFault::kOrientation;
}

TransformInput::TransformInput(ros::NodeHandle& node, tf2::BufferCore& buffer) : buffer_(buffer) {
  const RefuseInput refuse = [this](InputFault fault, const std::string& why) { this->refuse(fault, why); };
  for (const bool is_static : {false, true}) {
    subscribers_.push_back(subscribeGuarded<tf2_msgs::TFMessage>(
        node, is_static ? kTfStaticTopic : kTfTopic, {kTfQueueSize, kMostTfBytes},
        [this, is_static](const tf2_msgs::TFMessage& message) { receive(message, is_static); }, refuse));
  }
}

void TransformInput::receive(const tf2_msgs::TFMessage& message, bool is_static) {
  const double now = toSeconds(ros::Time::now());
  if (now < last_now_) {
    buffer_.clear();
    for (auto& [frame, stamp] : stamps_) stamp = kNever;
  }
  last_now_ = now;
  std::uint64_t accepted = 0;
  for (geometry_msgs::TransformStamped transform : message.transforms) {
    const InputFault fault = judge(transform, is_static, now);
    if (fault != InputFault::kNone) {
      refuse(fault, "transform from '" + shortened(transform.child_frame_id) + "' to '" +
                        shortened(transform.header.frame_id) + "': " + faultText(fault));
      continue;
    }
    double& newest = stamps_[transform.child_frame_id];
    stamps_.emplace(transform.header.frame_id, kNever);
    // The same transform again, as many publishers send it, is no fault and nothing new.
    const double stamp = toSeconds(transform.header.stamp);
    if (!is_static && stamp == newest) continue;
    newest = is_static ? kNever : stamp;
    if (buffer_.setTransform(transform, "", is_static)) ++accepted;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  report_.accepted += accepted;
}

InputFault TransformInput::judge(const geometry_msgs::TransformStamped& transform, bool is_static, double now) {
  const InputFault fault = faultOf(transform);
  if (fault != InputFault::kNone) return fault;
  const auto known = stamps_.find(transform.child_frame_id);
  const bool names_known = known != stamps_.end() && stamps_.count(transform.header.frame_id) > 0;
  if (!names_known && stamps_.size() + 2 > kMostFrames) return InputFault::kTooMany;
  const double stamp = toSeconds(transform.header.stamp);
  if (is_static) return InputFault::kNone;
  if (stamp > now + kMostAhead) return InputFault::kFromFuture;
  return known != stamps_.end() && stamp < known->second ? InputFault::kOutOfOrder : InputFault::kNone;
}

void TransformInput::refuse(InputFault fault, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  report_.dropped.add(fault);
  report_.last_fault = why;
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "Dropped: " << why);
}

TransformInputReport TransformInput::report() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return report_;
}

}  // namespace swarm_planner
