// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// Distance [m] from a point outside, given in the body frame, to the body sum_i |y_i / r_i|^p_i <= 1.
/// `gauge`: value > 1 and gradient of the body's gauge at the point, in the body frame.
///
/// Solves the conditions of Karush, Kuhn and Tucker y_i + lambda dS/dy_i = |x_i| per axis, monotone in y_i, within
/// a safeguarded Newton iteration for S(y(lambda)) = 1, monotone in lambda. The value returned is that of the dual
/// function at lambda: never above the distance (but for rounding), and off by the square of lambda's error only.
/// `offset`: from the closest point to `point`, in the body frame [m].
double bodyDistance(const Vector3& point, const Vector3& radii, const Vector3& exponents, const Gauge& gauge,
                    Vector3& offset);

}  // namespace swarm_planner
