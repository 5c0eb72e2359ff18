// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "reference/riccati.hpp"

#include <Eigen/Cholesky>

namespace swarm_planner {
namespace {

/// Rows of B = [dt^3/6, dt^2/2, dt] (x) I3 and of A = [1 dt dt^2/2; 0 1 dt; 0 0 1] (x) I3.
struct Coefficients {
  explicit Coefficients(double step) : dt(step), half(0.5 * step * step), sixth(step * step * step / 6.0) {}
  double dt, half, sixth;
};

/// M A: the right factor mixes columns of 3.
template <class Matrix>
void timesA(Matrix& m, const Coefficients& c) {
  m.template rightCols<3>() += c.half * m.template leftCols<3>() + c.dt * m.template middleCols<3>(3);
  m.template middleCols<3>(3) += c.dt * m.template leftCols<3>();
}

/// A' M: the left factor mixes rows of 3.
template <class Matrix>
void transposedATimes(Matrix& m, const Coefficients& c) {
  m.template bottomRows<3>() += c.half * m.template topRows<3>() + c.dt * m.template middleRows<3>(3);
  m.template middleRows<3>(3) += c.dt * m.template topRows<3>();
}

/// B' M.
template <class Matrix>
auto transposedBTimes(const Matrix& m, const Coefficients& c) {
  return (c.sixth * m.template topRows<3>() + c.half * m.template middleRows<3>(3) + c.dt * m.template bottomRows<3>())
      .eval();
}

/// L^-1 M in place, row by row: a general triangular solve costs several times as much at this size.
template <class Matrix>
void solveLower(const Matrix3& l, Matrix& m) {
  m.row(0) *= 1.0 / l(0, 0);
  m.row(1) = (m.row(1) - l(1, 0) * m.row(0)) * (1.0 / l(1, 1));
  m.row(2) = (m.row(2) - l(2, 0) * m.row(0) - l(2, 1) * m.row(1)) * (1.0 / l(2, 2));
}

}  // namespace

void RiccatiRecursion::factorise(double dt, double jerk_weight) {
  dt_ = dt;
  const Coefficients c(dt);
  Matrix9 value = hessians_[kHorizon];
  for (int k = kHorizon - 1; k >= 0; --k) {
    const auto i = static_cast<std::size_t>(k);
    HalfGain cross = transposedBTimes(value, c);
    Matrix3 pivot = c.sixth * cross.leftCols<3>() + c.half * cross.middleCols<3>(3) + c.dt * cross.rightCols<3>();
    pivot.diagonal().array() += jerk_weight;
    timesA(cross, c);
    pivots_[i].compute(pivot);
    solveLower(pivots_[i].matrixLLT(), cross);
    half_gains_[i] = cross;
    if (k == 0) break;
    timesA(value, c);
    transposedATimes(value, c);
    value -= cross.transpose().lazyProduct(cross);
    value += hessians_[i];
  }
}

void RiccatiRecursion::solve(const StageGradients& gradients, Trajectory& step) {
  const Coefficients c(dt_);
  std::array<Vector3, kHorizon> feed_forward;
  Vector9 costate = gradients.x[kHorizon];
  for (int k = kHorizon - 1; k >= 0; --k) {
    const auto i = static_cast<std::size_t>(k);
    feed_forward[i] = gradients.jerk[i] + transposedBTimes(costate, c);
    pivots_[i].matrixL().solveInPlace(feed_forward[i]);
    if (k == 0) break;
    transposedATimes(costate, c);
    costate.noalias() -= half_gains_[i].transpose() * feed_forward[i];
    costate += gradients.x[i];
  }
  step.knots[0] = KinematicState();
  for (std::size_t i = 0; i < kHorizon; ++i) {
    const KinematicState& x = step.knots[i];
    step.jerks[i].noalias() = -feed_forward[i] - half_gains_[i].leftCols<3>() * x.p -
                              half_gains_[i].middleCols<3>(3) * x.v - half_gains_[i].rightCols<3>() * x.a;
    pivots_[i].matrixU().solveInPlace(step.jerks[i]);
    step.knots[i + 1] = propagate(x, step.jerks[i], dt_);
  }
}

}  // namespace swarm_planner
