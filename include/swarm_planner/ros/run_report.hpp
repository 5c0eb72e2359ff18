// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <string>

#include "swarm_planner/simulation/run_monitor.hpp"

namespace swarm_planner {

/// A finished run as seen by the simulation node: what the vehicles did, and the cycle times that the planner reported.
struct RunReport {
  std::string scenario;
  std::size_t uavs = 0;
  std::string ended_by;  ///< "scenario", "timeout" (of all_at_goal), "duration" or "interrupt"
  RunSummary summary;
  std::uint64_t cycles = 0;
  double cycle_time_mean = 0.0;  ///< [s]
  double cycle_time_max = 0.0;   ///< [s]
  std::uint32_t deadline_misses = 0;

  /// Every UAV kept clear until the run's end: the exit status of a run.
  bool clear() const { return summary.collisions.empty() && ended_by != "interrupt"; }
};

/// A few lines for people.
std::string toText(const RunReport& report);

/// One line of JSON, keys as in the experiment program's, with "clear" and "ended_by". Minima without a partner are
/// null.
std::string toJson(const RunReport& report);

}  // namespace swarm_planner
