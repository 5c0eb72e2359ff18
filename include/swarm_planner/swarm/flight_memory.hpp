// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

#include "swarm_planner/swarm/committed_motion.hpp"

namespace swarm_planner {

/// What a planner that is gone has left of one UAV.
struct UavMemory {
  int motions = 0;           ///< how many are known: 0, 1 (newest) or 2 (older as well)
  CommittedMotion newest;    ///< may not have reached the vehicle, which then flies `older`
  CommittedMotion older;     ///< the one committed before
  bool on_reference = true;  ///< progress and target are of the reference that holds
  double progress = 0.0;     ///< arc length of its foot on its reference when `newest` was planned [m]
  double target = 0.0;       ///< arc length of its target at the epoch of that plan [m]
  double epoch = 0.0;        ///< of that plan [s]
};

/// What a planner that is gone has left, for one that takes over in flight.
struct FlightMemory {
  double time_zero = 0.0;       ///< epoch of t = 0 of the run [s]
  std::size_t obstacles = 0;    ///< tracks that were in use
  std::vector<UavMemory> uavs;  ///< in the scenario's order
};

class SwarmPlanner;

/// Takes into `memory` what the planner's last cycle has committed. `obstacles`: tracks that were in use.
void remember(const SwarmPlanner& planner, std::size_t obstacles, FlightMemory& memory);

}  // namespace swarm_planner
