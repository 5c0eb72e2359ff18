// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "number_text.hpp"
#include "parameter_table.hpp"
#include "spelling.hpp"

namespace swarm_planner {

namespace {

constexpr const char* kAuto = "auto";

std::string foundText(const ParameterValue& value) {
  if (const bool* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  if (const int* whole = std::get_if<int>(&value)) return std::to_string(*whole);
  if (const double* number = std::get_if<double>(&value)) return formatNumber(*number);
  return quoted(std::get<std::string>(value));
}

/// An int stands for a double, as the ROS parameter server and YAML write 5 for 5.0.
std::optional<double> asNumber(const ParameterValue& value) {
  if (const int* whole = std::get_if<int>(&value)) return *whole;
  if (const double* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

bool isLegal(const ParameterEntry& entry, const ParameterValue& value) {
  if (isAuto(value)) return entry.info.has_rule;
  if (std::holds_alternative<bool& (*)(Parameters&)>(entry.slot)) return std::holds_alternative<bool>(value);
  const std::optional<double> number = asNumber(value);
  if (!number || !entry.range.contains(*number)) return false;
  // A double stands for an int if it is whole and fits: overrides of scenarios are doubles.
  const bool is_whole = std::holds_alternative<int& (*)(Parameters&)>(entry.slot);
  return !is_whole || (std::floor(*number) == *number && *number <= std::numeric_limits<int>::max());
}

}  // namespace

bool isAuto(const ParameterValue& value) {
  const std::string* text = std::get_if<std::string>(&value);
  return text != nullptr && *text == kAuto;
}

std::string expectedValue(const ParameterEntry& entry, bool or_auto) {
  std::string text;
  if (std::holds_alternative<bool& (*)(Parameters&)>(entry.slot)) {
    text = "true or false";
  } else if (std::holds_alternative<int& (*)(Parameters&)>(entry.slot)) {
    text = wholeNumberIn(entry.range);
  } else {
    text = numberIn(entry.range);
  }
  if (!entry.info.unit.empty()) text += " [" + entry.info.unit + "]";
  return or_auto && entry.info.has_rule ? text + " or auto" : text;
}

std::optional<std::string> valueFault(const ParameterEntry& entry, const ParameterValue& value) {
  if (isLegal(entry, value)) return std::nullopt;
  return "found " + foundText(value) + ", expected " + expectedValue(entry, true);
}

std::optional<std::string> expectedInstead(const std::string& name, const ParameterValue& value) {
  const ParameterEntry* entry = findParameter(name);
  if (entry == nullptr) throw std::invalid_argument("there is no parameter \"" + name + "\"");
  if (isLegal(*entry, value)) return std::nullopt;
  return expectedValue(*entry, true);
}

void store(const ParameterEntry& entry, const ParameterValue& value, Parameters& parameters) {
  if (isAuto(value)) return;
  std::visit(
      [&](const auto& get) {
        auto& target = get(parameters);
        using Target = std::remove_reference_t<decltype(target)>;
        if constexpr (std::is_same_v<Target, bool>) {
          target = std::get<bool>(value);
        } else {
          target = static_cast<Target>(*asNumber(value));
        }
      },
      entry.slot);
}

std::optional<std::string> overrideNameFault(const std::string& name) {
  const ParameterEntry* entry = findParameter(name);
  if (entry != nullptr && entry->info.overridable) return std::nullopt;
  if (entry != nullptr) return "cannot be set by a scenario, expected a planner or vehicle parameter that is a number";
  std::vector<std::string> known;
  for (const ParameterInfo& info : parameterTable()) {
    if (info.overridable) known.push_back(info.name);
  }
  return unknownKeyMessage(name, known);
}

std::optional<std::string> overrideFault(const std::string& name, double value) {
  if (std::optional<std::string> name_fault = overrideNameFault(name)) return name_fault;
  const ParameterEntry& entry = *findParameter(name);
  if (isLegal(entry, value)) return std::nullopt;
  return "found " + foundText(value) + ", expected " + expectedValue(entry, false);
}

}  // namespace swarm_planner
