// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "swarm_planner/config/fault_injection.hpp"

namespace swarm_planner {

/// What became of the injected faults of one kind.
struct FaultTally {
  FaultKind kind = FaultKind::kOdometryLost;
  std::size_t injected = 0;
  std::size_t noticeable = 0;  ///< had to be reported, see FaultWatch
  std::size_t reported = 0;    ///< of the noticeable ones
  double report_delay = 0.0;   ///< longest, from the fault's beginning to the first report [s]
  std::size_t recovered = 0;   ///< all UAVs concerned flew again before the run ended
  double recovery_time = 0.0;  ///< longest, from the fault's end until they did [s]
};

/// A fault that had to be reported and was not, or that a UAV did not recover from in time.
struct FaultMiss {
  FaultKind kind = FaultKind::kOdometryLost;
  double time = 0.0;  ///< of the fault's beginning [s]
  std::string uav;    ///< empty: the whole swarm
  bool unreported = false;
  double recovery_time = 0.0;  ///< [s]; infinite: never
};

struct FaultSummary {
  std::vector<FaultTally> kinds;  ///< those that were injected
  std::vector<FaultMiss> misses;  ///< by time
  double recovery_time = 0.0;     ///< longest of all [s]
  std::size_t waited = 0;         ///< UAVs that waited for an obstacle when they could have flown again
};

/// What else is told of a rehearsal.
struct RehearsalSummary {
  std::size_t goals_reached = 0;
  std::size_t goals_abandoned = 0;  ///< not reached in time
  std::size_t fewest_reached = 0;   ///< by one UAV
  double resident_at_begin = 0.0;   ///< memory of the process once the run is well under way [MB]
  double resident_at_end = 0.0;     ///< after the last cycle [MB]
};

}  // namespace swarm_planner
