// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// An obstacle as it was seen at `stamp`. Not called ObstacleTrack: catkin puts the message of that name, which the
/// contract fixes, into this same namespace.
struct TrackedObstacle {
  Superellipsoid shape;         ///< centre at `stamp`, planning frame
  double stamp = 0.0;           ///< [s]
  double position_sigma = 0.0;  ///< standard deviation of the centre [m]
  double velocity_sigma = 0.0;  ///< standard deviation of the velocity [m/s]
};

/// How far from where its track predicts it an obstacle may be:
///   I(t) = track_sigmas (position_sigma + velocity_sigma min(t - stamp, track_growth_time)),  t >= stamp.
/// That much is kept clear of beyond its surface, by plans and by their check.
struct TrackInflation {
  double at_stamp = 0.0;     ///< [m]
  double growth_rate = 0.0;  ///< [m/s]
  double growth_time = 0.0;  ///< after the stamp, when growth ends [s]

  /// `age`: time since the stamp [s]; nothing has grown before it. In metres.
  double at(double age) const { return at_stamp + growth_rate * std::clamp(age, 0.0, growth_time); }
};

inline TrackInflation inflationOf(const TrackedObstacle& track, const InputParameters& input) {
  return {input.track_sigmas * track.position_sigma, input.track_sigmas * track.velocity_sigma,
          input.track_growth_time};
}

}  // namespace swarm_planner
