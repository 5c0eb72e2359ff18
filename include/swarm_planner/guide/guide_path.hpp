// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>

#include "swarm_planner/guide/free_space.hpp"
#include "swarm_planner/guide/traffic.hpp"

namespace swarm_planner {

/// A polyline that is flown at a steady speed. Takes no heap.
struct GuidePath {
  static constexpr std::size_t kMostPoints = 24;

  std::array<Vector3, kMostPoints> points;  ///< [m]
  std::size_t count = 0;

  const Vector3& end() const { return points[count - 1]; }
  double length() const;
  /// Appends a point; false if there is no room.
  bool append(const Vector3& point);
};

/// How a path is flown: speed and when it begins.
struct Pace {
  double begin = 0.0;  ///< after the search's time zero [s]
  double speed = 1.0;  ///< > 0 [m/s]

  TimedPoint after(const Vector3& p, double way) const { return {p, begin + way / speed}; }
};

/// Whether all of the path is clear.
bool isClear(const GuidePath& path, const Pace& pace, const FreeSpace& space);
/// The path's length, and what the traffic on it costs [m].
double costOf(const GuidePath& path, const Pace& pace, const Traffic& traffic);

/// What is left of a path for a UAV at `p`: from there to the nearest point of the path, and on.
GuidePath restOf(const GuidePath& path, const Vector3& p);

/// Makes a clear path shorter, and keeps it clear: leaves out points that it can do without, and pulls the others
/// towards the line between their neighbours, as a string that is drawn tight.
void tighten(GuidePath& path, const Pace& pace, const FreeSpace& space, const Traffic& traffic);

}  // namespace swarm_planner
