// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <limits>

#include "swarm_planner/obstacles/superellipsoid.hpp"
#include "swarm_planner/problem/segment.hpp"
#include "swarm_planner/swarm/bernstein.hpp"

namespace swarm_planner {

/// What can be said of the clearance along a curve.
struct ClearanceFinding {
  bool clear = true;       ///< proven all along
  bool undecided = false;  ///< neither proven nor refuted when halving ended; never clear
  double time = 0.0;       ///< where it is too small, or undecided [s]
};

/// At least the largest n . y over a body about its centre, its support function [m], for any `n` in the planning
/// frame: by weak duality h(n) <= l (1 + sum_i (p_i - 1) s_i), s_i = (|n_i| r_i / (p_i l))^(p_i / (p_i - 1)) in the
/// body's axes, for every l > 0; l is the one with sum s_i = 1, where both are equal.
double supportBound(const Superellipsoid& body, const Vector3& n);

/// At most the distance from a point, relative to the body's centre, to the body [m]: cheap, and close to it from afar.
double distanceBound(const Superellipsoid& body, const Vector3& relative);

/// Proves that curves keep a metric distance from an obstacle, by means that are independent of how plans are made:
///  - the box around the body and the one around the curve;
///  - the distance to a set changes by 1 m per metre at most: Superellipsoid::signedDistance at a point of the curve,
///    a lower bound, minus the radius about it that holds the control points;
///  - a plane n . x = supportBound(n) has the body behind it, whatever n of length 1: the distances of the control
///  points
///    from it bound the curve's. n is the last one that served, one guessed from the radii, or the slope of the
///    distance.
/// What none of them decides is halved, up to a depth and a number of pieces; the rest is not clear.
class ObstacleProof {
 public:
  /// `body` must outlive this.
  explicit ObstacleProof(const Superellipsoid& body) : body_(body) {}

  /// `relative`: a curve minus the body's centre over [from, to]; the distance to keep goes from `distance_from` to
  /// `distance_to` >= 0 linearly [m].
  ClearanceFinding prove(const BernsteinPoints<4>& relative, double from, double to, double distance_from,
                         double distance_to);

 private:
  struct Span {
    double from, to;                    ///< [s]
    double distance_from, distance_to;  ///< to keep [m]
  };
  /// The body lies in normal . r <= offset; the first one proves nothing.
  struct Plane {
    Vector3 normal = Vector3::Zero();
    double offset = std::numeric_limits<double>::infinity();  ///< [m]

    bool proves(const BernsteinPoints<4>& relative, const Span& span) const;
  };
  ClearanceFinding prove(const BernsteinPoints<4>& relative, const Span& span, int depth);
  bool provesWith(const Vector3& normal, const BernsteinPoints<4>& relative, const Span& span);

  const Superellipsoid& body_;
  int nodes_ = 0;  ///< curves looked at so far
  Plane plane_;    ///< the last that proved something
};

/// Proves that two UAVs keep out of the pair ellipsoid, eq. (14), by the Bernstein coefficients of the squared norm of
/// their relative motion in coordinates in which the ellipsoid is the unit sphere, halved where undecided.
class PairProof {
 public:
  /// Semi-axes [m].
  PairProof(double horizontal, double vertical);

  /// True if all points of two boxes are clear of each other.
  bool areApart(const Box& a, const Box& b) const;
  /// `relative`: one UAV's curve minus the other's over [from, to] [m].
  ClearanceFinding prove(const BernsteinPoints<4>& relative, double from, double to);

 private:
  ClearanceFinding proveScaled(const BernsteinPoints<4>& scaled, double from, double to, int depth);

  Vector3 scale_;
  int nodes_ = 0;
};

}  // namespace swarm_planner
