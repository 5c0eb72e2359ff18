// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/uav_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/pair_check.hpp"
#include "swarm_planner/swarm/place_beside.hpp"
#include "swarm_planner/swarm/plan_parts.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/planner_limits.hpp"
#include "swarm_planner/swarm/right_of_way.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"

namespace swarm_planner {
namespace {

constexpr double kSamePlace = 1e-6;  // starts closer than this are the same [m, m/s]
constexpr double kPassed = 0.5;      // of the way flown per stage at full speed: a sharp corner nearer is passed
constexpr double kStanding = 0.05;   // of max_speed: a slower UAV stands
constexpr int kMostLeadingQps = 2;   // for a plan to start from, along a guide alone
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool areApart(const KinematicState& x, const KinematicState& y) {
  return (x.p - y.p).norm() > kSamePlace || (x.v - y.v).norm() > kSamePlace;
}

}  // namespace

UavPlanner::UavPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
                       std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies)
    : parameters_(parameters),
      limits_(makeCheckLimits(parameters, workspace ? &*workspace : nullptr)),
      workspace_(limits_.bounds.workspace),
      mapped_(parameters),
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
  if (begin(uav, epoch, record, surroundings, report)) {
    report.reason = flyOn(uav, epoch, record, surroundings, report);
    conclude(uav, epoch, record, surroundings, report);
  }
  report.solve_time = stopwatch.elapsed();
}

bool UavPlanner::begin(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                       UavReport& report) {
  survey(uav, epoch, record, surroundings);
  if (!rest(uav, epoch, record, surroundings)) return true;
  poseProblem(uav, epoch, record, surroundings);
  conclude(uav, epoch, record, surroundings, report);
  return false;
}

void UavPlanner::conclude(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                          UavReport& report) {
  publish(uav, epoch, record, surroundings);
  fillReport(epoch, record, report);
}

void UavPlanner::pose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                      const std::vector<bool>& solved_together, Trajectory& start_plan) {
  poseProblem(uav, epoch, record, surroundings);
  std::vector<MovingBody>& bodies = problem_.bodies;
  const auto is_solved_too = [&solved_together](const MovingBody& body) {
    const std::optional<std::size_t> other = Surroundings::uavOf(body);
    return other && *other < solved_together.size() && solved_together[*other];
  };
  bodies.erase(std::remove_if(bodies.begin(), bodies.end(), is_solved_too), bodies.end());
  startFromFlown(epoch, record);
  record.task.is_quickest_stop = false;
  start_plan = plan_;
}

SqpResult UavPlanner::leadAlongGuide(UavRecord& record, Trajectory& start_plan) {
  const SqpResult alone = solveGuideAlone(record);
  start_plan = along_;
  return alone;
}

const CommittedMotion& UavPlanner::draft(std::size_t uav, const Trajectory& plan, const UavRecord& record,
                                         const Surroundings& surroundings) {
  plan_ = plan;
  keepJerkLimit(record.start);
  const CheckReason reason = judge(uav, surroundings, plan_).reason;
  keeps_bounds_ = reason == CheckReason::kAccepted || reason >= CheckReason::kWorkspace;
  return motion_;
}

bool UavPlanner::passesAsDrafted(std::size_t uav, double epoch, const UavRecord& record,
                                 const Surroundings& surroundings) {
  if (!parameters_.limits.plan_check) return true;
  survey(uav, epoch, record, surroundings);
  return keeps_bounds_ && surroundings.isWithinArea(uav, motion_) &&
         checkClearance(motion_, committed_, limits_, check_).accepted();
}

bool UavPlanner::passes(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings) {
  survey(uav, epoch, record, surroundings);
  return judge(uav, surroundings, plan_).accepted();
}

void UavPlanner::commitDraft(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                             const SqpResult& result, UavReport& report) {
  takeResult(result, record, report);
  flies_whole_plan_ = true;
  record.motions.commit(motion_);
  record.planned = true;
  report.reason = Reason::kNone;
  surroundings.collect(uav, problem_);
  conclude(uav, epoch, record, surroundings, report);
}

void UavPlanner::planAnew(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                          const SqpResult& result, UavReport& report) {
  report.sqp_iterations += result.iterations;
  report.qp_iterations += result.qp_iterations;
  survey(uav, epoch, record, surroundings);
  report.reason = flyOn(uav, epoch, record, surroundings, report);
  conclude(uav, epoch, record, surroundings, report);
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
  limitDoubts(epoch, record.motions.flown(), limits_, kept_, check_.uavs);
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

CheckVerdict UavPlanner::propose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                                 UavReport& report) {
  poseProblem(uav, epoch, record, surroundings);
  startFromFlown(epoch, record);
  SqpResult result = sqp_.solve(problem_, plan_, record.active);
  if (!result.solved) plan_ = shifted_;
  if (record.guide.needsFreshStart()) solveAlongGuide(record, result);
  keepJerkLimit(record.start);
  return decide(uav, record, surroundings, result, report);
}

void UavPlanner::startFromFlown(double epoch, UavRecord& record) {
  if (record.planned) {
    shiftPlan(record.motions.flown(), record.start, epoch, problem_.dt, shifted_);
  } else {
    coastingPlan(record.start, epoch, problem_.dt, shifted_);
  }
  plan_ = shifted_;
  mapped_.findCorridor(check_.map, shifted_, record.corridor, problem_);
  guessActiveRows(epoch, record);
}

