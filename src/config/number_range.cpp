// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "number_range.hpp"

#include <cmath>

#include "number_text.hpp"

namespace swarm_planner {

namespace {

/// "finite" -> " finite", "> 0" -> " > 0", "[1, 2]" -> " in [1, 2]".
std::string condition(const NumberRange& range) {
  const std::string text = range.text();
  return (text.front() == '[' || text.front() == '(' ? " in " : " ") + text;
}

}  // namespace

NumberRange NumberRange::atLeast(double low) {
  NumberRange range;
  range.low = low;
  return range;
}

NumberRange NumberRange::above(double low) {
  NumberRange range = atLeast(low);
  range.low_open = true;
  return range;
}

NumberRange NumberRange::closed(double low, double high) {
  NumberRange range = atLeast(low);
  range.high = high;
  return range;
}

NumberRange NumberRange::aboveUpTo(double low, double high) {
  NumberRange range = closed(low, high);
  range.low_open = true;
  return range;
}

NumberRange NumberRange::open(double low, double high) {
  NumberRange range = aboveUpTo(low, high);
  range.high_open = true;
  return range;
}

bool NumberRange::contains(double number) const {
  if (std::isinf(number)) return allows_infinity && number > 0.0;
  const bool above_low = low_open ? number > low : number >= low;
  const bool below_high = high_open ? number < high : number <= high;
  return above_low && below_high;  // NaN compares false
}

std::string NumberRange::text() const {
  std::string text;
  if (std::isinf(low) && std::isinf(high)) {
    text = "finite";
  } else if (std::isinf(high)) {
    text = (low_open ? "> " : ">= ") + formatNumber(low);
  } else {
    text = (low_open ? "(" : "[") + formatNumber(low) + ", " + formatNumber(high) + (high_open ? ")" : "]");
  }
  return allows_infinity ? text + " or .inf" : text;
}

std::string numberIn(const NumberRange& range) {
  return range.text() == "finite" ? "a finite number" : "a number" + condition(range);
}

std::string wholeNumberIn(const NumberRange& range) { return "a whole number" + condition(range); }

std::string vectorIn(const NumberRange& range) {
  return range.text() == "finite" ? "a list of 3 finite numbers" : "a list of 3 numbers, each" + condition(range);
}

}  // namespace swarm_planner
