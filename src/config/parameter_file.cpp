// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <set>

#include "parameter_table.hpp"
#include "spelling.hpp"
#include "yaml_reader.hpp"

namespace swarm_planner {

namespace {

/// Faults the parameters that `names` lacks of the shipped files that any of `names` belongs to.
void faultMissing(const YamlNode& root, const std::set<std::string>& names) {
  std::set<std::string> files;
  for (const std::string& name : names) files.insert(findParameter(name)->info.file);
  for (const ParameterEntry& entry : parameterEntries()) {
    if (files.count(entry.info.file) == 0 || names.count(entry.info.name) > 0) continue;
    root.faultAt(entry.info.name, "missing, expected " + expectedValue(entry, true));
  }
}

}  // namespace

ParameterMap parseParameterFile(const std::string& path, bool require_all, Faults& faults) {
  const YamlSource source{path, faults};
  const std::optional<YamlNode> root = YamlNode::load(source);
  const auto entries = root ? root->entries() : std::nullopt;
  if (!entries) return {};
  std::vector<std::string> known;
  for (const ParameterInfo& info : parameterTable()) known.push_back(info.name);
  ParameterMap parameters;
  std::set<std::string> names;
  for (const auto& [name, node] : *entries) {
    const ParameterEntry* entry = findParameter(name);
    if (entry == nullptr) {
      node.fault(unknownKeyMessage(name, known));
      continue;
    }
    names.insert(name);
    const std::optional<ParameterValue> value = node.scalar();
    if (value && !valueFault(*entry, *value)) {
      parameters[name] = *value;
    } else {
      node.unexpected(expectedValue(*entry, true));
    }
  }
  if (require_all) faultMissing(*root, names);
  return parameters;
}

}  // namespace swarm_planner
