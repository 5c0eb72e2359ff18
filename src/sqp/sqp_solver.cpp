// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/sqp/sqp_solver.hpp"

#include <algorithm>
#include <utility>

#include "step_rules.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/separating_planes.hpp"

namespace swarm_planner {

SqpSolver::SqpSolver(std::unique_ptr<QpSolver> qp_solver)
    : qp_solver_(std::move(qp_solver)),
      qp_(std::make_unique<Qp>()),
      solution_(std::make_unique<QpSolution>()),
      answers_(static_cast<std::size_t>(kMostSqpIterations)) {
  planes_.reserve(kSegmentPlaneRoom);
}

SqpResult SqpSolver::solve(const UavProblem& problem, Trajectory& plan, ActiveRows& active, int most) {
  const SqpParameters& settings = problem.parameters->sqp;
  SqpResult result;
  Merit current = merit(problem, plan);
  candidate_ = plan;
  solution_->active = active;
  while (result.iterations < std::min(settings.max_iterations, most)) {
    const QpStatus status = solveQp(problem, plan, result.iterations);
    ++result.iterations;
    result.qp_iterations += solution_->iterations;
    if (status == QpStatus::kNoAnswer) break;
    result.solved = true;
    // A step that was cut short has met something that the QP did not know; what it met is in the next QP.
    const Trajectory& answer = answers_[static_cast<std::size_t>(result.iterations - 1)];
    const double wanted = largestMove(plan, answer);
    const double promised = qp_->objective(plan) - qp_->objective(answer);
    const double before = current.value;
    const double moved = acceptStep(problem, plan, current);
    const bool is_foretold = isForetold(before - current.value, promised, current.value,
                                        leansOnBodies(solution_->active), result.iterations);
    if (wanted < settings.step_tolerance || is_foretold || (moved == 0.0 && result.iterations > 1)) break;
  }
  active = solution_->active;
  result.max_violation = current.largest_violation;
  result.merit = current.value;
  return result;
}

QpStatus SqpSolver::solveQp(const UavProblem& problem, const Trajectory& plan, int iteration) {
  const double band = kSampleBand * problem.bounds.max_speed * problem.dt;
  linearise(problem, plan, band, *qp_, planes_);
  for (int i = 0; i < iteration; ++i) addNormCuts(problem, answers_[static_cast<std::size_t>(i)], i, *qp_);
  const QpStatus status = qp_solver_->solve(*qp_, *solution_);
  Trajectory& answer = answers_[static_cast<std::size_t>(iteration)];
  answer.dt = plan.dt;
  answer.holds_acceleration = plan.holds_acceleration;
  answer.jerks = solution_->jerks;
  rollOut(problem.start, answer);
  return status;
}

double SqpSolver::acceptStep(const UavProblem& problem, Trajectory& plan, Merit& current) {
  for (const double length : kStepLengths) {
    stepTowards(solution_->jerks, length, problem.start, plan, candidate_);
    const Merit candidate = merit(problem, candidate_, planes_);
    if (!(candidate.value < current.value)) continue;
    const double moved = largestMove(plan, candidate_);
    plan.jerks = candidate_.jerks;
    plan.knots = candidate_.knots;
    current = candidate;
    return moved;
  }
  return 0.0;
}

}  // namespace swarm_planner
