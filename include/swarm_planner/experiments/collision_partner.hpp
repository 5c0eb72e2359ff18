// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "swarm_planner/simulation/run_monitor.hpp"

namespace swarm_planner {

/// What a UAV came too close to, as reports call it: the other UAV's name, or "obstacle 3" by its id, or "the map".
inline std::string collisionPartner(const Collision& collision, const Scenario& scenario) {
  if (!collision.with_obstacle) return scenario.uavs[collision.partner].name;
  if (collision.partner == kMapPartner) return "the map";
  return "obstacle " + std::to_string(scenario.obstacles[collision.partner].id);
}

}  // namespace swarm_planner
