// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/flight_task.hpp"

#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {
namespace {

Reason reasonOf(const FlightTask& task) {
  switch (task.mode) {
    case FlightMode::kWaiting:
      return Reason::kWaitingForStart;
    case FlightMode::kFlying:
      break;
    case FlightMode::kHolding:
      return Reason::kHeld;
    case FlightMode::kLanding:
      if (task.phase == LandingPhase::kBraking)
        return task.has_no_site ? Reason::kNoLandingSite : Reason::kBrakesToLand;
      return task.phase == LandingPhase::kApproach ? Reason::kFliesToLandingSite : Reason::kDescending;
    case FlightMode::kLanded:
      return Reason::kLanded;
    case FlightMode::kStopped:
      return Reason::kStopped;
    case FlightMode::kAbsent:
      return Reason::kForeign;
  }
  return Reason::kNone;
}

}  // namespace

void reportTask(const FlightTask& task, UavReport& report) {
  if (task.mode == FlightMode::kFlying) return;
  if (report.reason == Reason::kNone) report.reason = reasonOf(task);
  if (!isPlannedFor(task.mode) || task.mode == FlightMode::kHolding) {
    report.state = UavState::kHolding;
  } else {
    report.state = task.mode == FlightMode::kLanding ? UavState::kLanding : UavState::kStopped;
  }
}

}  // namespace swarm_planner
