// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/uav_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/pair_check.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/shortfall.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"

namespace swarm_planner {
namespace {

constexpr double kBoundSlack = 0.1;      // of a bound, by which a measured start may exceed it
constexpr double kReserve = 0.002;       // of the bounds, that the solver stays inside
constexpr double kSamePlace = 1e-6;      // starts closer than this are the same [m, m/s]
constexpr double kSameShortfall = 1e-3;  // [m s]
constexpr double kPassed = 0.5;          // of the way flown per stage at full speed: a sharp corner nearer is passed
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Steps from the motion flown towards the solver's plan.
constexpr std::array<double, 3> kStepsBack{0.5, 0.25, 0.0};

CheckLimits makeCheckLimits(const Parameters& parameters, const Workspace* workspace) {
  const LimitParameters& distances = parameters.limits;
  CheckLimits limits;
  limits.bounds = FlightBounds(parameters, workspace);
  limits.bound_slack = kBoundSlack;
  limits.workspace_slack = distances.tracking_margin;
  limits.pair_horizontal = distances.pair_distance + 2.0 * distances.tracking_error;
  limits.pair_vertical = distances.pair_distance_vertical + 2.0 * distances.tracking_error;
  return limits;
}

/// Bounds for the solver, which keeps tangents to them at the samples: a little inside of what the check demands.
FlightBounds reserved(FlightBounds bounds) {
  bounds.max_speed *= 1.0 - kReserve;
  bounds.max_acceleration *= 1.0 - kReserve;
  bounds.max_thrust_acceleration *= 1.0 - kReserve;
  bounds.min_vertical_thrust += kReserve * bounds.gravity.z();
  return bounds;
}

bool areApart(const KinematicState& x, const KinematicState& y) {
  return (x.p - y.p).norm() > kSamePlace || (x.v - y.v).norm() > kSamePlace;
}

}  // namespace

UavPlanner::UavPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
                       std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies)
    : parameters_(parameters),
      limits_(makeCheckLimits(parameters, workspace ? &*workspace : nullptr)),
      workspace_(limits_.bounds.workspace),
      sqp_(std::make_unique<GeneratedSolver>(std::move(tables))) {
  problem_.parameters = &parameters;
  problem_.dt = parameters.time.sampling_time;
  problem_.bounds = reserved(limits_.bounds);
  problem_.bodies.reserve(max_bodies);
  check_.obstacles.reserve(max_bodies);
  check_.uavs.reserve(2 * max_bodies);
}

void UavPlanner::plan(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report) {
  const Stopwatch stopwatch;
  if (begin(uav, epoch, record, surroundings, report)) {
    report.reason = flyOn(uav, epoch, record, surroundings, nullptr, report);
    conclude(uav, epoch, record, surroundings, report);
  }
  report.solve_time = stopwatch.elapsed();
}

bool UavPlanner::begin(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                       UavReport& report) {
  lookAround(uav, epoch, record, surroundings);
  if (!rest(uav, epoch, record, surroundings)) return true;
  poseProblem(uav, epoch, record, surroundings);
  conclude(uav, epoch, record, surroundings, report);
  return false;
}

void UavPlanner::lookAround(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings) {
  surroundings.collect(uav, check_);
  committed_ = record.motions.flown().at(epoch).p;
  has_proposal_ = false;
  flies_whole_plan_ = false;
  setWorkspace(record);
  limitDoubts(epoch, record.motions.flown());
}

void UavPlanner::conclude(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                          UavReport& report) {
  surroundings.replaceMotions(uav, record.motions.newest(),
                              record.motions.olderInFlight(epoch, parameters_.time.cycle_period));
  fillReport(epoch, record, report);
}

void UavPlanner::pose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                      const std::vector<bool>& solved_together, Trajectory& start_plan) {
  poseProblem(uav, epoch, record, surroundings);
  std::vector<MovingBody>& bodies = problem_.bodies;
  bodies.erase(std::remove_if(bodies.begin(), bodies.end(),
                              [&](const MovingBody& body) {
                                const std::optional<std::size_t> other = Surroundings::uavOf(body);
                                return other && *other < solved_together.size() && solved_together[*other];
                              }),
               bodies.end());
  shift(epoch, record);
  guessActiveRows(epoch, record);
  record.task.is_quickest_stop = false;
  start_plan = plan_;
}

