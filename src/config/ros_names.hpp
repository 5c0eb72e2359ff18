// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace swarm_planner {

/// A legal relative graph resource name of ROS, so that `<uav>/odometry` is a legal topic: a letter, then letters,
/// digits, underscores and single slashes.
bool isGraphName(const std::string& name);

/// A frame that tf2 can look up: printable, no leading slash, no white space.
bool isFrameName(const std::string& name);

}  // namespace swarm_planner
