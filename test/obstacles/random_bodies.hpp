// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>

#include "support/random.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// Exponents of the kinds that take different paths through the code: all equal, small integers, reals, extreme.
inline Vector3 randomExponents(Random& random) {
  switch (random.integer(0, 5)) {
    case 0:
      return Vector3::Constant(2.0);
    case 1:
      return Vector3::Constant(random.integer(2, 12));
    case 2:
      return Vector3(2.0, 2.0, random.integer(3, 12));
    case 3:
      return Vector3(random.integer(2, 10), random.integer(2, 10), random.integer(2, 33));
    case 4:
      return random.vector(2.0, 10.0);
    default: {
      const double p_x = random.logUniform(2.0, 1000.0);
      const double p_y = random.logUniform(2.0, 1000.0);
      return Vector3(p_x, p_y, 1000.0);
    }
  }
}

/// A body with radii of `least` to `most` metres, any yaw.
inline Superellipsoid randomBody(Random& random, double least, double most) {
  Vector3 radii;
  for (int i = 0; i < 3; ++i) radii[i] = random.logUniform(least, most);
  const Vector3 center = random.vector(-10.0, 10.0);
  const double yaw = random.uniform(-M_PI, M_PI);
  return Superellipsoid(1, center, radii, randomExponents(random), yaw, random.vector(-3.0, 3.0));
}

/// A point relative to the centre with a given gauge, in a random direction that favours no axis of the body.
inline Vector3 randomOffset(Random& random, const Superellipsoid& body, double gauge) {
  const Vector3 scaled = random.direction().cwiseProduct(body.radii());
  const double c = std::cos(body.yaw());
  const double s = std::sin(body.yaw());
  const Vector3 u(c * scaled.x() - s * scaled.y(), s * scaled.x() + c * scaled.y(), scaled.z());
  return u * (gauge / body.gauge(u).value);
}

}  // namespace swarm_planner
