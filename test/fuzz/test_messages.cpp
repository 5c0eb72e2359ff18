// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a message or request of any bytes that ends a node, fills its memory or the console, or gets
// into a plan although it is not finite or absurd.
#include <ros/serialization.h>
#include <tf2/buffer_core.h>

#include <cmath>

#include "fuzz_target.hpp"
#include "swarm_planner/config/plausible.hpp"
#include "swarm_planner/ros/input_store.hpp"
#include "swarm_planner/ros/message_lengths.hpp"
#include "swarm_planner/ros/odometry_conversion.hpp"
#include "swarm_planner/ros/track_conversion.hpp"
#include "swarm_planner/ros/trajectory_conversion.hpp"
#include "swarm_planner/ros/transform_input.hpp"
#include "swarm_planner/simulation/setpoint_track.hpp"

namespace swarm_planner {
namespace {

constexpr double kNow = 100.0;
constexpr std::size_t kMostText = 600;  // of what an operator is told about one message [characters]
constexpr std::size_t kMaxTracks = 3;

geometry_msgs::TransformStamped transformTo(const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "map";
  transform.header.stamp = ros::Time(kNow);
  transform.child_frame_id = child;
  transform.transform.translation.x = 10.0;
  transform.transform.rotation.w = 1.0;
  return transform;
}

const FrameTransformer& frames() {
  static tf2::BufferCore buffer;
  static const bool known = buffer.setTransform(transformTo("odom"), "fuzz", true);
  static const FrameTransformer transformer(buffer, "map", 0.5);
  FUZZ_CHECK(known);
  return transformer;
}

template <class Message>
std::string bytesOf(char kind, const Message& message) {
  const ros::SerializedMessage serialised = ros::serialization::serializeMessage(message);
  const auto* start = reinterpret_cast<const char*>(serialised.message_start);
  return kind + std::string(start, serialised.num_bytes - 4);
}

/// As the guarded inputs do it.
template <class Message>
bool read(const std::uint8_t* data, std::size_t size, Message& message) {
  if (!lengthsFit<Message>(data, size)) return false;
  try {
    ros::serialization::IStream stream(const_cast<std::uint8_t*>(data), static_cast<std::uint32_t>(size));
    ros::serialization::deserialize(stream, message);
  } catch (const ros::serialization::StreamOverrunException&) {
    return false;
  }
  return true;
}

void useOdometry(const nav_msgs::Odometry& message) {
  for (const TwistFrame twist : {TwistFrame::kBody, TwistFrame::kWorld}) {
    const OdometryResult result = convertOdometry(message, frames(), twist, kNow, 0.5);
    FUZZ_CHECK(result.why.size() < kMostText);
    if (result.fault != InputFault::kNone) continue;
    FUZZ_CHECK(isWithin(result.sample.p, kMostCoordinate) && isWithin(result.sample.v, 2.0 * kMostSpeed));
    FUZZ_CHECK(std::abs(result.sample.orientation.norm() - 1.0) < 1e-9 && std::isfinite(result.sample.stamp));
  }
}

void useTracks(const ObstacleTrackArray& message) {
  TrackBatch batch = convertTracks(message, frames(), kNow, 1.0);
  FUZZ_CHECK(batch.faults.size() <= TrackBatch::kMostSentences);
  for (const std::string& fault : batch.faults) FUZZ_CHECK(fault.size() < kMostText);
  const std::size_t dropped = batch.dropped.total();
  FUZZ_CHECK(batch.tracks.size() + dropped == message.tracks.size() || dropped == 1);
  InputStore store(1, 1.0, kMaxTracks);
  store.accept(std::move(batch));
  Snapshot snapshot;
  store.fill(kNow, snapshot);
  FUZZ_CHECK(snapshot.obstacles.size() <= kMaxTracks);
  for (const TrackedObstacle& track : snapshot.obstacles) {
    FUZZ_CHECK(isWithin(track.shape.center(), kMostCoordinate) && isWithin(track.shape.velocity(), 2.0 * kMostSpeed));
    FUZZ_CHECK(track.shape.halfExtents().allFinite() && std::isfinite(track.shape.boundingRadius()));
    FUZZ_CHECK(std::isfinite(track.shape.signedDistance(Vector3(1.0, 2.0, 3.0))));
  }
}

void useTrajectory(const trajectory_msgs::MultiDOFJointTrajectory& message) {
  if (faultOf(message) != InputFault::kNone) return;
  const SetpointTrajectory trajectory = toSetpoints(message);
  SetpointTrack track(Vector3::Zero());
  if (!track.receive(trajectory, kNow)) return;
  for (const double t : {0.0, trajectory.epoch, trajectory.epoch + 0.1, kNow, 1e9}) {
    const MotionSetpoint setpoint = track.at(t);
    FUZZ_CHECK(setpoint.p.allFinite() && setpoint.v.allFinite() && setpoint.a.allFinite() && setpoint.jerk.allFinite());
  }
}

void useTransforms(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    if (faultOf(transform) != InputFault::kNone) continue;
    tf2::BufferCore buffer;
    buffer.setTransform(transform, "", true);
    std::string why;
    const FrameTransformer transformer(buffer, transform.header.frame_id, 0.5);
    const auto pose = transformer.toPlanning(transform.child_frame_id, ros::Time(), why);
    FUZZ_CHECK(why.size() < 2 * kMostText);
    if (pose) FUZZ_CHECK(pose->matrix().allFinite());
  }
}

template <class Message>
void use(const std::uint8_t* data, std::size_t size, void (*with)(const Message&)) {
  Message message;
  if (read(data, size, message)) with(message);
}

trajectory_msgs::MultiDOFJointTrajectory seedTrajectory() {
  SetpointTrajectory trajectory;
  trajectory.epoch = kNow;
  for (int i = 0; i < 4; ++i) {
    trajectory.points.emplace_back();
    trajectory.points.back().time_from_start = 0.1 * i;
    trajectory.points.back().p = Vector3(i, 0.0, 2.0);
  }
  trajectory_msgs::MultiDOFJointTrajectory message;
  toMessage(trajectory, "map", message);
  return message;
}

}  // namespace

