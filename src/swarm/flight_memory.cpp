// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/flight_memory.hpp"

#include <algorithm>

#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

void remember(const SwarmPlanner& planner, std::size_t obstacles, FlightMemory& memory) {
  const CycleReport& report = planner.report();
  memory.time_zero = report.time_zero;
  memory.obstacles = obstacles;
  memory.uavs.resize(planner.uavCount());
  for (std::size_t i = 0; i < memory.uavs.size(); ++i) {
    if (!report.uavs[i].planned) continue;
    UavMemory& uav = memory.uavs[i];
    uav.older = uav.newest;
    uav.newest = planner.committed(i);
    uav.motions = std::min(uav.motions + 1, 2);
    uav.progress = planner.progress(i);
    uav.target = planner.target(i, report.epoch).arc_length;
    uav.epoch = report.epoch;
  }
}

}  // namespace swarm_planner
