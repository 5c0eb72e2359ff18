// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// How an SQP run ended.
struct SqpResult {
  bool solved = false;         ///< at least one QP had an answer; otherwise the plan is the initial guess
  int iterations = 0;          ///< QPs solved
  int qp_iterations = 0;       ///< of the QP solver, in total
  double max_violation = 0.0;  ///< largest violated constraint of the plan [m, m/s, m/s^2]
  double merit = 0.0;          ///< of the plan; no more than that of the initial guess
};

/// Sequential quadratic programming on UavProblem: linearise, solve the QP, accept a step that decreases the exact
/// penalty function, repeat, at most max_iterations times. The plan returned is never worse than the initial guess.
class SqpSolver {
 public:
  /// `qp_solver` has to take QPs of both makeQpModels of the problems' parameters.
  explicit SqpSolver(std::unique_ptr<QpSolver> qp_solver);

  /// Improves `plan`, which has to start at problem.start (a roll-out of any jerks). `active`: a guess of the first
  /// QP's active rows, which may be empty; afterwards those of the last QP. No more than `most` QPs are solved.
  SqpResult solve(const UavProblem& problem, Trajectory& plan, ActiveRows& active, int most = kMostSqpIterations);

 private:
  /// Poses the QP at `plan`, with the cuts that the earlier answers of this run call for, and solves it.
  QpStatus solveQp(const UavProblem& problem, const Trajectory& plan, int iteration);
  /// Moves `plan` towards the QP's answer as far as the merit decreases. Returns how far any knot moved [m].
  double acceptStep(const UavProblem& problem, Trajectory& plan, Merit& current);

  std::unique_ptr<QpSolver> qp_solver_;
  std::unique_ptr<Qp> qp_;
  std::unique_ptr<QpSolution> solution_;
  SegmentPlanes planes_;             ///< of the newest QP
  std::vector<Trajectory> answers_;  ///< of this run's QPs
  Trajectory candidate_;
};

}  // namespace swarm_planner
