// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/uav_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/pair_check.hpp"
#include "swarm_planner/swarm/place_beside.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/planner_limits.hpp"
#include "swarm_planner/swarm/right_of_way.hpp"
#include "swarm_planner/swarm/shortfall.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"

namespace swarm_planner {
namespace {

constexpr double kSamePlace = 1e-6;      // starts closer than this are the same [m, m/s]
constexpr double kSameShortfall = 1e-3;  // [m s]
constexpr double kPassed = 0.5;          // of the way flown per stage at full speed: a sharp corner nearer is passed
constexpr double kStanding = 0.05;       // of max_speed: a slower UAV stands
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Changes of the active set per QP: where a crowd leaves no way, hundreds would go into rows that stay violated. The
/// step as far as it has come is judged by the merit, and the next QP goes on from its active rows.
constexpr int kMostQpChanges = 100;
/// Steps from the motion flown towards the solver's plan.
constexpr std::array<double, 3> kStepsBack{0.5, 0.25, 0.0};

bool areApart(const KinematicState& x, const KinematicState& y) {
  return (x.p - y.p).norm() > kSamePlace || (x.v - y.v).norm() > kSamePlace;
}

}  // namespace

UavPlanner::UavPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
                       std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies)
    : parameters_(parameters),
      limits_(makeCheckLimits(parameters, workspace ? &*workspace : nullptr)),
      workspace_(limits_.bounds.workspace),
      sqp_(std::make_unique<GeneratedSolver>(std::move(tables), kMostQpChanges)) {
  problem_.parameters = &parameters;
  problem_.dt = parameters.time.sampling_time;
  problem_.bounds = solverBounds(limits_.bounds);
  problem_.bodies.reserve(max_bodies);
  check_.obstacles.reserve(max_bodies);
  check_.uavs.reserve(2 * max_bodies);
  detour_.path = ReferencePath({Vector3::Zero(), Vector3::UnitX()});
  plan_.holds_acceleration = shifted_.holds_acceleration = parameters.limits.as_paper;
}

void UavPlanner::plan(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report) {
  const Stopwatch stopwatch;
  survey(uav, epoch, record, surroundings);
  if (rest(uav, epoch, record, surroundings)) {
    poseProblem(uav, epoch, record, surroundings);
  } else {
    report.reason = flyOn(uav, epoch, record, surroundings, report);
  }
  publish(uav, epoch, record, surroundings);
  fillReport(epoch, record, report);
  report.solve_time = stopwatch.elapsed();
}

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

void UavPlanner::survey(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings) {
  surroundings.collect(uav, check_);
  committed_ = record.motions.flown().at(epoch).p;
  has_proposal_ = false;
  flies_whole_plan_ = false;
  on_detour_ = false;
  setWorkspace(record);
  // What is not known of its own place is demanded of its distances.
  const MotionDoubt own = record.doubt(parameters_.input);
  for (OtherMotion& other : check_.uavs) other.doubt = other.doubt.with(own);
  limitDoubts(epoch, record.motions.flown());
}

void UavPlanner::publish(std::size_t uav, double epoch, const UavRecord& record, Surroundings& surroundings) const {
  surroundings.replaceMotions(uav, record.motions.newest(),
                              record.motions.olderInFlight(epoch, parameters_.time.cycle_period));
}

void UavPlanner::setWorkspace(const UavRecord& record) {
  Workspace workspace = workspace_;
  workspace.min.z() = record.task.workspaceFloor(workspace_.min.z(), parameters_.limits.tracking_margin);
  problem_.bounds.workspace = workspace;
  limits_.bounds.workspace = workspace;
  const Box& flown = record.motions.flown().box();
  for (int axis = 0; axis < 3; ++axis) {
    double& low = limits_.bounds.workspace.min[axis];
    double& high = limits_.bounds.workspace.max[axis];
    // Less than the slack is a matter of tracking, and passes anyway.
    if (flown.min[axis] < low - limits_.workspace_slack) low = flown.min[axis];
    if (flown.max[axis] > high + limits_.workspace_slack) high = flown.max[axis];
  }
}

