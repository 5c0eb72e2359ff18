// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Value and gradient of the gauge at a point.
struct Gauge {
  double value = 0.0;                   ///< phi, 1 on the surface, below 1 inside
  Vector3 gradient = Vector3::Zero();   ///< [1/m], planning frame
};

/// A superellipsoid |x/a|^px + |y/b|^py + |z/c|^pz <= 1 with yaw about its centre, constant velocity,
/// eq. (7), any real exponents >= 2 (convex). Points are given in the planning frame.
class Superellipsoid {
 public:
  Superellipsoid() = default;
  /// `center` [m], `radii` [m] > 0, `exponents` >= 2, `yaw` [rad], `velocity` [m/s]; arguments must be finite.
  Superellipsoid(int id, const Vector3& center, const Vector3& radii, const Vector3& exponents, double yaw,
                 const Vector3& velocity);

  int id() const { return id_; }
  const Vector3& center() const { return center_; }
  const Vector3& velocity() const { return velocity_; }
  const Vector3& radii() const { return radii_; }
  const Vector3& exponents() const { return exponents_; }
  double yaw() const { return yaw_; }
  /// Half extents of the axis-aligned bounding box about the centre [m].
  const Vector3& halfExtents() const { return half_extents_; }
  double boundingRadius() const { return bounding_radius_; }

  /// The same body moved by `dt` seconds at its velocity.
  Superellipsoid movedBy(double dt) const;

  /// S of (7), the sum inside the logarithm. `u`: point minus centre [m].
  double sum(const Vector3& u) const;
  /// S with gradient and Hessian in the planning frame. [1/m], [1/m^2]
  double sum(const Vector3& u, Vector3& gradient, Matrix3& hessian) const;

  /// Minkowski gauge phi(u) = min { s > 0 : S(u / s) <= level }, `u` != 0, level = e^eps_s >= 1.
  Gauge gauge(const Vector3& u, double level = 1.0) const;

  /// Distance from a point to the surface S = 1 [m]; exact outside (to about 1e-9 relative), negative
  /// inside (there a first-order depth: minus the distance to the supporting plane met radially).
  double signedDistance(const Vector3& point) const;

 private:
  Vector3 toBody(const Vector3& u) const;
  Vector3 toWorld(const Vector3& u) const;

  int id_ = 0;
  Vector3 center_ = Vector3::Zero();
  Vector3 radii_ = Vector3::Ones();
  Vector3 exponents_ = Vector3::Constant(2.0);
  double yaw_ = 0.0, cos_yaw_ = 1.0, sin_yaw_ = 0.0;
  Vector3 velocity_ = Vector3::Zero();
  Vector3 half_extents_ = Vector3::Ones();
  double bounding_radius_ = 1.0;
};

}  // namespace swarm_planner
