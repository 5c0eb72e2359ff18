// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/obstacles/exponent.hpp"

namespace swarm_planner {

/// Value and gradient of the gauge at a point.
struct Gauge {
  double value = 0.0;                  ///< phi, 1 on the surface, below 1 inside
  Vector3 gradient = Vector3::Zero();  ///< [1/m], planning frame
};

/// A superellipsoid |x/a|^px + |y/b|^py + |z/c|^pz <= 1 with yaw about its centre, constant velocity,
/// eq. (7), any real exponents >= 2 (convex). Points are given in the planning frame.
class Superellipsoid {
 public:
  Superellipsoid() = default;
  /// `center` [m], `radii` [m] > 0, `exponents` >= 2, `yaw` [rad], `velocity` [m/s]; all finite.
  /// Throws std::invalid_argument otherwise.
  Superellipsoid(int id, const Vector3& center, const Vector3& radii, const Vector3& exponents, double yaw,
                 const Vector3& velocity);

  int id() const { return id_; }
  const Vector3& center() const { return center_; }
  const Vector3& velocity() const { return velocity_; }
  const Vector3& radii() const { return radii_; }
  const Vector3& exponents() const { return exponents_; }
  double yaw() const { return yaw_; }
  /// Half extents of an axis-aligned box about the centre that contains the body [m]; the smallest one if yaw is a
  /// multiple of pi/2 or p_x = p_y, at most that of the rotated box otherwise.
  const Vector3& halfExtents() const { return half_extents_; }
  /// Radius of a sphere about the centre that contains the body [m]; the smallest one if all exponents are equal.
  double boundingRadius() const { return bounding_radius_; }

  /// The same body moved by `dt` seconds at its velocity.
  Superellipsoid movedBy(double dt) const;

  /// The body that the surface S = `level` >= 1 of this one encloses: |x / (level^(1/px) a)|^px and so on.
  Superellipsoid atLevel(double level) const;

  /// The body with all radii longer by `distance` [m]. Nearly everything within that distance of this one is in it; not
  /// all, where a flank is flat and the rest is not (doc/equations.md).
  Superellipsoid grownBy(double distance) const;

  /// S of (7), the sum inside the logarithm, |.|^p term by term. `u`: point minus centre [m].
  /// Infinite where it exceeds the range of double (far away with large exponents).
  double sum(const Vector3& u) const;
  /// S with gradient [1/m] and Hessian [1/m^2] in the planning frame; they are finite where S < 1e100.
  double sum(const Vector3& u, Vector3& gradient, Matrix3& hessian) const;

  /// Minkowski gauge phi(u) = min { s > 0 : S(u / s) <= level }, level = e^eps_s >= 1: convex and positively
  /// homogeneous, so phi(u0) + gradient . (u - u0) >= 1 lies wholly outside S < level. At the centre, where phi has
  /// a kink, the gradient is the subgradient that leads out by the shortest axis.
  Gauge gauge(const Vector3& u, double level = 1.0) const;

  /// Distance from a point to the surface S = 1 [m]; exact outside (to about 1e-9 relative), negative
  /// inside (there a first-order depth: minus the distance to the supporting plane met radially).
  double signedDistance(const Vector3& point) const;
  /// The same, with the unit vector along which it grows.
  double signedDistance(const Vector3& point, Vector3& normal) const;
  /// At most the distance from a point to the surface, at the price of a few operations: the distance to the
  /// bounding box [m], 0 inside it.
  double distanceLowerBound(const Vector3& point) const;

 private:
  /// How the gauge is found; in order of preference.
  enum class Shape { kEllipsoid, kEqualExponents, kSmallIntegers, kGeneral };

  Vector3 toBody(const Vector3& u) const;
  Vector3 toWorld(const Vector3& u) const;
  /// The gauge's value and gradient in the body frame.
  Gauge bodyGauge(const Vector3& body, double level) const;
  Gauge gaugeAtCenter(double level) const;
  /// All exponents 2; `squared_norm` of the offset over the radii.
  Gauge ellipsoidGauge(const Vector3& body, double squared_norm, double level) const;

  int id_ = 0;
  Vector3 center_ = Vector3::Zero();
  Vector3 radii_ = Vector3::Ones();
  Vector3 inverse_radii_ = Vector3::Ones();
  Vector3 exponents_ = Vector3::Constant(2.0);
  std::array<Exponent, 3> powers_;
  Shape shape_ = Shape::kEllipsoid;
  double yaw_ = 0.0, cos_yaw_ = 1.0, sin_yaw_ = 0.0;
  Vector3 velocity_ = Vector3::Zero();
  Vector3 half_extents_ = Vector3::Ones();
  double bounding_radius_ = 1.0;
};

}  // namespace swarm_planner
