// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a message of a few bytes that states a length of four thousand million and takes all memory; or
// a good message that is refused.
#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <cstring>
#include <vector>

#include "swarm_planner/ros/message_lengths.hpp"

namespace swarm_planner {
namespace {

template <class Message>
std::vector<std::uint8_t> bytesOf(const Message& message) {
  const ros::SerializedMessage serialised = ros::serialization::serializeMessage(message);
  return std::vector<std::uint8_t>(serialised.message_start, serialised.buf.get() + serialised.num_bytes);
}

/// The message fits; cut off anywhere or with a huge number anywhere it fits only if its arrays still do.
template <class Message>
void expectBounded(const Message& message, std::size_t lengths) {
  const std::vector<std::uint8_t> bytes = bytesOf(message);
  EXPECT_TRUE(lengthsFit<Message>(bytes.data(), bytes.size()));
  EXPECT_FALSE(lengthsFit<Message>(bytes.data(), 10)) << "not even a header";
  std::size_t refused = 0;
  for (std::size_t at = 0; at + 4 <= bytes.size(); ++at) {
    std::vector<std::uint8_t> changed = bytes;
    std::memset(&changed[at], 0x7F, 4);
    if (lengthsFit<Message>(changed.data(), changed.size())) {
      Message read;
      ros::serialization::IStream stream(changed.data(), static_cast<std::uint32_t>(changed.size()));
      try {
        ros::serialization::deserialize(stream, read);
      } catch (const ros::serialization::StreamOverrunException&) {
        continue;
      }
    } else {
      ++refused;
    }
  }
  EXPECT_GE(refused, lengths) << "each length, wherever the four bytes touch it";
}

std_msgs::Header header() {
  std_msgs::Header header;
  header.frame_id = "map";
  return header;
}

TEST(MessageLengths, OfEveryInputAreChecked) {
  nav_msgs::Odometry odometry;
  odometry.header = header();
  odometry.child_frame_id = "base_link";
  expectBounded(odometry, 2);
  ObstacleTrackArray tracks;
  tracks.header = header();
  tracks.tracks.resize(3);
  expectBounded(tracks, 2);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(2);
  expectBounded(transforms, 1);
  trajectory_msgs::MultiDOFJointTrajectory trajectory;
  trajectory.header = header();
  trajectory.joint_names = {"base_link"};
  trajectory.points.resize(2);
  for (auto& point : trajectory.points) {
    point.transforms.resize(1);
    point.velocities.resize(1);
    point.accelerations.resize(1);
  }
  expectBounded(trajectory, 10);
  OctomapMessage map;
  map.header = header();
  map.id = "OcTree";
  map.data.resize(20);
  expectBounded(map, 3);
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header();
  cloud.fields.resize(3);
  for (auto& field : cloud.fields) field.name = "x";
  cloud.data.resize(20);
  expectBounded(cloud, 6);
  PlannerStatus status;
  status.header = header();
  status.uavs.resize(3);
  expectBounded(status, 2);
  SetReference::Request request;
  request.header = header();
  request.uav = "uav1";
  request.path.resize(2);
  expectBounded(request, 3);
}

}  // namespace
}  // namespace swarm_planner
