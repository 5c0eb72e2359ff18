// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>

namespace swarm_planner {

/// base^exponent for exponent >= 0 by repeated squaring.
inline double integerPower(double base, int exponent) {
  double result = 1.0;
  for (; exponent > 0; exponent >>= 1) {
    if ((exponent & 1) != 0) result *= base;
    base *= base;
  }
  return result;
}

/// A real exponent >= 2 of (7). Powers with small integers, the usual case, take a few multiplications
/// instead of std::pow.
class Exponent {
 public:
  Exponent() = default;
  explicit Exponent(double value)
      : value_(value), integer_(value <= kLargestInteger && std::floor(value) == value ? static_cast<int>(value) : 0) {}

  double value() const { return value_; }
  bool isSmallInteger() const { return integer_ > 0; }
  /// x^(value - lowered), x >= 0; `lowered` 0, 1 or 2 (for derivatives).
  double power(double x, int lowered = 0) const {
    return integer_ > 0 ? integerPower(x, integer_ - lowered) : std::pow(x, value_ - lowered);
  }

  /// x^(1 / value), x >= 0.
  double root(double x) const {
    if (integer_ == 2) return std::sqrt(x);
    if (integer_ == 4) return std::sqrt(std::sqrt(x));
    return std::pow(x, 1.0 / value_);
  }

 private:
  /// Beyond this std::pow is as fast and rounds better.
  static constexpr double kLargestInteger = 32.0;

  double value_ = 2.0;
  int integer_ = 2;
};

}  // namespace swarm_planner
