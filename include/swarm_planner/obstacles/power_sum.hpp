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
/// Coefficients may be -infinity, but not all. Newton on the logarithm of the sum, which is convex, increasing and
/// nearly linear: monotone from its upper bound, in three to five steps for exponents from 2 to 1000.
template <std::size_t N>
LogPowerSum<N> solveLogPowerSum(const std::array<double, N>& log_coefficients, const std::array<double, N>& exponents) {
  /// The error after a step is about the curvature (exponent^2 at most) times the step squared.
  constexpr double kStepTolerance = 1e-10;
  LogPowerSum<N> solution;
  double& sigma = solution.sigma;
  sigma = -log_coefficients[0] / exponents[0];
  for (std::size_t i = 1; i < N; ++i) sigma = std::min(sigma, -log_coefficients[i] / exponents[i]);
  for (int step = 0; step < kMaxPowerSumSteps; ++step) {
    double sum = 0.0;
    double slope = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      const double term = std::exp(log_coefficients[i] + exponents[i] * sigma);
      sum += term;
      slope += exponents[i] * term;
    }
    const double decrease = std::log(sum) * sum / slope;
    sigma -= decrease;
    if (std::abs(decrease) < kStepTolerance) break;
  }
  for (std::size_t i = 0; i < N; ++i) solution.terms[i] = std::exp(log_coefficients[i] + exponents[i] * sigma);
  return solution;
}

}  // namespace swarm_planner
