// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace swarm_planner {

using Vector3 = Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;
using Matrix3 = Eigen::Matrix3d;

/// Upward unit vector of the ENU planning frame.
inline Vector3 upward() { return Vector3::UnitZ(); }

}  // namespace swarm_planner
