// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/flight_ratios.hpp"

#include <algorithm>
#include <vector>

namespace swarm_planner {
namespace {

std::optional<MeanMax> meanMax(const std::vector<double>& samples) {
  if (samples.empty()) return std::nullopt;
  const Distribution distribution = distributionOf(samples);
  return MeanMax{distribution.mean, distribution.max};
}

}  // namespace

FlightRatios flightRatios(const RunResult& run) {
  std::vector<double> times, paths;
  double longest = 0.0;
  bool all_arrived = true;
  for (std::size_t i = 0; i < std::min(run.bounds.size(), run.flown.flights.size()); ++i) {
    const FlightBound& bound = run.bounds[i];
    const UavFlight& flight = run.flown.flights[i];
    longest = std::max(longest, bound.least_time);
    all_arrived = all_arrived && flight.arrived;
    if (!flight.arrived || bound.least_time == 0.0) continue;
    times.push_back(*flight.arrival_time / bound.least_time);
    if (!bound.shortest_path || *bound.shortest_path == 0.0) continue;
    // Arrived is who comes close: what is left to the end counts, or the flown path would seem too short.
    paths.push_back((flight.path_length + flight.remaining) / *bound.shortest_path);
  }
  FlightRatios ratios{meanMax(times), meanMax(paths), std::nullopt};
  if (all_arrived && longest > 0.0) ratios.mission = run.flown.mission_time / longest;
  return ratios;
}

}  // namespace swarm_planner
