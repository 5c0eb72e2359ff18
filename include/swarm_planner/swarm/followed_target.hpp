// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/swarm/flight_task.hpp"

namespace swarm_planner {

/// What a UAV follows in this cycle, and how far along it is.
struct FollowedTarget {
  const MovingTarget& target;
  const double& progress;  ///< arc length of the UAV's foot [m]
};

/// Whether a guide may lead a UAV: on the ground and in descent nothing but what was asked for will do, and who brakes
/// or holds is where it is to be.
inline bool isGuidable(const FlightTask& task) {
  const bool approaches = task.mode == FlightMode::kLanding && task.phase == LandingPhase::kApproach;
  return task.mode == FlightMode::kFlying || approaches;
}

}  // namespace swarm_planner
