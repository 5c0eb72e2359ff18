// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "swarm_planner/obstacles/exponent.hpp"

namespace swarm_planner {

/// Largest number of steps of the two iterations below. They converge from their starting points, in three to five
/// steps: the cap is met only for arguments that are not finite.
constexpr int kMaxPowerSumSteps = 100;

/// The v > 0 with sum_i terms_i v^p_i = level, for small integer exponents. terms_i = y_i^p_i with 0 <= y_i <= 1 and
/// y_largest = 1; `level` >= 1.
double solveIntegerPowerSum(const std::array<double, 3>& terms, const std::array<Exponent, 3>& exponents,
                            std::size_t largest, double level);

/// Solution of the equation below with its terms.
template <std::size_t N>
struct LogPowerSum {
  double sigma = 0.0;             ///< the root
  std::array<double, N> terms{};  ///< exp(log_coefficients_i + exponents_i sigma), summing to 1
};

/// The sigma with sum_i exp(log_coefficients_i + exponents_i sigma) = 1, exponents > 0, any real exponents.
/// Coefficients may be -infinity, but not all. Halley's iteration on the logarithm of the sum, which is convex,
/// increasing and nearly linear, from an upper bound.
template <std::size_t N>
LogPowerSum<N> solveLogPowerSum(const std::array<double, N>& log_coefficients, const std::array<double, N>& exponents) {
  /// The error after a step is about the square of the exponent times the third power of the step.
  constexpr double kStepTolerance = 1e-7;
  LogPowerSum<N> solution;
  double& sigma = solution.sigma;
  sigma = -log_coefficients[0] / exponents[0];
  for (std::size_t i = 1; i < N; ++i) sigma = std::min(sigma, -log_coefficients[i] / exponents[i]);
  for (int step = 0; step < kMaxPowerSumSteps; ++step) {
    double sum = 0.0;
    double first = 0.0;  // derivatives of the sum
    double second = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      const double term = std::exp(log_coefficients[i] + exponents[i] * sigma);
      sum += term;
      first += exponents[i] * term;
      second += exponents[i] * exponents[i] * term;
    }
    // Where exponents differ much the curvature is no guide: the step is at most twice Newton's.
    const double excess = std::log(sum);
    const double newton = first * first;
    const double halley = newton - 0.5 * excess * (second * sum - newton);
    const double decrease = excess * sum * first / std::max(0.5 * newton, halley);
    sigma -= decrease;
    if (std::abs(decrease) < kStepTolerance) break;
  }
  for (std::size_t i = 0; i < N; ++i) solution.terms[i] = std::exp(log_coefficients[i] + exponents[i] * sigma);
  return solution;
}

}  // namespace swarm_planner
