// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/power_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {

namespace {

/// An upper bound of the root, or nearly one, from which no power overflows.
double startingPoint(const std::array<double, 3>& terms, const std::array<Exponent, 3>& exponents, std::size_t largest,
                     double level) {
  // The levels of flight are close above 1. There Bernoulli's inequality level^(1/p) <= 1 + (level - 1) / p is tight.
  constexpr double kCloseAbove = 2.0;
  if (level <= kCloseAbove) return 1.0 + (level - 1.0) / exponents[largest].value();
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) bound = std::min(bound, std::pow(level / terms[i], 1.0 / exponents[i].value()));
  return bound;
}

}  // namespace

double solveIntegerPowerSum(const std::array<double, 3>& terms, const std::array<Exponent, 3>& exponents,
                            std::size_t largest, double level) {
  /// Relative; the error after a step is about the square of the exponent times the third power of the step.
  constexpr double kStepTolerance = 1e-6;

  double v = startingPoint(terms, exponents, largest, level);
  for (int step = 0; step < kMaxPowerSumSteps; ++step) {
    double sum = 0.0;
    double first = 0.0;  // derivatives of the sum with respect to ln v
    double second = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double p = exponents[i].value();
      const double term = terms[i] * exponents[i].power(v);
      sum += term;
      first += p * term;
      second += p * p * term;
    }
    // Halley's step for ln sum = ln level, which is nearly linear in ln v, over one denominator: divisions would cost
    // the most. 2 (sum - level) / (sum + level) stands for the logarithm and 1 - x + x^2 / 2 for the exponential: both
    // are exact to the second order. Far from the root the step falls back to half a denominator, at most twice
    // Newton's.
    const double excess = 2.0 * (sum - level);
    const double newton = first * first * (sum + level);
    const double halley = newton - 0.5 * excess * (second * sum - first * first);
    const double decrease = sum * excess * first / std::max(0.5 * newton, halley);
    v *= 1.0 - decrease * (1.0 - 0.5 * decrease);
    if (std::abs(decrease) < kStepTolerance) break;
  }
  return v;
}

}  // namespace swarm_planner
