// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "swarm_planner/guide/body_space.hpp"
#include "swarm_planner/guide/guide_path.hpp"
#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {

/// The part of a reference that a UAV is about to follow. Takes no heap.
struct FollowedPath {
  static constexpr std::size_t kMostPoints = 16;

  std::array<Vector3, kMostPoints> points;  ///< [m]
  std::array<double, kMostPoints> ways;     ///< from the first point [m]
  std::size_t count = 0;
  double begin = 0.0;  ///< arc length of the first point on the reference [m]
  bool ends = false;   ///< the last point is the reference's end

  /// From `arc_length` on, as far as there is room.
  void assign(const ReferencePath& reference, double arc_length);
  double length() const { return ways[count - 1]; }
  /// The point after `way` [m], clamped to the path.
  Vector3 at(double way) const;
};

/// Where something is in the way of a followed path. Ways are counted from its first point [m].
struct Blockage {
  double begin = 0.0;
  double near_end = 0.0;  ///< clear again, for a while
  double next = 0.0;      ///< blocked once more; the path's end if it is not
  double far_end = 0.0;   ///< clear again after all that begins within reach
  double far_next = 0.0;
  bool to_end = false;      ///< blocked to the path's end: there is no near_end
  bool far_to_end = false;  ///< likewise
  double smallest = 0.0;    ///< least half width of what blocks, with the distance to keep [m]
  double largest = 0.0;     ///< greatest half extent of it [m]
  bool in_map = false;      ///< occupied voxels are among it, whose extent is not known
};

/// How far ahead is looked.
struct LookAhead {
  double reach = 0.0;      ///< what begins farther ahead does not count yet [m]
  double least_gap = 0.0;  ///< shorter clear stretches are none [m]
};

/// The first place within reach at which the way of a UAV at `start`, to the path and along it, is blocked. `pace`: of
/// flight from `start` at time zero.
std::optional<Blockage> findBlockage(const FollowedPath& path, const Vector3& start, const Pace& pace,
                                     const LookAhead& look, const BodySpace& space);

}  // namespace swarm_planner
