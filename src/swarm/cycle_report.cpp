// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/cycle_report.hpp"

#include <algorithm>
#include <string>

namespace swarm_planner {

bool isCommanded(Reason reason) {
  switch (reason) {
    case Reason::kHeld:
    case Reason::kBrakesToLand:
    case Reason::kFliesToLandingSite:
    case Reason::kDescending:
    case Reason::kLanded:
    case Reason::kStopped:
    case Reason::kForeign:
      return true;
    default:
      return false;
  }
}

bool isTraffic(Reason reason) {
  return reason == Reason::kGivesWay || reason == Reason::kWaits || reason == Reason::kParked;
}

bool isAlarm(Reason reason) { return reason == Reason::kNoSafePlan; }

const char* reasonText(Reason reason) {
  switch (reason) {
    case Reason::kNone:
      return "";
    case Reason::kWaitingForOdometry:
      return "no odometry has arrived yet";
    case Reason::kWaitingForOthers:
      return "waiting for the odometry of other UAVs";
    case Reason::kWaitingForStart:
      return "waiting for the start command";
    case Reason::kOdometryStale:
      return "odometry is too old";
    case Reason::kOdometryFromFuture:
      return "odometry is stamped in the future";
    case Reason::kOdometryNotFinite:
      return "odometry is not finite or absurdly large";
    case Reason::kSolverFailed:
      return "the solver gave no plan; the last one goes on";
    case Reason::kPlanRefused:
      return "the plan did not pass the check; the last one goes on";
    case Reason::kBraking:
      return "no plan passed the check; braking";
    case Reason::kUnsafeRest:
      return "an obstacle will come to where it can rest";
    case Reason::kNoSafePlan:
      return "no plan keeps all distances; flying the least violating one";
    case Reason::kOverrun:
      return "no time left to plan; the last plan goes on";
    case Reason::kStraying:
      return "strays from its plan by more than tracking_margin";
    case Reason::kOdometryFrozen:
      return "odometry is frozen: its position stays the same while the UAV is to move";
    case Reason::kOdometryJumps:
      return "odometry jumps: no flight leads from one position to the next";
    case Reason::kOdometryBackwards:
      return "the stamps of odometry go back";
    case Reason::kOdometryDrifts:
      return "odometry drifts: its position does not follow its velocity";
    case Reason::kOffPlan:
      return "far off its plan; planned anew from where it is";
    case Reason::kForeign:
      return "flown by another system";
    case Reason::kNoLandingSite:
      return "cannot land: no free landing site within reach; holds and looks again";
    case Reason::kHeld:
      return "holds by command";
    case Reason::kBrakesToLand:
      return "lands by command: brakes";
    case Reason::kFliesToLandingSite:
      return "lands by command: flies to above its landing site";
    case Reason::kDescending:
      return "lands by command: descends";
    case Reason::kLanded:
      return "landed";
    case Reason::kStopped:
      return "stopped by command";
    case Reason::kTakingOver:
      return "in flight when the planner started; its last trajectory goes on until all inputs are known";
    case Reason::kNotFollowing:
      return "does not follow its setpoints; planned from where it is";
    case Reason::kGivesWayToObstacle:
      return "gives way: an obstacle will come to where it could rest";
    case Reason::kEvadesUnseen:
      return "without odometry, and its motion is not clear any more; flies a new one from where it should be";
    case Reason::kNoWayRound:
      return "its way is blocked and no way round is found; waits and looks again";
    case Reason::kEndNotClear:
      return "the end of its way is not clear; waits as near as is safe";
    case Reason::kGivesWay:
      return "gives way to";
    case Reason::kWaits:
      return "waits behind";
    case Reason::kParked:
      return "parked beside its end, which is taken by";
    case Reason::kOffMotion:
      return "is off its motion by more than noise explains: was pushed, or does not follow";
  }
  return "unknown reason";
}

std::string explainReason(Reason reason, CheckReason refusal) {
  std::string text = reasonText(reason);
  const bool refused = reason == Reason::kPlanRefused || reason == Reason::kBraking || reason == Reason::kNoSafePlan;
  if (!refused || refusal == CheckReason::kAccepted) return text;
  // "what happened; what flies": the cause belongs to the first.
  const std::size_t end = std::min(text.find(';'), text.size());
  return text.insert(end, std::string(" (") + checkReasonText(refusal) + ")");
}

const char* stateText(UavState state) {
  switch (state) {
    case UavState::kTracking:
      return "tracking";
    case UavState::kHolding:
      return "holding";
    case UavState::kFallback:
      return "fallback";
    case UavState::kLost:
      return "lost";
    case UavState::kLanding:
      return "landing";
    case UavState::kStopped:
      return "stopped";
  }
  return "unknown state";
}

}  // namespace swarm_planner
