// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// A point of a path with its unit tangent.
struct PathPoint {
  Vector3 position = Vector3::Zero();
  Vector3 tangent = Vector3::UnitX();
  double arc_length = 0.0;  ///< [m]
};

/// The reference of one UAV: a polyline by arc length. Repeated points are dropped; a path of length
/// zero is a single point with tangent e1. Nothing but what makes a path allocates.
class ReferencePath {
 public:
  /// Points closer than this to the one before count as repeated [m].
  static constexpr double kShortestSegment = 1e-9;

  ReferencePath() = default;
  /// At least one point, all finite [m].
  explicit ReferencePath(const std::vector<Vector3>& points);
  /// Becomes the line from `begin` to `end` [m], a single point if they coincide. Takes no heap if this path has been
  /// made of two different points or more before.
  void assignLine(const Vector3& begin, const Vector3& end);

  double length() const { return arc_lengths_.empty() ? 0.0 : arc_lengths_.back(); }
  /// The point at `arc_length` [m], clamped to the path. At a corner the tangent is that of the segment to come.
  PathPoint at(double arc_length) const;
  /// The point nearest to `position` among those within `window` [m] of arc length of `near` [m]: the window keeps
  /// the foot from jumping where the path crosses itself. Of points equally near, the first.
  PathPoint nearest(const Vector3& position, double near, double window = 5.0) const;
  /// How far a UAV at `position` that had come to `progress` has come by now [m]: its nearest point within 5 m, but
  /// past a sharp corner only from within `pass_distance` [m] of it, or where the path beyond is nearer by more than
  /// that; and never back again. Where a path doubles back both of its legs are near, and the nearest point cannot tell
  /// them apart.
  double advance(const Vector3& position, double progress, double pass_distance) const;
  /// Arc length of the first corner after `arc_length` [m], of the first sharp one, at which it turns by more than
  /// kSharpTurn; infinite if there is none.
  double nextCorner(double arc_length) const;
  double nextSharpCorner(double arc_length) const;
  const std::vector<Vector3>& points() const { return points_; }

 private:
  /// Cosine of the turn from which a corner is sharp: a little more than a right angle.
  static constexpr double kSharpTurn = -0.17;

  /// The first or, if there is none, an infinite arc length > `arc_length` of a corner whose turn has a cosine below
  /// `cosine`.
  double nextTurn(double arc_length, double cosine) const;
  double lastSharpCorner(double arc_length) const;
  PathPoint nearestBetween(const Vector3& position, double first, double last) const;
  /// Index of the segment that holds `arc_length` in [0, length()]; needs two points.
  std::size_t segmentAt(double arc_length) const;
  PathPoint onSegment(std::size_t segment, double arc_length) const;

  std::vector<Vector3> points_;
  std::vector<double> arc_lengths_;
  std::vector<Vector3> tangents_;  ///< of the segment that begins at each point but the last
};

/// State of a moving target.
struct TargetState {
  Vector3 p = Vector3::Zero();  ///< [m]
  Vector3 v = Vector3::Zero();  ///< [m/s], zero once it has stopped at the path's end
  double arc_length = 0.0;      ///< [m]
};

/// A reference with the target that moves along it from time zero and stops at its end: X_m of eq. (16).
/// A start beyond the end is the end.
struct MovingTarget {
  ReferencePath path;
  double start = 0.0;      ///< arc length at time_zero [m]
  double speed = 0.0;      ///< [m/s]
  double time_zero = 0.0;  ///< absolute time at which it starts moving [s]

  /// The target at absolute time `t` [s]; before time_zero it rests at its start.
  TargetState at(double t) const;
};

}  // namespace swarm_planner
