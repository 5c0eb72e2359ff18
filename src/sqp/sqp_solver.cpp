// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/sqp/sqp_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "swarm_planner/sqp/linearisation.hpp"

namespace swarm_planner {
namespace {

constexpr std::array<double, 4> kStepLengths{1.0, 0.5, 0.25, 0.125};
constexpr double kSampleBand = 2.0;  // width of the band that gets rows, in the way flown per stage at full speed

}  // namespace

SqpSolver::SqpSolver(std::unique_ptr<QpSolver> qp_solver)
    : qp_solver_(std::move(qp_solver)), qp_(std::make_unique<Qp>()), solution_(std::make_unique<QpSolution>()) {}

SqpResult SqpSolver::solve(const UavProblem& problem, Trajectory& plan) {
  const SqpParameters& settings = problem.parameters->sqp;
  const double band = kSampleBand * problem.bounds.max_speed * problem.dt;
  SqpResult result;
  double current_merit = merit(problem, plan);
  candidate_ = plan;
  while (result.iterations < settings.max_iterations) {
    linearise(problem, plan, band, *qp_);
    const QpStatus status = qp_solver_->solve(*qp_, *solution_);
    ++result.iterations;
    result.qp_iterations += solution_->iterations;
    if (status == QpStatus::kNotFinite) break;
    result.solved = true;
    double moved = 0.0;
    if (!acceptStep(problem, plan, current_merit, moved) || moved < settings.step_tolerance) break;
  }
  result.max_violation = planViolation(problem, plan).largest;
  return result;
}

bool SqpSolver::acceptStep(const UavProblem& problem, Trajectory& plan, double& current_merit, double& moved) {
  for (const double length : kStepLengths) {
    for (std::size_t k = 0; k < kHorizon; ++k) {
      candidate_.jerks[k] = plan.jerks[k] + length * (solution_->jerks[k] - plan.jerks[k]);
    }
    rollOut(problem.start, candidate_);
    const double candidate_merit = merit(problem, candidate_);
    if (!(candidate_merit < current_merit)) continue;
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      moved = std::max(moved, (candidate_.knots[k].p - plan.knots[k].p).norm());
    }
    plan.jerks = candidate_.jerks;
    plan.knots = candidate_.knots;
    current_merit = candidate_merit;
    return true;
  }
  return false;
}

}  // namespace swarm_planner
