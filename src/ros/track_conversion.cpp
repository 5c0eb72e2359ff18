// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/track_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <unordered_set>

#include "swarm_planner/config/plausible.hpp"
#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// A 30 m tall body leans by 6 cm at its top [rad].
constexpr double kMaxTilt = 0.002;

struct TrackFault {
  InputFault fault;
  const char* text;  ///< empty if there is none
};

constexpr TrackFault kUsable{InputFault::kNone, ""};

// What is wrong with the numbers of a track.
TrackFault faultOf(const ObstacleTrack& track) {
  const Vector3 center = toVector3(track.center);
  const Vector3 velocity = toVector3(track.velocity);
  const Vector3 radii = toVector3(track.radii);
  const Vector3 exponents = toVector3(track.exponents);
  if (!center.allFinite()) return {InputFault::kNotFinite, "its centre is not finite"};
  if (!velocity.allFinite()) return {InputFault::kNotFinite, "its velocity is not finite"};
  if (!radii.allFinite() || radii.minCoeff() <= 0.0) {
    return {InputFault::kShape, "its radii must be finite and positive"};
  }
  if (!exponents.allFinite() || exponents.minCoeff() < 2.0) {
    return {InputFault::kShape, "its exponents must be finite and at least 2"};
  }
  if (!isUnit(toQuaternion(track.orientation))) {
    return {InputFault::kOrientation, "its orientation is not a unit quaternion"};
  }
  const bool sigmas_finite = std::isfinite(track.position_sigma) && std::isfinite(track.velocity_sigma);
  if (!sigmas_finite || std::min(track.position_sigma, track.velocity_sigma) < 0.0) {
    return {InputFault::kShape, "its standard deviations must be finite and not negative"};
  }
  const bool plausible = isWithin(center, kMostCoordinate) && isWithin(velocity, kMostSpeed) &&
                         isPlausibleShape(radii, exponents) && isPlausibleSigma(track.position_sigma) &&
                         isPlausibleSigma(track.velocity_sigma);
  return plausible ? kUsable : TrackFault{InputFault::kAbsurd, "its numbers are absurd"};
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

// Drops the message if its stamp is not of now.
void judgeStamp(double stamp, double now, double timeout, TrackBatch& batch) {
  char text[120];
  if (stamp > now + kFutureTolerance) {
    std::snprintf(text, sizeof(text), "obstacle tracks are stamped %.2f s ahead of ROS time", stamp - now);
    batch.drop(InputFault::kFromFuture, text);
  } else if (now - stamp > timeout) {
    std::snprintf(text, sizeof(text), "obstacle tracks are %.2f s old, limit %.2f s", now - stamp, timeout);
    batch.drop(InputFault::kStale, text);
  }
}

}  // namespace

void TrackBatch::drop(InputFault fault, const std::string& sentence) {
  dropped.add(fault);
  if (faults.size() < kMostSentences) faults.push_back(sentence);
}

TrackBatch convertTracks(const ObstacleTrackArray& message, const FrameTransformer& frames, double now,
                         double timeout) {
  TrackBatch batch;
  const double stamp = toSeconds(message.header.stamp);
  judgeStamp(stamp, now, timeout, batch);
  if (!batch.faults.empty()) return batch;
  std::string why;
  const auto pose = frames.toPlanning(message.header.frame_id, message.header.stamp, why);
  if (!pose) {
    batch.drop(InputFault::kFrame, "obstacle tracks: " + why);
    return batch;
  }
  std::unordered_set<int> seen;
  seen.reserve(message.tracks.size());
  for (const ObstacleTrack& track : message.tracks) {
    TrackFault fault = faultOf(track);
    if (fault.fault == InputFault::kNone && !isWithin(*pose * toVector3(track.center), kMostCoordinate)) {
      fault = {InputFault::kAbsurd, "its place in the planning frame is absurd"};
    }
    if (fault.fault == InputFault::kNone && !seen.insert(track.id).second) {
      fault = {InputFault::kDuplicate, "its id came twice in one message"};
    }
    if (fault.fault != InputFault::kNone) {
      batch.drop(fault.fault, "obstacle track " + std::to_string(track.id) + " dropped: " + fault.text);
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
