// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Where something is at a time after the search's time zero.
struct TimedPoint {
  Vector3 p = Vector3::Zero();  ///< [m]
  double t = 0.0;               ///< [s]
};

/// What a guide keeps clear of, whoever knows it: bodies (BodySpace), and whatever else can tell a free distance, such
/// as the distance field of a map.
class FreeSpace {
 public:
  virtual ~FreeSpace() = default;

  /// By how much a point is farther from everything than is demanded [m]: never more than that, and negative if and
  /// only if it is too near to something.
  virtual double clearance(const TimedPoint& x) const = 0;
  /// Whether the straight and steady flight from one point to another is clear all the way.
  virtual bool isClear(const TimedPoint& from, const TimedPoint& to) const = 0;
};

}  // namespace swarm_planner
