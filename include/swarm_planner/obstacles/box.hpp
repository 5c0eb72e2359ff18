// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Axis-aligned box [m].
struct Box {
  Vector3 min = Vector3::Constant(1e300);
  Vector3 max = Vector3::Constant(-1e300);

  void include(const Vector3& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  /// True if some point of this box lies within `distance` of `other` along every axis.
  bool near(const Box& other, double distance) const {
    return (min.array() - distance <= other.max.array()).all() && (other.min.array() - distance <= max.array()).all();
  }
};

}  // namespace swarm_planner
