// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/message_lengths.hpp"

#include <cstring>

namespace swarm_planner {
namespace {

// Serialised, least if strings vary [bytes].
constexpr std::size_t kStamp = 8;
constexpr std::size_t kVector = 24;
constexpr std::size_t kQuaternion = 32;
constexpr std::size_t kTransform = kVector + kQuaternion;
constexpr std::size_t kTwist = 2 * kVector;
constexpr std::size_t kTrack = 4 + 4 * kVector + kQuaternion + 16;
constexpr std::size_t kEmptyHeader = 4 + kStamp + 4;
constexpr std::size_t kEmptyStampedTransform = kEmptyHeader + 4 + kTransform;
constexpr std::size_t kEmptyTrajectoryPoint = 3 * 4 + 8;
constexpr std::size_t kEmptyPointField = 4 + 4 + 1 + 4;
constexpr std::size_t kEmptyUavStatus = 3 * 4 + 4 + 8 + 8 + 5 * 8 + kVector;

/// Walks over the bytes of a message; false as soon as they do not suffice.
class Cursor {
 public:
  Cursor(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}

  bool skip(std::size_t bytes) {
    if (bytes > left_) return false;
    at_ += bytes;
    left_ -= bytes;
    return true;
  }

  /// The length of an array whose elements take `least` bytes each or more.
  bool count(std::size_t least, std::uint32_t& length) {
    if (left_ < sizeof(length)) return false;
    std::memcpy(&length, at_, sizeof(length));  // little endian, as ROS has it and the machines that it runs on
    skip(sizeof(length));
    return length <= left_ / least;
  }

  bool array(std::size_t element) {
    std::uint32_t length = 0;
    return count(element, length) && skip(length * element);
  }

  bool string() { return array(1); }
  bool strings() {
    std::uint32_t length = 0;
    if (!count(4, length)) return false;
    for (std::uint32_t i = 0; i < length; ++i) {
      if (!string()) return false;
    }
    return true;
  }
  bool header() { return skip(4 + kStamp) && string(); }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

bool trajectoryPoint(Cursor& cursor) {
  return cursor.array(kTransform) && cursor.array(kTwist) && cursor.array(kTwist) && cursor.skip(8);
}

}  // namespace

template <>
bool lengthsFit<nav_msgs::Odometry>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  return cursor.header() && cursor.string();
}

template <>
bool lengthsFit<ObstacleTrackArray>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  return cursor.header() && cursor.array(kTrack);
}

template <>
bool lengthsFit<tf2_msgs::TFMessage>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  std::uint32_t transforms = 0;
  return cursor.count(kEmptyStampedTransform, transforms);
}

template <>
bool lengthsFit<trajectory_msgs::MultiDOFJointTrajectory>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  std::uint32_t points = 0;
  if (!cursor.header() || !cursor.strings()) return false;
  if (!cursor.count(kEmptyTrajectoryPoint, points)) return false;
  for (std::uint32_t i = 0; i < points; ++i) {
    if (!trajectoryPoint(cursor)) return false;
  }
  return true;
}

template <>
bool lengthsFit<OctomapMessage>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  return cursor.header() && cursor.skip(1) && cursor.string() && cursor.skip(sizeof(double)) && cursor.array(1);
}

template <>
bool lengthsFit<sensor_msgs::PointCloud2>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  std::uint32_t fields = 0;
  if (!cursor.header() || !cursor.skip(4 + 4) || !cursor.count(kEmptyPointField, fields)) return false;
  for (std::uint32_t i = 0; i < fields; ++i) {
    if (!cursor.string() || !cursor.skip(kEmptyPointField - 4)) return false;
  }
  return cursor.skip(1 + 4 + 4) && cursor.array(1);
}

template <>
bool lengthsFit<PlannerStatus>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  std::uint32_t uavs = 0;
  constexpr std::size_t kNumbers = 8 + kStamp + 1 + kStamp + 8 + 1 + 4 + 1 + 4 + 4;
  return cursor.header() && cursor.skip(kNumbers) && cursor.count(kEmptyUavStatus, uavs);
}

template <>
bool lengthsFit<SetReference::Request>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  return cursor.header() && cursor.string() && cursor.array(kVector);
}

template <>
bool lengthsFit<Command::Request>(const std::uint8_t* bytes, std::size_t size) {
  return Cursor(bytes, size).strings();
}

template <>
bool lengthsFit<InjectFault::Request>(const std::uint8_t* bytes, std::size_t size) {
  Cursor cursor(bytes, size);
  return cursor.string() && cursor.string();
}

}  // namespace swarm_planner
