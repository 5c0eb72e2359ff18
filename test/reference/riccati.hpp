// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>

#include "swarm_planner/model/trajectory.hpp"

namespace swarm_planner {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

/// Gradients of a stage-wise quadratic cost with respect to (p, v, a) of stages 1..N and to the jerks.
struct StageGradients {
  std::array<Vector9, kHorizon + 1> x;
  std::array<Vector3, kHorizon> jerk;
};

/// Linear-quadratic problem over the horizon with the exact jerk-input dynamics, x_0 = 0:
/// minimise sum_k 1/2 x_k' Q_k x_k + g_k . x_k + 1/2 w |j_k|^2 + h_k . j_k.
/// Dynamics blocks are multiples of I3, so products with them are additions of 3-row blocks.
class RiccatiRecursion {
 public:
  /// Hessian of stage k = 1..N, to be filled before factorise().
  Matrix9& hessian(int k) { return hessians_[static_cast<std::size_t>(k)]; }

  /// Backward recursion on the Hessians; `jerk_weight` > 0 makes every pivot positive.
  void factorise(double dt, double jerk_weight);

  /// Backward recursion on the gradients, then the forward one: the minimiser, with x_0 = 0, in
  /// `step` (its jerks and knots as differences).
  void solve(const StageGradients& gradients, Trajectory& step);

 private:
  using HalfGain = Eigen::Matrix<double, 3, 9, Eigen::RowMajor>;

  double dt_ = 0.0;
  std::array<Matrix9, kHorizon + 1> hessians_;
  std::array<Eigen::LLT<Matrix3>, kHorizon> pivots_;  ///< L L' = w I + B' P B
  std::array<HalfGain, kHorizon> half_gains_;         ///< L^-1 B' P A: j = -L^-T (half_gain x + ...)
};

}  // namespace swarm_planner
