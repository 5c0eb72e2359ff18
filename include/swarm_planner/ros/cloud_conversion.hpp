// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/ros/input_fault.hpp"

namespace swarm_planner {

/// The points of a cloud, in its frame [m], those that are not finite included. Nothing, `fault` and `why` if its
/// fields x, y, z are no floating-point numbers of this machine's byte order, or if its sizes do not fit its data.
std::optional<std::vector<Vector3>> pointsOf(const sensor_msgs::PointCloud2& cloud, InputFault& fault,
                                             std::string& why);

}  // namespace swarm_planner
