// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>

#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/obstacles/box.hpp"

namespace swarm_planner {

/// Bernstein control points of the positions of one segment of constant jerk: the segment lies in their
/// convex hull.
using SegmentPoints = std::array<Vector3, 4>;

/// Control points of the segment between two consecutive knots, `dt` [s] apart.
inline SegmentPoints segmentPoints(const KinematicState& begin, const KinematicState& end, double dt) {
  return {begin.p, begin.p + dt / 3.0 * begin.v, begin.p + 2.0 * dt / 3.0 * begin.v + dt * dt / 6.0 * begin.a, end.p};
}

/// Motion of a UAV that others plan around: control points on the common stage grid; segment k holds points 3k..3k+3.
struct PredictedMotion {
  std::array<Vector3, 3 * kHorizon + 1> points;
  Box box;  ///< of all points

  /// Control point i = 0..3 of segment k.
  const Vector3& point(int k, int i) const { return points[static_cast<std::size_t>(3 * k + i)]; }
};

/// Predicts a motion on the stages of a horizon that starts at `epoch` with step `dt` [s]; motion.at(t) is its
/// KinematicState at time t. Where the motion's knots coincide with the stages this is exact; elsewhere a cubic Hermite
/// fit through the stages, off by at most jerk change * dt^3 / 192.
template <class Motion>
void predict(const Motion& motion, double epoch, double dt, PredictedMotion& predicted) {
  predicted.box = Box();
  KinematicState begin = motion.at(epoch);
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const KinematicState end = motion.at(epoch + static_cast<double>(k + 1) * dt);
    predicted.points[3 * k] = begin.p;
    predicted.points[3 * k + 1] = begin.p + dt / 3.0 * begin.v;
    predicted.points[3 * k + 2] = end.p - dt / 3.0 * end.v;
    begin = end;
  }
  predicted.points[3 * kHorizon] = begin.p;
  for (const Vector3& point : predicted.points) predicted.box.include(point);
}

}  // namespace swarm_planner