Reason UavPlanner::flyOn(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                         UavReport& report) {
  const KinematicState committed = record.motions.flown().at(epoch);
  record.task.is_quickest_stop = false;
  CheckVerdict verdict = propose(uav, epoch, record, surroundings, report);
  // A start that tracking has moved too close, or measured there: the motion itself is still safe to go on from.
  const bool compensated = parameters_.limits.latency_compensation;
  if (!verdict.accepted() && record.planned && compensated && areApart(record.start, committed)) {
    record.start = committed;
    verdict = propose(uav, epoch, record, surroundings, report);
  }
  if (!verdict.accepted()) return fallBack(uav, epoch, record, surroundings, report);
  record.motions.commit(motion_);
  record.planned = true;
  return report.stays ? Reason::kPlanRefused : Reason::kNone;
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

CheckVerdict UavPlanner::propose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                                 UavReport& report) {
  poseProblem(uav, epoch, record, surroundings);
  if (record.planned) {
    shiftPlan(record.motions.flown(), record.start, epoch, problem_.dt, shifted_);
  } else {
    coastingPlan(record.start, epoch, problem_.dt, shifted_);
  }
  plan_ = shifted_;
  guessActiveRows(epoch, record);
  SqpResult result = sqp_.solve(problem_, plan_, record.active);
  if (!result.solved) plan_ = shifted_;
  if (record.guide.needsFreshStart()) solveAlongGuide(record.active, result);
  keepJerkLimit(record.start);
  record.guide.notePlan(plan_.knots.back().p, problem_);
  report.sqp_iterations += result.iterations;
  report.qp_iterations += result.qp_iterations;
  report.solved = result.solved;

  report.max_slack = result.max_violation;
  const CheckVerdict verdict = judge(uav, surroundings, plan_);
  flies_whole_plan_ = verdict.accepted();
  if (flies_whole_plan_) return verdict;
  report.refusal = verdict.reason;
  const bool is_motion = verdict.reason != CheckReason::kNotFinite && verdict.reason != CheckReason::kDiscontinuous;
  if (is_motion && surroundings.isWithinArea(uav, motion_)) {
    has_proposal_ = true;
    proposed_ = motion_;
    proposal_conflict_ = verdict.reason == CheckReason::kRestingPlace ? epoch + verdict.time : epoch;
  }
  step_ = plan_;
  for (const double length : kStepsBack) {
    for (std::size_t k = 0; k < kHorizon; ++k) {
      step_.jerks[k] = shifted_.jerks[k] + length * (plan_.jerks[k] - shifted_.jerks[k]);
    }
    rollOut(record.start, step_);
    if (!judge(uav, surroundings, step_).accepted()) continue;
    report.stays = length == 0.0;
    return {};
  }
  return verdict;
}

void UavPlanner::keepJerkLimit(const KinematicState& start) {
  const double share = shareWithinJerk(shifted_, plan_, limits_.bounds.max_jerk);
  if (share >= 1.0) return;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    plan_.jerks[k] = shifted_.jerks[k] + share * (plan_.jerks[k] - shifted_.jerks[k]);
  }
  rollOut(start, plan_);
}

void UavPlanner::solveAlongGuide(ActiveRows& active, SqpResult& result) {
  along_ = shifted_;
  along_active_.count = 0;
  std::swap(problem_.bodies, no_bodies_);
  const SqpResult alone = sqp_.solve(problem_, along_, along_active_);
  std::swap(problem_.bodies, no_bodies_);
  along_active_.count = 0;
  SqpResult other = sqp_.solve(problem_, along_, along_active_);
  const int iterations = result.iterations + alone.iterations + other.iterations;
  const int qp_iterations = result.qp_iterations + alone.qp_iterations + other.qp_iterations;
  if (other.solved && (!result.solved || other.merit < result.merit)) {
    plan_ = along_;
    active = along_active_;
    result = other;
  }
  result.iterations = iterations;
  result.qp_iterations = qp_iterations;
}

void UavPlanner::limitDoubts(double epoch, const CommittedMotion& flown) {
  bool is_kept = false;
  for (OtherMotion& other : check_.uavs) {
    if (other.doubt.isNone()) continue;
    if (!is_kept) {
      kept_ = flown;
      kept_.dropPieces(kept_.endedPieces(epoch));
      is_kept = true;
    }
    other.doubt = other.doubt.times(bearableShare(kept_, other, limits_));
  }
}

