// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "reference/interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kBoundaryFraction = 0.995;  // of the way to the boundary that a step may go

const OutputGains& gainsOf(const Qp& qp, const QpRow& row) { return qp.outputs[static_cast<std::size_t>(row.output)]; }

double rowValue(const Qp& qp, const QpRow& row, const KinematicState& x) {
  return row.n.dot(outputValue(gainsOf(qp, row), x));
}

/// Adds the gradient of scaled_normal . y in the state to a stage's gradient.
void addRowGradient(const OutputGains& gains, const Vector3& scaled_normal, Vector9& gradient) {
  gradient.head<3>() += gains.p * scaled_normal;
  gradient.segment<3>(3) += gains.v * scaled_normal;
  gradient.tail<3>() += gains.a * scaled_normal;
}

/// Adds the Hessian of 1/2 y' outer y in the state to a stage's Hessian.
void addOutputHessian(const OutputGains& gains, const Matrix3& outer, Matrix9& hessian) {
  const std::array<double, 3> gain{gains.p, gains.v, gains.a};
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      const double weight = gain[static_cast<std::size_t>(i)] * gain[static_cast<std::size_t>(j)];
      hessian.block<3, 3>(3 * i, 3 * j) += weight * outer;
    }
  }
}

/// The stage's own Hessian, without rows.
void setCostHessian(const Qp& qp, std::size_t k, Matrix9& hessian) {
  hessian.setZero();
  hessian.block<3, 3>(0, 0) = qp.positionHessian(static_cast<int>(k));
  hessian.block<3, 3>(3, 3).diagonal().setConstant(qp.model.velocityWeight(static_cast<int>(k)));
  hessian.block<3, 3>(6, 6).diagonal().setConstant(qp.model.accelerationWeight(static_cast<int>(k)));
}

/// Gradients of the cost, without rows, at an iterate.
void setCostGradients(const Qp& qp, const Trajectory& iterate, StageGradients& gradients) {
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const KinematicState& x = iterate.knots[k];
    const int stage = static_cast<int>(k);
    gradients.x[k].head<3>() = qp.positionHessian(stage) * x.p + qp.stages[k].position_gradient;
    gradients.x[k].segment<3>(3) = qp.model.velocityWeight(stage) * x.v + qp.stages[k].velocity_gradient;
    gradients.x[k].tail<3>() = qp.model.accelerationWeight(stage) * x.a;
    gradients.jerk[k - 1] = qp.model.jerk_weight * iterate.jerks[k - 1];
  }
}

/// The largest step up to `step` that leaves a positive `value` with change `change` positive.
double limitStep(double step, double value, double change) {
  return -change * step > kBoundaryFraction * value ? -kBoundaryFraction * value / change : step;
}

}  // namespace

template <class Function>
void InteriorPointSolver::forEachRow(const Qp& qp, const Function& function) {
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const QpStage& stage = qp.stages[k];
    for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) function(k, stage.rows[i], rows_[k][i]);
  }
}

QpStatus InteriorPointSolver::solve(const Qp& qp, QpSolution& solution) {
  solution.iterations = 1;
  solution.active.count = 0;
  solution.status = QpStatus::kSolved;
  row_total_ = 0;
  solveUnconstrained(qp);
  if (anyRowViolated(qp)) {
    row_total_ = qp.rowCount();
    initialiseRows(qp);
    solution.status = iterate(qp, solution.iterations);
  }
  writeSolution(qp, solution);
  return solution.status;
}

void InteriorPointSolver::solveUnconstrained(const Qp& qp) {
  iterate_.dt = qp.model.dt;
  iterate_.jerks.fill(Vector3::Zero());
  rollOut(qp.start, iterate_);
  for (std::size_t k = 1; k <= kHorizon; ++k) setCostHessian(qp, k, riccati_.hessian(static_cast<int>(k)));
  setCostGradients(qp, iterate_, gradients_);
  riccati_.factorise(qp.model.dt, qp.model.jerk_weight);
  riccati_.solve(gradients_, step_);
  for (std::size_t k = 0; k < kHorizon; ++k) iterate_.jerks[k] += step_.jerks[k];
  rollOut(qp.start, iterate_);
}

bool InteriorPointSolver::anyRowViolated(const Qp& qp) {
  bool violated = false;
  forEachRow(qp, [&](std::size_t k, const QpRow& row, const RowState&) {
    violated = violated || !(rowValue(qp, row, iterate_.knots[k]) >= row.d);
  });
  return violated;
}

/// Starts every row at the unconstrained optimum, both pairs well inside: the multipliers at half of the L1
/// penalty, where neither the row nor its slack is favoured.
void InteriorPointSolver::initialiseRows(const Qp& qp) {
  forEachRow(qp, [&](std::size_t k, const QpRow& row, RowState& r) {
    const double distance = rowValue(qp, row, iterate_.knots[k]) - row.d;
    const double inside = 0.1;  // [m], [m/s] or [m/s^2]
    r.t = std::max(distance, inside);
    r.s = std::max(-distance, inside);
    r.lambda = 0.5 * qp.model.slack_linear * inside / r.t;
    r.mu = qp.model.slack_linear - r.lambda;
  });
}

QpStatus InteriorPointSolver::iterate(const Qp& qp, int& iterations) {
  for (; iterations <= settings_.max_iterations; ++iterations) {
    if (converged(qp)) return QpStatus::kSolved;
    factorise(qp);
    newtonStep(qp, false, 0.0);
    const double affine = complementarityAfter(qp, stepLength(qp));
    const double ratio = affine / mean_complementarity_;
    newtonStep(qp, true, ratio * ratio * ratio);
    const double step = stepLength(qp);
    if (!std::isfinite(step) || !step_.knots[kHorizon].p.allFinite()) return QpStatus::kNoAnswer;
    takeStep(qp, step);
  }
  return QpStatus::kIterationLimit;
}

