// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <vector>

#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// What a UAV's flight is measured against: how well it could have done alone.
struct FlightBound {
  /// From rest at its start to rest at its reference's end, straight and as fast as its limits allow [s].
  double least_time = 0.0;
  /// Length of the shortest path around the obstacles that stand still [m]; empty if it was not asked for, or if there
  /// is none.
  std::optional<double> shortest_path;
};

/// Time from rest to rest over `way` [m] in a straight line: max_speed, max_acceleration and the greatest thrust, which
/// limits acceleration along the way and against it; neither drag nor the limit of jerk.
double leastTime(const Vector3& way, const Parameters& parameters);

/// Of every UAV; shortest paths only if `with_paths`: they take up to seconds each. A path leads from corner to corner
/// of the UAV's reference, those left out where no UAV can be.
std::vector<FlightBound> flightBounds(const Mission& mission, bool with_paths);

}  // namespace swarm_planner
