// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/robustness.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace swarm_planner {

namespace {

/// The positive semi-definite matrix nearest to `hessian` in the Frobenius norm.
Matrix3 positivePart(const Matrix3& hessian) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(hessian);
  const Vector3 positive = eigen.eigenvalues().cwiseMax(0.0);
  return eigen.eigenvectors() * positive.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

SmoothStep smoothStep(double t, double inner, double outer) {
  SmoothStep step;
  if (t >= outer) return step;
  step.value = 1.0;
  if (t <= inner) return step;

  const double to_outer = 1.0 / (outer - t);
  const double to_inner = 1.0 / (t - inner);
  // Beyond this the value is 0 or 1 and every derivative 0 to within double precision; products of huge and tiny
  // numbers would follow.
  constexpr double kNegligible = 700.0;
  const double exponent = to_outer - to_inner;
  if (exponent < -kNegligible) return step;
  if (exponent > kNegligible) return SmoothStep();

  // Logistic function of -exponent; its slope from the exponential, as 1 - value cancels where value is near 1.
  const double exponential = std::exp(exponent);
  step.value = 1.0 / (1.0 + exponential);
  const double slope = step.value * (exponential * step.value);
  const double first = to_outer * to_outer + to_inner * to_inner;
  const double second = 2.0 * (to_outer * to_outer * to_outer - to_inner * to_inner * to_inner);
  step.first = -slope * first;
  step.second = slope * ((1.0 - 2.0 * step.value) * first * first - second);
  return step;
}

double robustnessValue(const Superellipsoid& obstacle, const Vector3& point, const RobustnessParameters& parameters) {
  const Vector3 u = point - obstacle.center();
  if (parameters.gain == 0.0) return 0.0;
  const double sum = obstacle.sum(u);
  if (!(sum < parameters.outer)) return 0.0;
  const double radius = obstacle.radii().maxCoeff();
  const double core = kRobustnessCore * radius;
  const double scale = parameters.gain * std::exp(parameters.epsilon) * radius * radius;
  const double squared = u.squaredNorm();
  if (squared < core * core) return scale / (core * core);
  return scale * smoothStep(sum, parameters.inner, parameters.outer).value / squared;
}

Robustness robustness(const Superellipsoid& obstacle, const Vector3& point, const RobustnessParameters& parameters) {
  Robustness result;
  const Vector3 u = point - obstacle.center();
  // Cheap first: most obstacles are too far to matter, and S may overflow there.
  if (parameters.gain == 0.0 || !(obstacle.sum(u) < parameters.outer)) return result;

  const double radius = obstacle.radii().maxCoeff();
  const double scale = parameters.gain * std::exp(parameters.epsilon) * radius * radius;
  const double core = kRobustnessCore * radius;
  if (u.squaredNorm() < core * core) {
    result.value = scale / (core * core);
    return result;
  }

  Vector3 sum_gradient;
  Matrix3 sum_hessian;
  const double sum = obstacle.sum(u, sum_gradient, sum_hessian);
  const SmoothStep g = smoothStep(sum, parameters.inner, parameters.outer);
  // exp(eps_s - hbar) = scale / q times inverse, the inverse square of the distance from the centre.
  const double inverse = 1.0 / u.squaredNorm();
  const Vector3 inverse_gradient = -2.0 * inverse * inverse * u;
  const Matrix3 inverse_hessian = inverse * inverse * (8.0 * inverse * u * u.transpose() - 2.0 * Matrix3::Identity());
  const Matrix3 mixed = sum_gradient * inverse_gradient.transpose();

  result.value = scale * g.value * inverse;
  result.gradient = scale * (g.first * inverse * sum_gradient + g.value * inverse_gradient);
  result.hessian = scale * (inverse * (g.second * sum_gradient * sum_gradient.transpose() + g.first * sum_hessian) +
                            g.first * (mixed + mixed.transpose()) + g.value * inverse_hessian);
  result.projected = positivePart(result.hessian);
  return result;
}

}  // namespace swarm_planner
