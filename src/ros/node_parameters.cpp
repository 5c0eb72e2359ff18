// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/node_parameters.hpp"

#include <ros/param.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cmath>
#include <cstdio>
#include <variant>

namespace swarm_planner {
namespace {

constexpr char kSource[] = "parameters";

const char* typeText(const ParameterValue& value) {
  if (std::holds_alternative<bool>(value)) return "true or false";
  if (std::holds_alternative<int>(value)) return "an integer";
  if (std::holds_alternative<double>(value)) return "a number";
  return "a string";
}

// `value` as the type of `like`; false if it is of another type.
bool convertType(const ParameterValue& like, ParameterValue& value) {
  if (std::holds_alternative<double>(like) && std::holds_alternative<int>(value)) {
    value = static_cast<double>(std::get<int>(value));
  }
  return value.index() == like.index();
}

std::string rangeText(const NodeParameter& parameter) {
  char text[80];
  std::snprintf(text, sizeof(text), "[%g, %g]", parameter.min, parameter.max);
  return text;
}

void checkRange(const NodeParameter& parameter, const ParameterValue& value, Faults& faults) {
  double number = 0.0;
  if (std::holds_alternative<double>(value)) {
    number = std::get<double>(value);
  } else if (std::holds_alternative<int>(value)) {
    number = std::get<int>(value);
  } else {
    return;
  }
  if (!(number >= parameter.min && number <= parameter.max)) {
    faults.add(kSource, parameter.name, "is " + std::to_string(number) + ", expected within " + rangeText(parameter));
  }
}

}  // namespace

ParameterMap readPrivateParameters(const ros::NodeHandle& private_node, Faults& faults) {
  ParameterMap values;
  XmlRpc::XmlRpcValue tree;
  if (!ros::param::get(private_node.getNamespace(), tree)) return values;
  for (auto& [name, value] : tree) {
    switch (value.getType()) {
      case XmlRpc::XmlRpcValue::TypeBoolean:
        values[name] = static_cast<bool>(value);
        break;
      case XmlRpc::XmlRpcValue::TypeInt:
        values[name] = static_cast<int>(value);
        break;
      case XmlRpc::XmlRpcValue::TypeDouble:
        values[name] = static_cast<double>(value);
        break;
      case XmlRpc::XmlRpcValue::TypeString:
        values[name] = static_cast<std::string>(value);
        break;
      default:
        faults.add(kSource, name, "is a list or a map, expected true, false, a number or a string");
    }
  }
  return values;
}

ParameterMap takeNodeParameters(const std::vector<NodeParameter>& table, ParameterMap& given, Faults& faults) {
  ParameterMap taken;
  for (const NodeParameter& parameter : table) {
    taken[parameter.name] = parameter.default_value;
    const auto entry = given.find(parameter.name);
    if (entry == given.end()) {
      if (parameter.required) faults.add(kSource, parameter.name, "is missing: " + parameter.description);
      continue;
    }
    ParameterValue value = entry->second;
    given.erase(entry);
    if (!convertType(parameter.default_value, value)) {
      faults.add(kSource, parameter.name,
                 std::string("has the wrong type, expected ") + typeText(parameter.default_value));
      continue;
    }
    checkRange(parameter, value, faults);
    taken[parameter.name] = value;
  }
  return taken;
}

Mission loadNodeMission(const std::string& scenario_path, const ParameterMap& given, const Faults& node_faults) {
  std::string text = node_faults.text();
  try {
    // Without a scenario the other parameters are still worth checking.
    if (scenario_path.empty()) {
      Faults faults;
      resolveParameters(given, {}, "", faults);
      throw ConfigError(faults.text());
    }
    Mission mission = loadMission(scenario_path, given);
    if (node_faults.empty()) return mission;
  } catch (const ConfigError& error) {
    if (!text.empty() && text.back() != '\n') text += '\n';
    text += error.what();
  }
  throw ConfigError(text);
}

}  // namespace swarm_planner