const CommittedMotion& UavPlanner::draft(const Trajectory& plan) {
  StopManoeuvre stop;
  plan_ = plan;
  planStop(plan.knots.back(), plan.dt, limits_.bounds, stop);
  motion_.assign(plan, stop);
  return motion_;
}

bool UavPlanner::passes(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings) {
  lookAround(uav, epoch, record, surroundings);
  return judge(uav, surroundings, plan_).accepted();
}

void UavPlanner::commitDraft(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                             const SqpResult& result, UavReport& report) {
  takeResult(result, report);
  flies_whole_plan_ = true;
  record.motions.commit(motion_);
  record.planned = true;
  report.reason = Reason::kNone;
  surroundings.collect(uav, problem_);
  conclude(uav, epoch, record, surroundings, report);
}

void UavPlanner::complete(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                          const SqpResult& result, UavReport& report) {
  lookAround(uav, epoch, record, surroundings);
  surroundings.collect(uav, problem_);
  report.reason = flyOn(uav, epoch, record, surroundings, result.solved ? &result : nullptr, report);
  conclude(uav, epoch, record, surroundings, report);
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
                         const SqpResult* joint, UavReport& report) {
  const KinematicState committed = record.motions.flown().at(epoch);
  record.task.is_quickest_stop = false;
  CheckVerdict verdict = joint != nullptr ? decide(uav, epoch, record, surroundings, *joint, report)
                                          : propose(uav, epoch, record, surroundings, report);
  // A start that tracking has moved too close, or that is measured there: the motion itself is still safe to go on
  // from.
  const bool compensated = parameters_.limits.latency_compensation;
  if (!verdict.accepted() && record.planned && compensated && areApart(record.start, committed)) {
    record.start = committed;
    verdict = propose(uav, epoch, record, surroundings, report);
  }
  if (!verdict.accepted()) return fallBack(uav, epoch, record, surroundings);
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
  shift(epoch, record);
  guessActiveRows(epoch, record);
  const SqpResult result = sqp_.solve(problem_, plan_, record.active);
  if (!result.solved) plan_ = shifted_;
  return decide(uav, epoch, record, surroundings, result, report);
}

void UavPlanner::shift(double epoch, UavRecord& record) {
  if (record.planned) {
    shiftPlan(record.motions.flown(), record.start, epoch, problem_.dt, shifted_);
  } else {
    coastingPlan(record.start, epoch, problem_.dt, shifted_);
  }
  plan_ = shifted_;
}

void UavPlanner::takeResult(const SqpResult& result, UavReport& report) {
  report.sqp_iterations += result.iterations;
  report.qp_iterations += result.qp_iterations;
  report.solved = result.solved;
  report.max_slack = result.max_violation;
}

CheckVerdict UavPlanner::decide(std::size_t uav, double epoch, const UavRecord& record,
                                const Surroundings& surroundings, const SqpResult& result, UavReport& report) {
  takeResult(result, report);
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

Reason UavPlanner::fallBack(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings) {
  record.motions.goOn(epoch);
  kept_ = record.motions.newest();
  const CheckVerdict kept = checkClearance(kept_, kept_.start(), limits_, check_);
  if (kept.accepted()) return Reason::kPlanRefused;

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
  if (on_new_plan && record.deviation.norm() > parameters_.limits.tracking_margin) report.reason = Reason::kStraying;
  if (on_new_plan && record.off_plan) {
    report.reason = Reason::kOffPlan;
    report.deviation = record.off_plan_distance;
  }
  report.state = on_new_plan ? UavState::kTracking : UavState::kFallback;
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
  const bool on_mission = record.task.mode == FlightMode::kFlying;
  const MovingTarget& target = on_mission ? record.reference : record.task.target;
  bool& on_path = on_mission ? record.on_reference : record.task.on_target_path;
  double& progress = on_mission ? record.progress : record.task.target_progress;
  const double full_speed = parameters_.limits.max_speed;
  progress = on_path ? target.path.advance(record.start.p, progress, kPassed * full_speed * problem_.dt)
                     : target.path.nearest(record.start.p, 0.0, kInfinity).arc_length;
  on_path = true;
  problem_.epoch = epoch;
  problem_.start = record.start;
  problem_.path = &target.path;
  problem_.progress = progress;
  problem_.targets = previewTargets(target, progress, full_speed, epoch, problem_.dt);
  lag_ = target.at(epoch).arc_length - progress;
  surroundings.collect(uav, problem_);
}

}  // namespace swarm_planner
