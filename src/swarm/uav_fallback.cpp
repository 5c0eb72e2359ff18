// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.

// What a UAV flies without a new plan of its own: UavPlanner's part for rests, stops and detours.

#include <limits>

#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/pair_check.hpp"
#include "swarm_planner/swarm/place_beside.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/planner_limits.hpp"
#include "swarm_planner/swarm/right_of_way.hpp"
#include "swarm_planner/swarm/shortfall.hpp"
#include "swarm_planner/swarm/uav_planner.hpp"

namespace swarm_planner {
namespace {

constexpr double kSameShortfall = 1e-3;  // [m s]

}  // namespace

void UavPlanner::goOn(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report) {
  report.overrun = true;
  report.reason = Reason::kOverrun;
  if (record.task.mode == FlightMode::kLanded) {
    record.motions.goOn(epoch);
  } else {
    survey(uav, epoch, record, surroundings);
    record.motions.goOn(epoch);
    kept_ = record.motions.newest();
    const CheckVerdict kept = checkClearance(kept_, kept_.start(), limits_, check_);
    if (!kept.accepted()) report.reason = brake(kept, uav, epoch, record, surroundings);
    publish(uav, epoch, record, surroundings);
  }
  report.planned = record.planned;
  report.state = UavState::kFallback;
}

void UavPlanner::keepClear(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                           UavReport& report) {
  survey(uav, epoch, record, surroundings);
  kept_ = record.motions.flown();
  kept_.moveTo(epoch);
  const CheckVerdict verdict = checkClearance(kept_, kept_.start(), limits_, check_);
  if (!verdict.accepted()) {
    record.start = record.motions.flown().at(epoch);
    record.evades = true;
    const bool has_plan = goTo(kept_.restingPlace(), uav, epoch, record, surroundings, report);
    const Reason reason = has_plan ? Reason::kNone : fallBack(uav, epoch, record, surroundings, report);
    report.reason = isAlarm(reason) ? reason : Reason::kEvadesUnseen;
    publish(uav, epoch, record, surroundings);
  }
  report.planned = record.evades;
}

bool UavPlanner::rest(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings) {
  FlightTask& task = record.task;
  if (task.mode == FlightMode::kLanded) {
    record.motions.goOn(epoch);
    return true;
  }
  if (task.mode != FlightMode::kStopped || !record.planned) return false;
  if (task.is_quickest_stop && !record.motions.newestIsLost()) {
    record.motions.goOn(epoch);
    const CommittedMotion& motion = record.motions.newest();
    return checkClearance(motion, motion.start(), limits_, check_).accepted();
  }
  const KinematicState x = record.motions.flown().at(epoch);
  StopManoeuvre stop;
  planStop(x, problem_.dt, relieveBounds(limits_.bounds, x, kBoundSlack), stop);
  stop_.assignStop(epoch, stop);
  task.is_quickest_stop = stop.within_bounds && surroundings.isWithinArea(uav, stop_) &&
                          checkClearance(stop_, committed_, limits_, check_).accepted();
  if (task.is_quickest_stop) record.motions.commit(stop_);
  return task.is_quickest_stop;
}

Reason UavPlanner::fallBack(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                            UavReport& report) {
  record.motions.goOn(epoch);
  kept_ = record.motions.newest();
  const CheckVerdict kept = checkClearance(kept_, kept_.start(), limits_, check_);
  if (kept.accepted()) return Reason::kPlanRefused;
  if (kept.reason == CheckReason::kRestingPlace && giveWay(kept, uav, epoch, record, surroundings, report)) {
    return Reason::kGivesWayToObstacle;
  }
  return brake(kept, uav, epoch, record, surroundings);
}

bool UavPlanner::goTo(const Vector3& place, std::size_t uav, double epoch, UavRecord& record,
                      const Surroundings& surroundings, UavReport& report) {
  detour_.path.assignLine(record.start.p, place);
  detour_.start = detour_.path.length();
  detour_.speed = 0.0;
  detour_.time_zero = epoch;
  on_detour_ = true;
  const bool accepted = propose(uav, epoch, record, surroundings, report).accepted();
  on_detour_ = false;
  if (accepted) {
    record.motions.commit(motion_);
    record.planned = true;
  }
  return accepted;
}

bool UavPlanner::giveWay(const CheckVerdict& verdict, std::size_t uav, double epoch, UavRecord& record,
                         const Surroundings& surroundings, UavReport& report) {
  const double arrival = epoch + kHorizon * problem_.dt;
  const std::optional<Vector3> place =
      placeBeside(kept_.restingPlace(), static_cast<std::size_t>(verdict.body), arrival, limits_, check_);
  return place && goTo(*place, uav, epoch, record, surroundings, report);
}

Reason UavPlanner::brake(const CheckVerdict& kept, std::size_t uav, double epoch, UavRecord& record,
                         const Surroundings& surroundings) {
  StopManoeuvre stop;
  planStop(record.start, problem_.dt, relieveBounds(limits_.bounds, record.start, kBoundSlack), stop);
  stop_.assignStop(epoch, stop);
  const bool may_stop = surroundings.isWithinArea(uav, stop_);
  if (may_stop && stop.within_bounds && checkClearance(stop_, committed_, limits_, check_).accepted()) {
    record.motions.commit(stop_);
    record.planned = true;
    return Reason::kBraking;
  }

  // Nothing is safe for good. What falls short least flies; among those that do not within the time looked at, the one
  // whose place of rest is safe longest: a later cycle has that much time to find better.
  double least = shortfall(kept_, epoch, limits_, check_);
  double conflict = kept.reason == CheckReason::kRestingPlace ? kept_.epoch() + kept.time : epoch;
  const CommittedMotion* best = &kept_;
  const auto consider = [&](const CommittedMotion& motion, double its_conflict) {
    const double lacking = shortfall(motion, epoch, limits_, check_);
    const bool lasts_longer = lacking < least + kSameShortfall && its_conflict > conflict;
    if (lacking > least - kSameShortfall && !lasts_longer) return;
    least = lacking;
    conflict = its_conflict;
    best = &motion;
  };
  if (has_proposal_) consider(proposed_, proposal_conflict_);
  if (may_stop) consider(stop_, epoch);
  if (best != &kept_) {
    record.motions.commit(*best);
    record.planned = true;
  }
  return least > 0.0 ? Reason::kNoSafePlan : Reason::kUnsafeRest;
}

}  // namespace swarm_planner
