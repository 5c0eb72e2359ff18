// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/uav_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"

namespace swarm_planner {
void UavRecord::setReference(const std::vector<Vector3>& path, double arc_length, double speed) {
  reference = MovingTarget();
  reference.path = ReferencePath(path);
  reference.start = arc_length;
  reference.speed = speed;
  reference_pending = true;
  on_reference = false;
}

void UavRecord::reset() {
  plans = 0;
  reference_pending = true;
  on_reference = false;
  active.count = 0;
}

void UavRecord::predictStart(const UavMeasurement& measurement, double epoch, double tracking_time) {
  if (!isFlyingPlanAt(measurement.stamp)) {
    start = predictFromMeasurement(measurement, epoch);
    return;
  }
  const bool flies_previous = plans > 1 && measurement.stamp < committed.epoch;
  start = predictFromPlan(committed, flies_previous ? previous : committed, measurement, epoch, tracking_time);
}

void UavRecord::startAsMeasured(const UavMeasurement& measurement, double epoch) {
  // Odometry has no acceleration: without that of the plan it would begin at zero in every cycle.
  start = {measurement.p, measurement.v, Vector3::Zero()};
  if (isFlyingPlanAt(epoch)) start.a = committed.at(epoch).a;
}

UavPlanner::UavPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
                       std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies)
    : parameters_(parameters), sqp_(std::make_unique<GeneratedSolver>(std::move(tables))) {
  problem_.parameters = &parameters;
  problem_.dt = parameters.time.sampling_time;
  problem_.bounds = FlightBounds(parameters, workspace ? &*workspace : nullptr);
  problem_.bodies.reserve(max_bodies);
}

void UavPlanner::plan(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report) {
  const Stopwatch stopwatch;
  poseProblem(uav, epoch, record, surroundings);
  if (record.plans > 0) {
    shiftPlan(record.committed, record.start, epoch, problem_.dt, plan_);
  } else {
    coastingPlan(record.start, epoch, problem_.dt, plan_);
  }
  guessActiveRows(epoch, record);
  const SqpResult result = sqp_.solve(problem_, plan_, record.active);
  if (result.solved) {
    std::swap(record.previous, record.committed);
    record.committed = plan_;
    record.plans = std::min(record.plans + 1, 2);
    surroundings.setPlan(uav, record.committed, epoch);
  }

  report.planned = record.plans > 0;
  report.sqp_iterations = result.iterations;
  report.qp_iterations = result.qp_iterations;
  report.max_slack = result.max_violation;
  report.lag = problem_.targets[0].arc_length - record.progress;
  const PredictedClearance clearance = predictedClearance(problem_, plan_);
  report.obstacle_clearance = clearance.obstacle;
  report.pair_distance = clearance.pair;
  report.reason = Reason::kNone;
  if (result.max_violation > parameters_.limits.tracking_margin) report.reason = Reason::kConstraintsViolated;
  if (!result.solved) report.reason = Reason::kSolverFailed;
  report.state = report.reason == Reason::kNone ? UavState::kTracking : UavState::kFallback;
  report.solve_time = stopwatch.elapsed();
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
  const ReferencePath& path = record.reference.path;
  const PathPoint foot = record.on_reference
                             ? path.nearest(record.start.p, record.progress)
                             : path.nearest(record.start.p, 0.0, std::numeric_limits<double>::infinity());
  record.progress = foot.arc_length;
  record.on_reference = true;
  problem_.epoch = epoch;
  problem_.start = record.start;
  problem_.path = &path;
  problem_.progress = record.progress;
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    problem_.targets[k] = record.reference.at(epoch + static_cast<double>(k) * problem_.dt);
  }
  surroundings.collect(uav, problem_);
}

}  // namespace swarm_planner
