// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Bernstein control points of a polynomial curve of degree N - 1 over [0, 1]: the curve lies in their convex hull.
template <std::size_t N>
using BernsteinPoints = std::array<Vector3, N>;

/// The two halves of a curve (de Casteljau).
template <std::size_t N>
void halve(const BernsteinPoints<N>& points, BernsteinPoints<N>& left, BernsteinPoints<N>& right) {
  right = points;
  for (std::size_t level = 0; level < N; ++level) {
    left[level] = right[0];
    for (std::size_t i = 0; i + level + 1 < N; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
}

/// The part of a curve over [begin, end], which may reach beyond [0, 1]: control point i is the curve's blossom at
/// i times `end` and `begin` for the rest.
template <std::size_t N>
BernsteinPoints<N> subcurve(const BernsteinPoints<N>& points, double begin, double end) {
  BernsteinPoints<N> part;
  for (std::size_t i = 0; i < N; ++i) {
    BernsteinPoints<N> blossom = points;
    for (std::size_t level = 1; level < N; ++level) {
      const double t = level <= i ? end : begin;
      for (std::size_t k = 0; k + level < N; ++k) blossom[k] += t * (blossom[k + 1] - blossom[k]);
    }
    part[i] = blossom[0];
  }
  return part;
}

/// Point of a cubic at the middle of its interval.
inline Vector3 curveMiddle(const BernsteinPoints<4>& p) { return 0.125 * (p[0] + p[3]) + 0.375 * (p[1] + p[2]); }
inline Vector3 curveMiddle(const BernsteinPoints<3>& p) { return 0.25 * (p[0] + p[2]) + 0.5 * p[1]; }

/// Upper bound of the squared norm along a quadratic: the largest of its five Bernstein coefficients.
inline double greatestSquaredNorm(const BernsteinPoints<3>& p) {
  const double middle = (p[0].dot(p[2]) + 2.0 * p[1].squaredNorm()) / 3.0;
  return std::max({p[0].squaredNorm(), p[0].dot(p[1]), middle, p[1].dot(p[2]), p[2].squaredNorm()});
}

/// Lower bound of the squared norm along a cubic: the least of its seven Bernstein coefficients.
inline double leastSquaredNorm(const BernsteinPoints<4>& p) {
  const double second = 0.4 * p[0].dot(p[2]) + 0.6 * p[1].squaredNorm();
  const double third = 0.1 * p[0].dot(p[3]) + 0.9 * p[1].dot(p[2]);
  const double fourth = 0.4 * p[1].dot(p[3]) + 0.6 * p[2].squaredNorm();
  return std::min({p[0].squaredNorm(), p[0].dot(p[1]), second, third, fourth, p[2].dot(p[3]), p[3].squaredNorm()});
}

}  // namespace swarm_planner
