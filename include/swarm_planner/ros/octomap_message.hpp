// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <string>
#include <vector>

namespace swarm_planner {

/// octomap_msgs/Octomap, field by field: messages of octomap_server and others are taken without that package. ROS
/// compares types by name and by the MD5 sum of the definition.
struct OctomapMessage {
  std_msgs::Header header;
  std::uint8_t binary = 0;        ///< two bits per child (OcTree::writeBinaryData), otherwise in full (writeData)
  std::string id;                 ///< type of the tree
  double resolution = 0.0;        ///< [m]
  std::vector<std::int8_t> data;  ///< the tree's nodes
};

}  // namespace swarm_planner

namespace ros::message_traits {

template <>
struct MD5Sum<swarm_planner::OctomapMessage> {
  static const char* value() { return "9a45536b45c5e409cd49f04bb2d9999f"; }
  static const char* value(const swarm_planner::OctomapMessage&) { return value(); }
};

template <>
struct DataType<swarm_planner::OctomapMessage> {
  static const char* value() { return "octomap_msgs/Octomap"; }
  static const char* value(const swarm_planner::OctomapMessage&) { return value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
struct Serializer<swarm_planner::OctomapMessage> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.binary);
    stream.next(message.id);
    stream.next(message.resolution);
    stream.next(message.data);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace ros::serialization
