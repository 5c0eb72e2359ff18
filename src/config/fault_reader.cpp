// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "fault_reader.hpp"

#include <algorithm>
#include <string>

namespace swarm_planner {
namespace {

void readUavName(const YamlMap& map, const FaultKindInfo& info, const std::vector<ScenarioUav>& uavs,
                 std::string& name) {
  if (!info.of_uav) {
    if (map.has("uav")) map.find("uav")->fault(std::string("does not go with ") + info.name + ", of the whole swarm");
    return;
  }
  if (!map.read("uav", name)) return;
  const bool known = std::any_of(uavs.begin(), uavs.end(), [&](const ScenarioUav& uav) { return uav.name == name; });
  if (!known) map.find("uav")->unexpected("the name of a UAV of this scenario");
}

void readDuration(const YamlMap& map, const FaultKindInfo& info, double& duration) {
  if (info.lasts) {
    map.read("duration", NumberRange::aboveUpTo(0.0, kLongestFault), duration);
  } else if (map.has("duration")) {
    map.find("duration")->fault(std::string("does not go with ") + info.name + ", which happens at one instant");
  }
}

void readMagnitude(const YamlMap& map, const FaultKindInfo& info, double& magnitude) {
  magnitude = info.default_magnitude;
  if (!map.has("magnitude")) return;
  if (info.magnitude != nullptr) {
    map.read("magnitude", NumberRange::aboveUpTo(0.0, info.most_magnitude), magnitude);
  } else {
    map.find("magnitude")->fault(std::string("does not go with ") + info.name);
  }
}

FaultInjection readFaultInjection(const YamlNode& node, const std::vector<ScenarioUav>& uavs) {
  const YamlMap map(node, {"kind", "uav", "at", "duration", "magnitude"});
  FaultInjection fault;
  map.read("at", NumberRange::atLeast(0.0), fault.at);
  std::string kind;
  if (!map.read("kind", kind)) return fault;
  const FaultKindInfo* info = findFaultKind(kind);
  if (info == nullptr) {
    map.find("kind")->unexpected("one of " + faultKindNames());
    return fault;
  }
  fault.kind = info->kind;
  readUavName(map, *info, uavs, fault.uav);
  readDuration(map, *info, fault.duration);
  readMagnitude(map, *info, fault.magnitude);
  return fault;
}

}  // namespace

void readFaultInjections(const YamlNode& node, const std::vector<ScenarioUav>& uavs,
                         std::vector<FaultInjection>& faults) {
  const auto elements = node.list("a list of faults to inject");
  if (!elements) return;
  for (const YamlNode& element : *elements) faults.push_back(readFaultInjection(element, uavs));
}

}  // namespace swarm_planner
