// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>

#include <limits>
#include <string>
#include <vector>

#include "swarm_planner/config/faults.hpp"
#include "swarm_planner/config/parameter_io.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// A parameter that only one node has, beside those of parameterTable().
struct NodeParameter {
  std::string name;
  std::string description;  ///< with its unit
  ParameterValue default_value;
  bool required = false;                                  ///< the default stands for "missing"
  double min = -std::numeric_limits<double>::infinity();  ///< of numbers, both ends allowed
  double max = std::numeric_limits<double>::infinity();
};

/// Every parameter in the node's private namespace. What is not a boolean, number or string is a fault.
ParameterMap readPrivateParameters(const ros::NodeHandle& private_node, Faults& faults);

/// Takes the parameters of `table` out of `given`: each with its default where it is not given, of the default's type
/// (integers serve as real numbers), within its range. Whatever is wrong is added to `faults`.
ParameterMap takeNodeParameters(const std::vector<NodeParameter>& table, ParameterMap& given, Faults& faults);

/// The scenario with the parameters that are left in `given`, every one of which must be in parameterTable(). Throws
/// ConfigError with one list of `node_faults` and all that is wrong with these.
Mission loadNodeMission(const std::string& scenario_path, const ParameterMap& given, const Faults& node_faults);

}  // namespace swarm_planner