void UavPlanner::takeResult(const SqpResult& result, UavRecord& record, UavReport& report) const {
  record.guide.notePlan(plan_.knots.back().p, problem_);
  report.sqp_iterations += result.iterations;
  report.qp_iterations += result.qp_iterations;
  report.solved = result.solved;
  report.max_slack = result.max_violation;
}

CheckVerdict UavPlanner::decide(std::size_t uav, UavRecord& record, const Surroundings& surroundings,
                                const SqpResult& result, UavReport& report) {
  takeResult(result, record, report);
  const CheckVerdict verdict = judge(uav, surroundings, plan_);
  flies_whole_plan_ = verdict.accepted();
  if (flies_whole_plan_) return verdict;
  report.refusal = verdict.reason;
  const bool is_motion = verdict.reason != CheckReason::kNotFinite && verdict.reason != CheckReason::kDiscontinuous;
  if (is_motion && surroundings.isWithinArea(uav, motion_)) {
    has_proposal_ = true;
    proposed_ = motion_;
    proposal_conflict_ = problem_.epoch + (verdict.reason == CheckReason::kRestingPlace ? verdict.time : 0.0);
  }
  PlanParts parts(plan_, shifted_, is_motion ? verdict.time : 0.0, limits_.bounds);
  while (parts.next(step_)) {
    if (!judge(uav, surroundings, step_).accepted()) continue;
    report.stops_early = parts.stopsEarly();
    if (report.stops_early) report.refusal = CheckReason::kAccepted;
    report.stays = parts.stays();
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

SqpResult UavPlanner::solveGuideAlone(UavRecord& record) {
  along_ = shifted_;
  along_active_.count = 0;
  mapped_.findCorridorAlongPath(check_.map, problem_);
  std::swap(problem_.bodies, no_bodies_);
  const SqpResult alone = sqp_.solve(problem_, along_, along_active_, kMostLeadingQps);
  std::swap(problem_.bodies, no_bodies_);
  along_active_.count = 0;
  // It need not go where the corridor about the path is wide, and what lies outside of that is not known there.
  mapped_.findCorridor(check_.map, along_, record.corridor, problem_);
  return alone;
}

void UavPlanner::solveAlongGuide(UavRecord& record, SqpResult& result) {
  const SqpResult alone = solveGuideAlone(record);
  SqpResult other = sqp_.solve(problem_, along_, along_active_);
  const int iterations = result.iterations + alone.iterations + other.iterations;
  const int qp_iterations = result.qp_iterations + alone.qp_iterations + other.qp_iterations;
  if (other.solved && (!result.solved || other.merit < result.merit)) {
    plan_ = along_;
    record.active = along_active_;
    result = other;
  } else {
    mapped_.findCorridor(check_.map, shifted_, record.corridor, problem_);
  }
  result.iterations = iterations;
  result.qp_iterations = qp_iterations;
}

CheckVerdict UavPlanner::judge(std::size_t uav, const Surroundings& surroundings, const Trajectory& plan) {
  if (!parameters_.limits.plan_check) {
    StopManoeuvre stop;
    planStop(plan.knots.back(), plan.dt, limits_.bounds, stop);
    motion_.assign(plan, stop);
    return {};
  }
  CheckVerdict verdict = checkPlan(plan, plan.knots.front(), committed_, limits_, check_, motion_);
  if (verdict.reason == CheckReason::kRestingPlace && stopBeside(verdict, plan)) verdict = {};
  if (verdict.accepted() && !surroundings.isWithinArea(uav, motion_)) verdict.reason = CheckReason::kOutOfArea;
  return verdict;
}

bool UavPlanner::stopBeside(const CheckVerdict& verdict, const Trajectory& plan) {
  const std::optional<Vector3> place = placeBeside(motion_.restingPlace(), static_cast<std::size_t>(verdict.body),
                                                   plan.epoch + plan.duration(), limits_, check_);
  if (!place) return false;
  StopManoeuvre stop;
  planStopAt(plan.knots.back(), *place, plan.dt, limits_.bounds, stop);
  if (!stop.within_bounds) return false;
  beside_.assign(plan, stop);
  if (!checkClearance(beside_, committed_, limits_, check_).accepted()) return false;
  motion_ = beside_;
  return true;
}

void UavPlanner::fillReport(double epoch, const UavRecord& record, UavReport& report) {
  if (!flies_whole_plan_) {
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      plan_.knots[k] = record.motions.newest().at(epoch + static_cast<double>(k) * problem_.dt);
    }
    report.max_slack = planViolation(problem_, plan_).largest;
  }
  const PredictedClearance clearance = predictedClearance(problem_, plan_);
  report.obstacle_clearance = std::min(clearance.obstacle, mapped_.clearance(check_.map, plan_));
  report.pair_distance = clearance.pair;
  report.planned = record.planned;
  report.deviation = record.deviation.norm();
  report.lag = lag_;
  const bool rests = record.task.mode == FlightMode::kLanded || record.task.is_quickest_stop;
  if (report.reason == Reason::kNone && !report.solved && !rests) report.reason = Reason::kSolverFailed;
  const bool on_new_plan = report.reason == Reason::kNone;
  const bool gives_way = report.reason == Reason::kGivesWayToObstacle;
  if (on_new_plan) report.reason = record.reasonOff(parameters_);
  if (report.reason == Reason::kOffPlan) report.deviation = record.off_plan_distance;
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
