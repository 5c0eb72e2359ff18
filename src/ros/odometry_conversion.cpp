// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/odometry_conversion.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "swarm_planner/config/plausible.hpp"
#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

std::string formatted(const char* format, double a, double b) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), format, a, b);
  return text.data();
}

OdometryResult faulty(InputFault fault, std::string why) {
  OdometryResult result;
  result.fault = fault;
  result.why = std::move(why);
  return result;
}

}  // namespace

OdometryResult convertOdometry(const nav_msgs::Odometry& message, const FrameTransformer& frames,
                               TwistFrame twist_frame, double now, double timeout) {
  const Vector3 p = toVector3(message.pose.pose.position);
  const Vector3 v = toVector3(message.twist.twist.linear);
  const Eigen::Quaterniond q = toQuaternion(message.pose.pose.orientation);
  if (!p.allFinite()) return faulty(InputFault::kNotFinite, "odometry position is not finite");
  if (!v.allFinite()) return faulty(InputFault::kNotFinite, "odometry velocity is not finite");
  if (!q.coeffs().allFinite()) return faulty(InputFault::kNotFinite, "odometry orientation is not finite");
  if (!isWithin(p, kMostCoordinate) || !isWithin(v, kMostSpeed)) {
    return faulty(InputFault::kAbsurd,
                  formatted("odometry is absurd: %.3g m from the origin at %.3g m/s", p.norm(), v.norm()));
  }
  if (!isUnit(q)) {
    return faulty(InputFault::kOrientation,
                  formatted("odometry orientation has norm %.3f, expected %.0f", std::min(q.norm(), 1e6), 1.0));
  }

  const double stamp = toSeconds(message.header.stamp);
  if (stamp == 0.0) return faulty(InputFault::kStale, "odometry has no stamp");
  if (stamp > now + kFutureTolerance) {
    return faulty(
        InputFault::kFromFuture,
        formatted("odometry is stamped %.2f s ahead of ROS time, at most %.2f s allowed: are the clocks in step?",
                  stamp - now, kFutureTolerance));
  }
  if (now - stamp > timeout) {
    return faulty(InputFault::kStale, formatted("odometry is %.2f s old, limit %.2f s", now - stamp, timeout));
  }

  OdometryResult result;
  const std::optional<Eigen::Isometry3d> pose =
      frames.toPlanning(message.header.frame_id, message.header.stamp, result.why);
  if (!pose) {
    result.fault = InputFault::kFrame;
    result.why = "odometry: " + result.why;
    return result;
  }
  const Eigen::Quaterniond frame_rotation(pose->linear());
  result.sample.stamp = stamp;
  result.sample.p = *pose * p;
  if (!isWithin(result.sample.p, kMostCoordinate)) {
    return faulty(InputFault::kAbsurd,
                  formatted("odometry is absurd in the planning frame: %.3g m from the origin, at most %.0g",
                            result.sample.p.norm(), kMostCoordinate));
  }
  result.sample.orientation = (frame_rotation * q).normalized();
  result.sample.v = (twist_frame == TwistFrame::kBody ? result.sample.orientation : frame_rotation) * v;
  return result;
}

}  // namespace swarm_planner
