// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>

#include "swarm_planner/config/parameters.hpp"

namespace swarm_planner {

/// Gauge of the ellipsoid that two UAVs must keep clear of, eq. (14) with a vertical semi-axis of its own:
/// sqrt((d_xy / pair_distance)^2 + (d_z / pair_distance_vertical)^2). Below 1: too close.
/// `d`: one centre minus the other [m]; both semi-axes [m] > 0.
inline double pairGauge(const Vector3& d, double pair_distance, double pair_distance_vertical) {
  const double x = d.x() / pair_distance;
  const double y = d.y() / pair_distance;
  const double z = d.z() / pair_distance_vertical;
  return std::sqrt(x * x + y * y + z * z);
}

/// The same with the distances of `limits` (without tracking_margin: the distances that are measured).
inline double pairGauge(const Vector3& d, const LimitParameters& limits) {
  return pairGauge(d, limits.pair_distance, limits.pair_distance_vertical);
}

}  // namespace swarm_planner
