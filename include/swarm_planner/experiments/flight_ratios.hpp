// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>

#include "swarm_planner/experiments/run_result.hpp"

namespace swarm_planner {

/// How much longer than necessary the UAVs of a run flew that arrived and had a way to go. Empty: nobody did, or there
/// is nothing to compare with.
struct FlightRatios {
  std::optional<MeanMax> time;  ///< until arrival over FlightBound::least_time
  std::optional<MeanMax> path;  ///< flown until arrival and straight on to the end, over FlightBound::shortest_path
  /// Mission time over the longest of all FlightBound::least_time, if every UAV arrived.
  std::optional<double> mission;
};

FlightRatios flightRatios(const RunResult& run);

}  // namespace swarm_planner
