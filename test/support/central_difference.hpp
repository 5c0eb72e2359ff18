// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>
#include <limits>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Best step of a central difference relative to the scale on which the function changes: cbrt(epsilon). The
/// difference is then off by about its square, 4e-11, relative to the function's third derivative and value.
inline double differenceStep() { return std::cbrt(std::numeric_limits<double>::epsilon()); }

/// Gradient of `f` : R^3 -> R at `x`; `scale` is the length on which f changes [m].
template <typename Function>
Vector3 centralGradient(const Function& f, const Vector3& x, double scale) {
  const double h = differenceStep() * scale;
  Vector3 gradient;
  for (int i = 0; i < 3; ++i) {
    Vector3 forward = x;
    Vector3 backward = x;
    forward[i] += h;
    backward[i] -= h;
    gradient[i] = (f(forward) - f(backward)) / (forward[i] - backward[i]);
  }
  return gradient;
}

/// Jacobian of `f` : R^3 -> R^3 at `x`, row by output.
template <typename Function>
Matrix3 centralJacobian(const Function& f, const Vector3& x, double scale) {
  const double h = differenceStep() * scale;
  Matrix3 jacobian;
  for (int i = 0; i < 3; ++i) {
    Vector3 forward = x;
    Vector3 backward = x;
    forward[i] += h;
    backward[i] -= h;
    const Vector3 difference = f(forward) - f(backward);
    jacobian.col(i) = difference / (forward[i] - backward[i]);
  }
  return jacobian;
}

}  // namespace swarm_planner