CheckVerdict UavPlanner::judge(std::size_t uav, const Surroundings& surroundings, const Trajectory& plan) {
  if (!parameters_.limits.plan_check) {
    StopManoeuvre stop;
    planStop(plan.knots.back(), plan.dt, limits_.bounds, stop);
    motion_.assign(plan, stop);
    return {};
  }
  CheckVerdict verdict = checkPlan(plan, plan.knots.front(), committed_, limits_, check_, motion_);
  if (verdict.accepted() && !surroundings.isWithinArea(uav, motion_)) verdict.reason = CheckReason::kOutOfArea;
  return verdict;
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

void UavPlanner::fillReport(double epoch, const UavRecord& record, UavReport& report) {
  if (!flies_whole_plan_) {
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      plan_.knots[k] = record.motions.newest().at(epoch + static_cast<double>(k) * problem_.dt);
    }
    report.max_slack = planViolation(problem_, plan_).largest;
  }
  const PredictedClearance clearance = predictedClearance(problem_, plan_);
  report.obstacle_clearance = clearance.obstacle;
  report.pair_distance = clearance.pair;
  report.planned = record.planned;
  report.deviation = record.deviation.norm();
  report.lag = lag_;
  const bool rests = record.task.mode == FlightMode::kLanded || record.task.is_quickest_stop;
  if (report.reason == Reason::kNone && !report.solved && !rests) report.reason = Reason::kSolverFailed;
  const bool on_new_plan = report.reason == Reason::kNone;
  const bool gives_way = report.reason == Reason::kGivesWayToObstacle;
  if (on_new_plan && record.deviation.norm() > parameters_.limits.tracking_margin) report.reason = Reason::kStraying;
  if (on_new_plan && record.following.isNotFollowing()) report.reason = Reason::kNotFollowing;
  if (on_new_plan && record.off_plan) {
    report.reason = Reason::kOffPlan;
    report.deviation = record.off_plan_distance;
  }
  report.state = on_new_plan || gives_way ? UavState::kTracking : UavState::kFallback;
  reportTraffic(record.traffic, report);
  const bool is_slow = record.start.v.norm() < kStanding * parameters_.limits.max_speed;
  const bool stands = record.task.mode == FlightMode::kFlying && is_slow;
  if (report.reason == Reason::kNone && stands) report.reason = record.guide.reasonToStand();
  reportTask(record.task, report);
}

void UavPlanner::guessActiveRows(double epoch, UavRecord& record) const {
  const double stages = std::round((epoch - record.active_epoch) / problem_.dt);
  if (stages >= 0.0 && stages < kHorizon) {
    record.active.shift(static_cast<int>(stages));
  } else {
    record.active.count = 0;
  }
  record.active_epoch = epoch;
}

void UavPlanner::poseProblem(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings) {
  double detour_progress = 0.0;
  bool on_detour_path = true;
  const auto [target, on_path, progress] =
      on_detour_ ? FollowedTarget{detour_, on_detour_path, detour_progress} : followedTarget(record);
  const double full_speed = parameters_.limits.max_speed;
  progress = on_path ? target.path.advance(record.start.p, progress, kPassed * full_speed * problem_.dt)
                     : target.path.nearest(record.start.p, 0.0, kInfinity).arc_length;
  on_path = true;
  problem_.epoch = epoch;
  problem_.start = record.start;
  problem_.path = &target.path;
  problem_.progress = progress;
  problem_.targets = previewTargets(target, progress, full_speed, epoch, problem_.dt);
  const bool off_mission = record.task.mode == FlightMode::kFlying && (on_detour_ || record.traffic.gives_way);
  lag_ = off_mission ? record.reference.at(epoch).arc_length - record.progress : target.at(epoch).arc_length - progress;
  if (!on_detour_) record.guide.setFollowed(target);
  problem_.is_guided = !on_detour_ && record.guide.active();
  if (problem_.is_guided) record.guide.pose(target, progress, problem_);
  surroundings.collect(uav, problem_);
}

}  // namespace swarm_planner
