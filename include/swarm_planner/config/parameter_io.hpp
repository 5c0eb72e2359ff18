// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "swarm_planner/config/faults.hpp"
#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

/// What a parameter may be given as. The string "auto" asks for the documented rule where one exists.
using ParameterValue = std::variant<bool, int, double, std::string>;

/// Flat name -> value, as read from YAML or from the ROS parameter server.
using ParameterMap = std::map<std::string, ParameterValue>;

/// One line of the parameter table.
struct ParameterInfo {
  std::string name;  ///< flat name, e.g. "max_speed"
  std::string unit;  ///< e.g. "m/s", "" if none
  std::string description;
  ParameterValue default_value;  ///< "auto" where a rule gives it
  std::string range;             ///< allowed values, e.g. "> 0", "[1, 50]", "true or false"
  std::string file;              ///< the shipped file that lists it: "planner.yaml" or "simulation.yaml"
  bool has_rule = false;         ///< may be "auto"
  bool overridable = false;      ///< scenarios may set it: planner and vehicle parameters, not simulation or input
};

/// Every parameter, in the order of the shipped YAML.
const std::vector<ParameterInfo>& parameterTable();

/// What parameter `name` takes, e.g. "a number > 0 [m]", if `value` is not allowed; nothing if it is. Throws
/// std::invalid_argument if there is no such parameter.
std::optional<std::string> expectedInstead(const std::string& name, const ParameterValue& value);

/// Reads a file of parameters such as config/planner.yaml (a flat map). Faults as for scenarios; a value with a
/// fault is left out of the map. With `require_all` every parameter of the shipped files that this file has a
/// parameter of must be there: a planner.yaml need not hold the parameters of simulation.yaml.
ParameterMap parseParameterFile(const std::string& path, bool require_all, Faults& faults);

/// Values by precedence: scenario overrides, then `given`, then defaults; then the rules for whatever is
/// still "auto" or unset; then every range check, also of one parameter against another. Faults name the key and
/// the allowed range; their source is `overrides_source` (key "overrides.<name>") or "parameters".
/// The rules (documented in doc/parameters.md):
///   sampling_time = pair_distance / max_speed rounded down to 0.05 s, within [0.15, 0.3]
///   cycle_period = sampling_time
///   zeta = 0.05 (sampling_time / 0.3 s)^3, so that jerks do not grow faster than attitude follows
///   velocity_time = sampling_time / 0.3 s * 0.8 s
///   pair_distance_vertical = pair_distance
///   tracking_margin = a tenth of the smaller of uav_radius*2 and pair_distance, within [0.02, 0.2]
///   pair_margin = a tenth of pair_distance, at most 0.2, and at least tracking_margin
///   tracking_error = half of tracking_margin, at most a quarter of pair_margin
///   setpoint_repeats = 1 where simulated links lose messages (drop > 0), otherwise 0
/// With as_paper: plan_check, segment_constraints, guide, right_of_way and latency_compensation are false, whatever is
/// given.
Parameters resolveParameters(const ParameterMap& given, const std::map<std::string, double>& overrides,
                             const std::string& overrides_source, Faults& faults);

}  // namespace swarm_planner
