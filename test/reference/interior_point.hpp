// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "reference/riccati.hpp"
#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// The reference that generated solvers are compared with: a primal-dual interior-point method (Mehrotra's predictor
/// and corrector) with a Riccati recursion over the stages. A row's slack and both of its complementarity pairs are
/// eliminated, so that a row costs one rank-one term in its stage's Hessian. Where no row is violated at the
/// unconstrained optimum, that is the answer after one recursion.
class InteriorPointSolver final : public QpSolver {
 public:
  struct Settings {
    int max_iterations = 40;
    double gap_tolerance = 1e-9;       ///< mean complementarity over slack_linear
    double residual_tolerance = 1e-8;  ///< largest primal residual of a row
  };

  InteriorPointSolver() = default;
  explicit InteriorPointSolver(const Settings& settings) : settings_(settings) {}

  QpStatus solve(const Qp& qp, QpSolution& solution) override;

 private:
  /// One row n.y + s - t = d with t >= 0 (multiplier lambda) and s >= 0 (multiplier mu).
  struct RowState {
    double t, s, lambda, mu;
    double dt, ds, dlambda, dmu;  ///< Newton step
    double r_primal, r_slack;     ///< n.y + s - t - d and slack_linear + slack_quadratic s - lambda - mu
    double c_t, c_s;              ///< right-hand sides of the two complementarity equations
    double compliance;            ///< of the eliminated slack: ds = compliance (dlambda - bias)
    double bias;
    double weight;  ///< of the rank-one term: dlambda = weight (shift - n.dy)
    double shift;
  };
  using StageRows = std::array<RowState, kMaxStageRows>;

  template <class Function>
  void forEachRow(const Qp& qp, const Function& function);

  void solveUnconstrained(const Qp& qp);
  bool anyRowViolated(const Qp& qp);
  void initialiseRows(const Qp& qp);
  QpStatus iterate(const Qp& qp, int& iterations);
  bool converged(const Qp& qp);
  void factorise(const Qp& qp);
  void newtonStep(const Qp& qp, bool corrector, double centring);
  double stepLength(const Qp& qp);
  double complementarityAfter(const Qp& qp, double step);
  void takeStep(const Qp& qp, double step);
  void writeSolution(const Qp& qp, QpSolution& solution);

  Settings settings_;
  RiccatiRecursion riccati_;
  StageGradients gradients_;
  Trajectory iterate_;
  Trajectory step_;
  int row_total_ = 0;
  double mean_complementarity_ = 0.0;
  std::array<StageRows, kHorizon + 1> rows_;
};

}  // namespace swarm_planner
