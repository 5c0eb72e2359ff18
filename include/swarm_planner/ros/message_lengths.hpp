// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <cstddef>
#include <cstdint>

#include "swarm_planner/Command.h"
#include "swarm_planner/InjectFault.h"
#include "swarm_planner/ObstacleTrackArray.h"
#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/SetReference.h"
#include "swarm_planner/ros/octomap_message.hpp"

namespace swarm_planner {

/// Whether a serialised message has room for the strings and arrays whose lengths it states. roscpp makes an array of
/// the stated length before it finds that there is nothing to fill it with: four wrong bytes would take all memory.
template <class Message>
bool lengthsFit(const std::uint8_t* bytes, std::size_t size);

template <>
bool lengthsFit<nav_msgs::Odometry>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<ObstacleTrackArray>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<tf2_msgs::TFMessage>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<trajectory_msgs::MultiDOFJointTrajectory>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<OctomapMessage>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<sensor_msgs::PointCloud2>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<PlannerStatus>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<SetReference::Request>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<Command::Request>(const std::uint8_t* bytes, std::size_t size);
template <>
bool lengthsFit<InjectFault::Request>(const std::uint8_t* bytes, std::size_t size);

}  // namespace swarm_planner
