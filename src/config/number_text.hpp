// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>

namespace swarm_planner {

/// The number that a plain YAML scalar stands for, or nothing if it is no decimal number.
/// ".inf" gives infinity; ".nan" and literals too large for a double give NaN. Independent of the locale.
std::optional<double> parseNumber(const std::string& text);

/// The same for a whole number without point or exponent; nothing also if it does not fit an int.
std::optional<int> parseWholeNumber(const std::string& text);

/// The shortest decimal text that parseNumber() reads back as exactly `number`, in a form that every YAML
/// reader takes for a number. Independent of the locale.
std::string formatNumber(double number);

}  // namespace swarm_planner