std::vector<std::string> fuzzSeeds() {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.header.stamp = ros::Time(kNow);
  odometry.pose.pose.orientation.w = 1.0;
  odometry.pose.pose.position.x = 3.0;
  ObstacleTrackArray tracks;
  tracks.header = odometry.header;
  for (int i = 0; i < 5; ++i) {
    tracks.tracks.push_back(toMessage(
        Superellipsoid(i, Vector3(4.0 * i, 1, 2), Vector3(0.5, 1, 2), Vector3(2, 3.5, 8), 0.2, Vector3(0.1, 0, 0))));
  }
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {transformTo("odom"), transformTo("base")};
  PlannerStatus status;
  status.header = odometry.header;
  status.uavs.resize(3);
  status.uavs[1].reason = "waiting";
  SetReference::Request request;
  request.header = odometry.header;
  request.uav = "uav1";
  request.path.resize(3);
  return {bytesOf('\0', odometry),   bytesOf('\1', tracks), bytesOf('\2', seedTrajectory()),
          bytesOf('\3', transforms), bytesOf('\4', status), bytesOf('\5', request)};
}

}  // namespace swarm_planner

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swarm_planner;
  if (size == 0) return 0;
  switch (data[0] % 6) {
    case 0:
      use<nav_msgs::Odometry>(data + 1, size - 1, useOdometry);
      break;
    case 1:
      use<ObstacleTrackArray>(data + 1, size - 1, useTracks);
      break;
    case 2:
      use<trajectory_msgs::MultiDOFJointTrajectory>(data + 1, size - 1, useTrajectory);
      break;
    case 3:
      use<tf2_msgs::TFMessage>(data + 1, size - 1, useTransforms);
      break;
    case 4:
      use<PlannerStatus>(data + 1, size - 1,
                         [](const PlannerStatus& status) { FUZZ_CHECK(status.uavs.size() < 100000); });
      break;
    default:
      use<SetReference::Request>(data + 1, size - 1, [](const SetReference::Request& request) {
        FUZZ_CHECK(request.path.size() < 100000 && shortened(request.uav).size() < 200);
      });
  }
  return 0;
}
