// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/closest_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "swarm_planner/obstacles/power_sum.hpp"

namespace swarm_planner {

namespace {

/// Solution of one axis, zeta = y / r, of r zeta + lambda (p / r) zeta^(p-1) = x.
struct AxisPoint {
  double log_zeta = -std::numeric_limits<double>::infinity();
  double offset = 0.0;     ///< x - y [m]
  double log_slope = 0.0;  ///< d ln zeta / d ln lambda, in (-1, 0]
};

AxisPoint solveAxis(double x, double r, double p, double lambda) {
  AxisPoint axis;
  // Below that quotients by x overflow; it is as good as none.
  constexpr double kNoOffset = 1e-200;
  if (x < kNoOffset) return axis;
  double straight;  // r zeta / x, the other term being 1 minus it
  double curved;
  if (p == 2.0) {
    const double stretch = 2.0 * lambda / r;
    straight = r / (r + stretch);
    curved = stretch / (r + stretch);
    axis.log_zeta = std::log(x / (r + stretch));
  } else {
    const LogPowerSum<2> root = solveLogPowerSum<2>({std::log(r / x), std::log(lambda * p / (r * x))}, {1.0, p - 1.0});
    straight = root.terms[0];
    curved = root.terms[1];
    axis.log_zeta = root.sigma;
  }
  axis.offset = x * curved;
  axis.log_slope = -curved / (straight + (p - 1.0) * curved);
  return axis;
}

/// The body's point that belongs to one lambda.
struct DualPoint {
  double log_sum = 0.0;           ///< ln S
  double log_slope = 0.0;         ///< d ln S / d ln lambda, <= 0
  double shape = 0.0;             ///< mean of (p - 1) / p, weighted by the terms of S
  double squared_distance = 0.0;  ///< [m^2]
  Vector3 offset;                 ///< x - y [m]
};

DualPoint solveAxes(const Vector3& x, const Vector3& radii, const Vector3& exponents, double lambda) {
  DualPoint point;
  std::array<double, 3> log_terms{};
  std::array<double, 3> slopes{};
  for (int i = 0; i < 3; ++i) {
    const AxisPoint axis = solveAxis(x[i], radii[i], exponents[i], lambda);
    const auto k = static_cast<std::size_t>(i);
    log_terms[k] = exponents[i] * axis.log_zeta;
    slopes[k] = exponents[i] * axis.log_slope;
    point.squared_distance += axis.offset * axis.offset;
    point.offset[i] = axis.offset;
  }
  // Relative to the largest term: S itself overflows far from the body.
  const double largest = std::max({log_terms[0], log_terms[1], log_terms[2]});
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double term = std::exp(log_terms[k] - largest);
    sum += term;
    point.log_slope += term * slopes[k];
    point.shape += term * (1.0 - 1.0 / exponents[i]);
  }
  point.log_sum = largest + std::log(sum);
  point.log_slope /= sum;
  point.shape /= sum;
  return point;
}

}  // namespace

double bodyDistance(const Vector3& point, const Vector3& radii, const Vector3& exponents, const Gauge& gauge,
                    Vector3& offset) {
  constexpr int kMaxSteps = 100;
  /// Relative step of lambda; the distance is off by its square.
  constexpr double kStepTolerance = 1e-7;

  const Vector3 x = point.cwiseAbs();
  const double slope = gauge.gradient.norm();
  // lambda = distance / |grad S| where y is. Bounds of the distance: the supporting plane, and the radial foot.
  // Bounds of |grad S| on the surface: its components, and grad S . y = sum p t >= least exponent.
  const double to_plane = (gauge.value - 1.0) / slope;
  const double to_foot = x.norm() * (1.0 - 1.0 / gauge.value);
  double lower = to_plane / exponents.cwiseQuotient(radii).norm();
  double upper = to_foot * radii.norm() / exponents.minCoeff();
  // At the radial foot grad S = scale * gradient of the gauge, with 1 / scale the mean of 1 / p by their weights.
  const double inverse_scale = gauge.gradient.cwiseProduct(point).cwiseQuotient(exponents).sum() / gauge.value;
  double lambda = std::min(std::max(to_plane * inverse_scale / slope, lower), upper);

  DualPoint dual = solveAxes(x, radii, exponents, lambda);
  for (int step = 0; step < kMaxSteps; ++step) {
    (dual.log_sum > 0.0 ? lower : upper) = lambda;
    // Newton on S^-shape, which is linear in lambda for a sphere and nearly so far from any body.
    double ratio = 1.0 - std::expm1(dual.shape * dual.log_sum) / (dual.shape * dual.log_slope);
    if (std::abs(ratio - 1.0) < kStepTolerance) break;
    if (!(lambda * ratio > lower && lambda * ratio < upper)) ratio = std::sqrt(lower / lambda * (upper / lambda));
    lambda *= ratio;
    dual = solveAxes(x, radii, exponents, lambda);
  }
  for (int i = 0; i < 3; ++i) offset[i] = std::copysign(dual.offset[i], point[i]);
  return std::sqrt(std::max(dual.squared_distance + 2.0 * lambda * std::expm1(dual.log_sum), 0.0));
}

}  // namespace swarm_planner
