// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/swarm/flight_task.hpp"

namespace swarm_planner {

struct UavRecord;

/// What a UAV follows in this cycle: its mission, the place aside where it gives way, or where its mode
/// takes it.
struct FollowedTarget {
  const MovingTarget& target;
  bool& on_path;     ///< `progress` holds
  double& progress;  ///< arc length of the foot of the last start [m]
};
FollowedTarget followedTarget(UavRecord& record);

/// Whether a guide may lead a UAV: on the ground and in descent nothing but what was asked for will do, and who brakes
/// or holds is where it is to be.
inline bool isGuidable(const FlightTask& task) {
  const bool approaches = task.mode == FlightMode::kLanding && task.phase == LandingPhase::kApproach;
  return task.mode == FlightMode::kFlying || approaches;
}

}  // namespace swarm_planner
