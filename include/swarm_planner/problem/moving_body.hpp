// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstdint>

#include "swarm_planner/obstacles/superellipsoid.hpp"
#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {

/// n . r >= offset for a position r relative to a body's reference point [m].
struct HalfSpace {
  Vector3 n = Vector3::UnitZ();  ///< of length 1 at most
  double offset = 0.0;

  /// Positive inside the half-space; a lower bound of the distance to what it keeps clear of.
  double clearance(const Vector3& r) const { return n.dot(r) - offset; }
};

/// How the distance to keep from a body grows over the horizon, because its prediction gets worse [m].
struct DistanceGrowth {
  double per_stage = 0.0;
  double limit = 0.0;  ///< growth ends here
};

/// By which ln S of (7) is multiplied so that a metre at the surface counts for a metre about [m].
double logarithmScale(const Superellipsoid& obstacle);

/// Something that a UAV keeps clear of over its horizon: an obstacle, eq. (7), or another UAV's plan, eq. (14).
/// Both are a convex set about a reference point that moves along known control points.
class MovingBody {
 public:
  /// An obstacle, given where it is at the horizon's start; `distance` [m] is to be kept from its surface
  /// S = `level` (e^eps_s) at the horizon's start, more by `growth` later. The obstacle must outlive the body.
  static MovingBody fromObstacle(const Superellipsoid& obstacle, double dt, double level, double distance,
                                 const DistanceGrowth& growth = {});
  /// Another UAV; the pair ellipsoid has the semi-axes `horizontal` and `vertical` [m] at the horizon's start, the
  /// shorter one grows by `growth` later and the longer one in proportion. `apart`: unit vector along which the two
  /// part where they coincide, opposite for the two of a pair. The motion must outlive the body.
  static MovingBody fromUav(const PredictedMotion& motion, double horizontal, double vertical, const Vector3& apart,
                            const DistanceGrowth& growth = {});

  /// Tells bodies of one problem apart; the same from cycle to cycle.
  std::uint32_t identity() const { return identity_; }
  void setIdentity(std::uint32_t identity) { identity_ = identity; }

  /// Gives way where the horizon's start at `r` is closer than the distance to keep: up to `margin` [m] of the
  /// distance is waived at first and demanded again within kReliefStages stages.
  void relieve(const Vector3& r, double margin);
  /// What is waived on segment k [m].
  double relief(int k) const { return k < kReliefStages ? relief_ * (kReliefStages - k) / kReliefStages : 0.0; }
  /// By how much more the distance is kept on segment k than at the horizon's start: as much as at its end [m].
  double growth(int k) const { return std::min((k + 1) * growth_.per_stage, growth_.limit); }
  /// The body with the distance that is kept on segment k, all along.
  MovingBody grownTo(int k) const;

  bool isUav() const { return motion_ != nullptr; }
  const Superellipsoid* obstacle() const { return obstacle_; }

  /// Bernstein control point i = 0..3 of the reference point's motion over segment k [m].
  Vector3 point(int k, int i) const {
    return motion_ != nullptr ? motion_->point(k, i) : obstacle_->center() + (k + i / 3.0) * step_;
  }

  /// From now on the half-spaces of an obstacle are those at its point nearest to `r`, instead of at its point towards
  /// its centre: round the edge of a thin wall the latter do not lead. Takes longer.
  void setPrecise() { precise_ = true; }

  /// From now on the half-spaces of an obstacle are those that the paper has: the first-order Taylor approximation of
  /// (7), ln S >= eps_s, times a length that makes it comparable to metres at the surface. Far from the obstacle they
  /// cut into it. The distance to keep has no part in them: it has to be in the obstacle's radii.
  void setLogarithmic() { logarithmic_ = obstacle_ != nullptr; }
  /// Whether whatever lies in a half-space is clear of the body: only setLogarithmic() takes that away.
  bool halfSpacesAreSafe() const { return !logarithmic_; }

  /// A half-space whose boundary supports the set, grown by the distance to keep at the horizon's start, towards `r`.
  /// Whatever lies in it is clear of the body then.
  HalfSpace supportingHalfSpace(const Vector3& r) const;
  /// Such a half-space towards where a whole segment is nearest: of a UAV the one that leaves the segment's control
  /// points most room, but for the last per cents. That towards the middle cuts into segments that pass by quickly.
  HalfSpace separatingHalfSpace(const SegmentPoints& relative) const;

  /// Contains everything that must be kept clear of over the whole horizon [m].
  const Box& box() const { return box_; }
  /// Half extents of a box about the reference point that contains what must be kept clear of at any time [m].
  const Vector3& extent() const { return extent_; }
  /// Radius about the reference point that contains what must be kept clear of at any time [m].
  double radius() const { return radius_; }
  /// The distance to keep at the horizon's start, without the body's own size [m]; of a UAV the shorter semi-axis.
  double distance() const { return distance_; }

 private:
  static constexpr int kReliefStages = 5;

  HalfSpace logarithmicHalfSpace(const Vector3& r) const;

  const Superellipsoid* obstacle_ = nullptr;
  const PredictedMotion* motion_ = nullptr;
  Vector3 step_ = Vector3::Zero();  ///< of an obstacle's centre per stage [m]
  std::uint32_t identity_ = 0;
  double level_ = 1.0;
  bool precise_ = false;
  double distance_ = 0.0;
  DistanceGrowth growth_;
  Vector3 scale_ = Vector3::Ones();  ///< shorter semi-axis over each semi-axis of a pair ellipsoid
  Vector3 extent_ = Vector3::Zero();
  double radius_ = 0.0;
  double relief_ = 0.0;
  bool logarithmic_ = false;
  Vector3 apart_ = Vector3::UnitX();
  Box box_;
};

/// A segment's control points relative to a body's reference point [m].
inline SegmentPoints relativePoints(const MovingBody& body, int k, const SegmentPoints& points) {
  return {points[0] - body.point(k, 0), points[1] - body.point(k, 1), points[2] - body.point(k, 2),
          points[3] - body.point(k, 3)};
}

/// The relative position at the middle of a segment [m].
inline Vector3 midpoint(const SegmentPoints& r) { return 0.125 * (r[0] + r[3]) + 0.375 * (r[1] + r[2]); }

/// About the point of the hull of a segment's control points that is nearest to the origin; zero where the hull holds
/// the origin.
Vector3 nearestPoint(const SegmentPoints& points);

/// True if the whole segment is certainly farther than `distance` [m] from what must be kept clear of.
inline bool isBeyond(const MovingBody& body, const SegmentPoints& relative, double distance) {
  Box box;
  for (const Vector3& r : relative) box.include(r);
  const Vector3 away = box.min.cwiseMax(-box.max);  // per axis the distance of the box from the reference point
  if ((away.array() > body.extent().array() + distance).any()) return true;
  const double radius = body.radius() + distance;
  return away.cwiseMax(0.0).squaredNorm() > radius * radius;
}

/// How segment k lies to a body: the half-space that separates them, with the growth until then and less what is
/// waived, and the least clearance of the segment's control points.
struct SegmentClearance {
  HalfSpace half_space;
  double clearance = 0.0;  ///< lower bound over the whole segment [m], negative if violated
};
SegmentClearance segmentClearance(const MovingBody& body, int k, const SegmentPoints& relative);

}  // namespace swarm_planner
