// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// How an SQP run ended.
struct SqpResult {
  bool solved = false;      ///< at least one QP had an answer; otherwise the plan is the initial guess
  int iterations = 0;       ///< QPs solved
  int qp_iterations = 0;    ///< of the QP solver, in total
  double max_violation = 0.0;  ///< largest violated constraint of the plan [m, m/s, m/s^2]
};

/// Sequential quadratic programming on UavProblem: linearise, solve the QP, accept a step that decreases the exact
/// penalty function, repeat, at most max_iterations times. The plan returned is never worse than the initial guess.
class SqpSolver {
 public:
  explicit SqpSolver(std::unique_ptr<QpSolver> qp_solver);

  /// Improves `plan`, which has to start at problem.start (a roll-out of any jerks).
  SqpResult solve(const UavProblem& problem, Trajectory& plan);

 private:
  /// Moves `plan` towards the QP's answer as far as the merit decreases; true if it moved.
  bool acceptStep(const UavProblem& problem, Trajectory& plan, double& current_merit, double& moved);

  std::unique_ptr<QpSolver> qp_solver_;
  std::unique_ptr<Qp> qp_;
  std::unique_ptr<QpSolution> solution_;
  Trajectory candidate_;
};

}  // namespace swarm_planner
