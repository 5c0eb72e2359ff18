// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>

#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// Part of a straight line, by the share of its length.
struct LineShare {
  double begin = 0.0;
  double end = 1.0;
};

/// A straight line past a body that stands still. The distance to a convex body is convex along a line, so that
/// tangents bound it from below: a few distances prove that the whole line is clear, or find where it is not.
class ConvexPassage {
 public:
  /// Distances are proven to within this [m].
  static constexpr double kTolerance = 1e-4;

  /// From `a` to `b`; `distance` is to be kept from the surface [m]. The shape must outlive the passage.
  ConvexPassage(const Superellipsoid& shape, const Vector3& a, const Vector3& b, double distance)
      : shape_(shape), a_(a), way_(b - a), distance_(distance) {}

  bool isClear() const { return !findBlocked(); }
  /// The part of the line that is too near, if there is one.
  std::optional<LineShare> blocked() const;

 private:
  /// What is left of the distance at a share of the line [m], and how it changes [m per line].
  struct Sample {
    double share = 0.0;
    double value = 0.0;
    double slope = 0.0;
  };

  Sample at(double share) const;
  /// Some sample that is too near.
  std::optional<Sample> findBlocked() const;
  /// Where the distance becomes enough between a sample that is too near and one that is not.
  double edge(double blocked, double clear) const;

  const Superellipsoid& shape_;
  Vector3 a_;
  Vector3 way_;
  double distance_;
};

}  // namespace swarm_planner