bool InteriorPointSolver::converged(const Qp& qp) {
  double complementarity = 0.0;
  double residual = 0.0;
  forEachRow(qp, [&](std::size_t k, const QpRow& row, RowState& r) {
    r.r_primal = rowValue(qp, row, iterate_.knots[k]) + r.s - r.t - row.d;
    r.r_slack = qp.model.slack_linear + qp.model.slack_quadratic * r.s - r.lambda - r.mu;
    complementarity += r.t * r.lambda + r.s * r.mu;
    residual = std::max({residual, std::abs(r.r_primal), std::abs(r.r_slack) / qp.model.slack_linear});
  });
  mean_complementarity_ = complementarity / (2.0 * row_total_);
  return mean_complementarity_ <= settings_.gap_tolerance * qp.model.slack_linear &&
         residual <= settings_.residual_tolerance;
}

void InteriorPointSolver::factorise(const Qp& qp) {
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const QpStage& stage = qp.stages[k];
    Matrix9& hessian = riccati_.hessian(static_cast<int>(k));
    setCostHessian(qp, k, hessian);
    std::array<Matrix3, kOutputCount> outer;
    std::array<bool, kOutputCount> used{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) {
      const QpRow& row = stage.rows[i];
      RowState& r = rows_[k][i];
      r.compliance = 1.0 / (qp.model.slack_quadratic + r.mu / r.s);
      r.weight = 1.0 / (r.compliance + r.t / r.lambda);
      const auto output = static_cast<std::size_t>(row.output);
      if (!used[output]) outer[output].setZero();
      used[output] = true;
      outer[output].noalias() += (r.weight * row.n) * row.n.transpose();
    }
    for (std::size_t output = 0; output < kOutputCount; ++output) {
      if (used[output]) addOutputHessian(qp.outputs[output], outer[output], hessian);
    }
  }
  riccati_.factorise(qp.model.dt, qp.model.jerk_weight);
}

/// Solves for the Newton step. The corrector aims at `centring` times the mean complementarity and adds the
/// predictor's second-order terms, which the rows still hold from the call before.
void InteriorPointSolver::newtonStep(const Qp& qp, bool corrector, double centring) {
  setCostGradients(qp, iterate_, gradients_);
  const double target = corrector ? centring * mean_complementarity_ : 0.0;
  forEachRow(qp, [&](std::size_t k, const QpRow& row, RowState& r) {
    r.c_t = r.t * r.lambda - target + (corrector ? r.dt * r.dlambda : 0.0);
    r.c_s = r.s * r.mu - target + (corrector ? r.ds * r.dmu : 0.0);
    r.bias = r.r_slack + r.c_s / r.s;
    r.shift = -r.r_primal + r.compliance * r.bias - r.c_t / r.lambda;
    addRowGradient(gainsOf(qp, row), -(r.lambda + r.weight * r.shift) * row.n, gradients_.x[k]);
  });
  riccati_.solve(gradients_, step_);
  forEachRow(qp, [&](std::size_t k, const QpRow& row, RowState& r) {
    r.dlambda = r.weight * (r.shift - rowValue(qp, row, step_.knots[k]));
    r.ds = r.compliance * (r.dlambda - r.bias);
    r.dt = -(r.c_t + r.t * r.dlambda) / r.lambda;
    r.dmu = -(r.c_s + r.mu * r.ds) / r.s;
  });
}

double InteriorPointSolver::stepLength(const Qp& qp) {
  double step = 1.0;
  forEachRow(qp, [&](std::size_t, const QpRow&, const RowState& r) {
    step = limitStep(limitStep(step, r.t, r.dt), r.lambda, r.dlambda);
    step = limitStep(limitStep(step, r.s, r.ds), r.mu, r.dmu);
  });
  return step;
}

double InteriorPointSolver::complementarityAfter(const Qp& qp, double step) {
  double sum = 0.0;
  forEachRow(qp, [&](std::size_t, const QpRow&, const RowState& r) {
    sum += (r.t + step * r.dt) * (r.lambda + step * r.dlambda) + (r.s + step * r.ds) * (r.mu + step * r.dmu);
  });
  return sum / (2.0 * row_total_);
}

void InteriorPointSolver::takeStep(const Qp& qp, double step) {
  for (std::size_t k = 0; k < kHorizon; ++k) iterate_.jerks[k] += step * step_.jerks[k];
  rollOut(qp.start, iterate_);
  forEachRow(qp, [&](std::size_t, const QpRow&, RowState& r) {
    r.t += step * r.dt;
    r.s += step * r.ds;
    r.lambda += step * r.dlambda;
    r.mu += step * r.dmu;
  });
}

void InteriorPointSolver::writeSolution(const Qp& qp, QpSolution& solution) {
  solution.jerks = iterate_.jerks;
  solution.max_slack = 0.0;
  bool finite = true;
  for (const Vector3& jerk : iterate_.jerks) finite = finite && jerk.allFinite();
  forEachRow(qp, [&](std::size_t k, const QpRow& row, const RowState&) {
    const double slack = row.d - rowValue(qp, row, iterate_.knots[k]);
    finite = finite && std::isfinite(slack);
    solution.max_slack = std::max(solution.max_slack, slack);
  });
  if (!finite) solution.status = QpStatus::kNoAnswer;
}

}  // namespace swarm_planner
