// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "parameter_table.hpp"

namespace swarm_planner {

const ParameterEntry* findParameter(const std::string& name) {
  for (const ParameterEntry& entry : parameterEntries()) {
    if (entry.info.name == name) return &entry;
  }
  return nullptr;
}

const std::vector<ParameterInfo>& parameterTable() {
  static const std::vector<ParameterInfo> kTable = [] {
    std::vector<ParameterInfo> table;
    for (const ParameterEntry& entry : parameterEntries()) table.push_back(entry.info);
    return table;
  }();
  return kTable;
}

}  // namespace swarm_planner
