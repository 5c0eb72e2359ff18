// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/track_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// A 30 m tall body leans by 6 cm at its top [rad].
constexpr double kMaxTilt = 0.002;

// What is wrong with the numbers of a track; empty if nothing is.
std::string faultOf(const ObstacleTrack& track) {
  const Vector3 radii = toVector3(track.radii);
  const Vector3 exponents = toVector3(track.exponents);
  if (!toVector3(track.center).allFinite()) return "its centre is not finite";
  if (!toVector3(track.velocity).allFinite()) return "its velocity is not finite";
  if (!radii.allFinite() || radii.minCoeff() <= 0.0) return "its radii must be finite and positive";
  if (!exponents.allFinite() || exponents.minCoeff() < 2.0) return "its exponents must be finite and at least 2";
  if (!isUnit(toQuaternion(track.orientation))) return "its orientation is not a unit quaternion";
  const bool sigmas_finite = std::isfinite(track.position_sigma) && std::isfinite(track.velocity_sigma);
  if (!sigmas_finite || std::min(track.position_sigma, track.velocity_sigma) < 0.0) {
    return "its standard deviations must be finite and not negative";
  }
  return "";
}

Superellipsoid uprightBody(const ObstacleTrack& track, const Eigen::Isometry3d& pose) {
  const Vector3 center = pose * toVector3(track.center);
  const Vector3 velocity = pose.linear() * toVector3(track.velocity);
  const Eigen::Quaterniond orientation =
      Eigen::Quaterniond(pose.linear()) * toQuaternion(track.orientation).normalized();
  const Superellipsoid body(track.id, center, toVector3(track.radii), toVector3(track.exponents), yawOf(orientation),
                            velocity);
  const double lean = (orientation * Vector3::UnitZ()).head<2>().norm();
  // A body upside down is the same body: only the lean of its axis matters.
  if (lean <= kMaxTilt) return body;
  return Superellipsoid(track.id, center, Vector3::Constant(body.boundingRadius()), Vector3::Constant(2.0), 0.0,
                        velocity);
}

std::optional<std::string> stampFault(double stamp, double now, double timeout) {
  char text[120];
  if (stamp > now + kFutureTolerance) {
    std::snprintf(text, sizeof(text), "obstacle tracks are stamped %.2f s ahead of ROS time", stamp - now);
  } else if (now - stamp > timeout) {
    std::snprintf(text, sizeof(text), "obstacle tracks are %.2f s old, limit %.2f s", now - stamp, timeout);
  } else {
    return std::nullopt;
  }
  return std::string(text);
}

}  // namespace

TrackBatch convertTracks(const ObstacleTrackArray& message, const FrameTransformer& frames, double now,
                         double timeout) {
  TrackBatch batch;
  const double stamp = toSeconds(message.header.stamp);
  if (const auto fault = stampFault(stamp, now, timeout)) {
    batch.faults.push_back(*fault);
    return batch;
  }
  std::string why;
  const auto pose = frames.toPlanning(message.header.frame_id, message.header.stamp, why);
  if (!pose) {
    batch.faults.push_back("obstacle tracks: " + why);
    return batch;
  }
  std::set<int> seen;
  for (const ObstacleTrack& track : message.tracks) {
    std::string fault = faultOf(track);
    if (fault.empty() && !seen.insert(track.id).second) fault = "its id came twice in one message";
    if (!fault.empty()) {
      batch.faults.push_back("obstacle track " + std::to_string(track.id) + " dropped: " + fault);
      continue;
    }
    TrackedObstacle obstacle;
    obstacle.shape = uprightBody(track, *pose);
    obstacle.stamp = stamp;
    obstacle.position_sigma = track.position_sigma;
    obstacle.velocity_sigma = track.velocity_sigma;
    batch.tracks.push_back(obstacle);
  }
  return batch;
}

ObstacleTrack toMessage(const Superellipsoid& body) {
  ObstacleTrack message;
  message.id = body.id();
  message.center = toPoint(body.center());
  message.radii = toVector3Message(body.radii());
  message.exponents = toVector3Message(body.exponents());
  message.orientation = toQuaternionMessage(yawRotation(body.yaw()));
  message.velocity = toVector3Message(body.velocity());
  return message;
}

}  // namespace swarm_planner
