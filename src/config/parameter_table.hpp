// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "number_range.hpp"
#include "swarm_planner/config/parameter_io.hpp"

namespace swarm_planner {

/// Where a parameter lives in Parameters. The slot's type is the parameter's type.
using ParameterSlot = std::variant<double& (*)(Parameters&), int& (*)(Parameters&), bool& (*)(Parameters&)>;

/// A line of the parameter table with what reading, checking and storing it takes.
struct ParameterEntry {
  ParameterInfo info;
  NumberRange range;  ///< of numbers; unused for booleans
  ParameterSlot slot;
};

/// The one table that drives defaults, reading, checks and documentation.
const std::vector<ParameterEntry>& parameterEntries();

/// The entry of that name, or null.
const ParameterEntry* findParameter(const std::string& name);

/// What is wrong with `value` for this parameter, "found ..., expected ...", or nothing.
std::optional<std::string> valueFault(const ParameterEntry& entry, const ParameterValue& value);

/// The same for a scenario's override, which may also name an unknown parameter or one that it must not set.
std::optional<std::string> overrideFault(const std::string& name, double value);

/// The part of overrideFault() that concerns the name.
std::optional<std::string> overrideNameFault(const std::string& name);

/// What a value of this parameter should be, e.g. "a number > 0 [m]"; with `or_auto` the rule is mentioned.
std::string expectedValue(const ParameterEntry& entry, bool or_auto);

/// "auto" asks for the parameter's rule.
bool isAuto(const ParameterValue& value);

/// Stores a value without valueFault(); "auto" leaves the parameter alone.
void store(const ParameterEntry& entry, const ParameterValue& value, Parameters& parameters);

}  // namespace swarm_planner
