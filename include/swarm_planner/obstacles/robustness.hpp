// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// Parameters of the robustness function (8)-(11).
struct RobustnessParameters {
  double gain = 0.0;     ///< q of (9), >= 0
  double inner = 1.2;    ///< r_a of (11), > 1
  double outer = 2.5;    ///< r_b of (11), > r_a
  double epsilon = 0.0;  ///< eps_s of (8)

  RobustnessParameters() = default;
  explicit RobustnessParameters(const CostParameters& cost)
      : gain(cost.robustness_gain),
        inner(cost.robustness_inner),
        outer(cost.robustness_outer),
        epsilon(cost.epsilon_s) {}
};

/// A function of one variable with its first two derivatives.
struct SmoothStep {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

/// g of (11) with (12) and (13): 1 up to `inner`, 0 from `outer` on, infinitely often differentiable.
/// Evaluated as 1 / (1 + exp(1 / (outer - t) - 1 / (t - inner))), which neither over- nor underflows to 0 / 0.
SmoothStep smoothStep(double t, double inner, double outer);

/// The robustness function of one obstacle at one point.
struct Robustness {
  double value = 0.0;
  Vector3 gradient = Vector3::Zero();   ///< [1/m]
  Matrix3 hessian = Matrix3::Zero();    ///< exact, indefinite [1/m^2]
  Matrix3 projected = Matrix3::Zero();  ///< nearest positive semi-definite matrix to `hessian` [1/m^2]
};

/// One summand of (8), without the constant -1: q g(S(u)) exp(eps_s - hbar(u)), u = point minus the obstacle's
/// centre, S the sum of (7) and (9) (read as |.|^p term by term), hbar of (10) the logarithm of the squared distance
/// from the centre over the largest radius. Exactly 0 with all derivatives where S >= r_b.
///
/// `projected` has one positive eigenvalue nearly everywhere: sets of high value are nearly convex. A second one exists
/// on long bodies beside their flanks; with the default r_a and r_b it stays below 1e-6 of the first, with
/// r_b = 20 it reaches a third. So all of the matrix is given and no rank is promised.
///
/// (8) has a pole at the obstacle's centre; within kRobustnessCore of the largest radius it is held constant, so
/// that everything stays finite.
Robustness robustness(const Superellipsoid& obstacle, const Vector3& point, const RobustnessParameters& parameters);

/// The value alone, which is much cheaper.
double robustnessValue(const Superellipsoid& obstacle, const Vector3& point, const RobustnessParameters& parameters);

/// Fraction of the largest radius within which the function is constant.
constexpr double kRobustnessCore = 1e-3;

}  // namespace swarm_planner
