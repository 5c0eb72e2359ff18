// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

// What lies beyond these is a fault of its source (a diverged estimator, a wrong unit, memory that was never written),
// however finite it is. Within them double precision resolves less than a micrometre and no square overflows.

/// Of a position, along each axis [m]: the largest northing of UTM.
constexpr double kMostCoordinate = 1e7;
/// Along each axis [m/s].
constexpr double kMostSpeed = 1e3;
/// Radii of an obstacle [m].
constexpr double kLeastRadius = 1e-4, kMostRadius = 1e6;
/// Exponents of an obstacle: from 100 on its corners are sharper than 1 % of its radii.
constexpr double kMostExponent = 1e3;
/// Standard deviations of a track [m, m/s].
constexpr double kMostSigma = 1e6;
/// Points of a reference path.
constexpr std::size_t kMostPathPoints = 10000;

/// Each component finite and within `most`. False for NaN too.
inline bool isWithin(const Vector3& x, double most) { return (x.array().abs() <= most).all(); }

/// Whether an obstacle can have these radii and exponents. False for NaN too.
inline bool isPlausibleShape(const Vector3& radii, const Vector3& exponents) {
  return (radii.array() >= kLeastRadius && radii.array() <= kMostRadius).all() &&
         (exponents.array() >= 2.0 && exponents.array() <= kMostExponent).all();
}

/// A standard deviation. False for NaN too.
inline bool isPlausibleSigma(double sigma) { return sigma >= 0.0 && sigma <= kMostSigma; }

}  // namespace swarm_planner
