// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/power_sum.hpp"

#include <limits>

namespace swarm_planner {

namespace {

/// At least level^(1 / exponent). Bernoulli's inequality is tight for the levels near 1 that occur in flight and
/// spares a std::pow; far from 1 it would start Newton too far away.
double rootBound(double level, double exponent) {
  constexpr double kTight = 2.0;
  return level <= kTight ? 1.0 + (level - 1.0) / exponent : std::pow(level, 1.0 / exponent);
}

}  // namespace

double solveIntegerPowerSum(const std::array<double, 3>& y, const std::array<Exponent, 3>& exponents, double level) {
  /// Relative; the error after a step is about the exponent times the step squared.
  constexpr double kStepTolerance = 1e-9;

  // Axes with equal exponents share one term: count terms, coefficients c_k of v^{p_k}.
  std::array<double, 3> coefficients{};
  std::array<Exponent, 3> distinct;
  std::size_t count = 0;
  double v = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    if (y[i] == 0.0) continue;
    v = std::min(v, rootBound(level, exponents[i].value()) / y[i]);
    std::size_t k = 0;
    while (k < count && distinct[k].value() != exponents[i].value()) ++k;
    if (k == count) distinct[count++] = exponents[i];
    coefficients[k] += exponents[i].power(y[i]);
  }

  for (int step = 0; step < kMaxPowerSumSteps; ++step) {
    double sum = 0.0;
    double slope = 0.0;  // times v
    for (std::size_t k = 0; k < count; ++k) {
      const double term = coefficients[k] * distinct[k].power(v);
      sum += term;
      slope += distinct[k].value() * term;
    }
    const double decrease = (sum - level) / slope;  // relative to v
    v -= decrease * v;
    if (std::abs(decrease) < kStepTolerance) break;
  }
  return v;
}

}  // namespace swarm_planner
