// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/config/scenario.hpp"
#include "yaml_reader.hpp"

namespace swarm_planner {

/// Reads the list `faults` of a scenario whose UAVs have been read.
void readFaultInjections(const YamlNode& node, const std::vector<ScenarioUav>& uavs,
                         std::vector<FaultInjection>& faults);

}  // namespace swarm_planner
