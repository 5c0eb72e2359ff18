// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {

/// The semi-axes of the ellipsoid that one UAV keeps clear around another [m].
struct PairSpacing {
  double horizontal = 0.0;
  double vertical = 0.0;

  /// Gauge of `d` [m]: below 1 too close.
  double gauge(const Vector3& d) const;
};

/// Where a UAV is to go: from where it is to its path, and along that as far as its target leads it. Refers to the
/// path, which has to outlive it.
class Way {
 public:
  /// A UAV at `p` [m], whose foot on target.path is at arc length `foot` [m], at time `t` [s].
  Way(const MovingTarget& target, const Vector3& p, double foot, double t);

  const Vector3& begin() const { return p_; }
  const ReferencePath& path() const { return *path_; }
  double foot() const { return foot_; }  ///< arc length [m]
  double end() const { return end_; }    ///< arc length up to which the UAV is to go [m]

  /// Gauge of the distance of `q` from the way's next `length` metres.
  double gaugeTo(const Vector3& q, double length, const PairSpacing& spacing) const;
  /// Whether the place `q` is on the way's next `length` metres, within `least` of spacing, and not behind.
  bool isBlockedAt(const Vector3& q, double length, double least, const PairSpacing& spacing) const;
  /// Arc length of the point nearest to `q` within the next `length` metres [m].
  double arcOf(const Vector3& q, double length) const;

 private:
  const ReferencePath* path_;
  Vector3 p_;
  double foot_;
  double end_;
};

}  // namespace swarm_planner
