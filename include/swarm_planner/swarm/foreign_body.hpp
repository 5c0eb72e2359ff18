// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// A UAV that another system flies, as what the others keep clear of: an obstacle whose surface, moved out by
/// uav_radius
/// + tracking_error, contains the pair ellipsoid grown by tracking_error. (Moved out, an ellipsoid contains the one
/// with semi-axes longer by that much.)
struct ForeignBody {
  Superellipsoid shape;  ///< its centre at `stamp`
  double stamp = 0.0;    ///< [s]
  TrackInflation inflation;
};

/// A UAV that is seen: goes on as measured, at constant velocity, in doubt by odometry_noise at the stamp and by
/// lost_growth_rate more for every second after it, up to lost_growth_limit. `uav`: its index.
ForeignBody seenForeign(std::size_t uav, const UavMeasurement& measurement, const Parameters& parameters);

/// One that is not seen any more: stands for good where the last measurement puts it odometry_timeout later, and grows
/// from that measurement on by its speed and lost_growth_rate, up to lost_growth_limit.
ForeignBody unseenForeign(std::size_t uav, const UavMeasurement& last, const Parameters& parameters);

}  // namespace swarm_planner
