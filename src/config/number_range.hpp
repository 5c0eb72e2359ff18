// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <limits>
#include <string>

namespace swarm_planner {

/// The numbers that a key may take: an interval of finite numbers, optionally with +infinity.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;         ///< `low` itself is not allowed
  bool high_open = false;        ///< `high` itself is not allowed
  bool allows_infinity = false;  ///< +infinity is allowed, meaning "no limit"

  static NumberRange finite() { return {}; }
  static NumberRange atLeast(double low);
  static NumberRange above(double low);
  /// [low, high]
  static NumberRange closed(double low, double high);
  /// (low, high]
  static NumberRange aboveUpTo(double low, double high);
  /// (low, high)
  static NumberRange open(double low, double high);

  bool contains(double number) const;
  /// As in the documentation, e.g. "> 0" or "[1, 50]"; "finite" if there is no bound.
  std::string text() const;
};

/// Phrases for messages about what was expected, e.g. "a number > 0", "a whole number in [1, 50]",
/// "a list of 3 finite numbers".
std::string numberIn(const NumberRange& range);
std::string wholeNumberIn(const NumberRange& range);
std::string vectorIn(const NumberRange& range);

}  // namespace swarm_planner
