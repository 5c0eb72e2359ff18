// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// An rviz configuration (YAML text) with its camera moved so that `points` [m] fill the view, the ground grid under
/// them with cells to match, and `frame` as the fixed frame. The camera's direction stays; everything else, too. Throws
/// std::invalid_argument if the text has no orbit camera, YAML::Exception if it is not YAML.
std::string fitView(const std::string& rviz_config, const std::vector<Vector3>& points, const std::string& frame);

}  // namespace swarm_planner
