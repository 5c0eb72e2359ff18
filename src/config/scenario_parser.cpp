// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <filesystem>
#include <map>

#include "fault_reader.hpp"
#include "parameter_table.hpp"
#include "ros_names.hpp"
#include "scenario_limits.hpp"
#include "spelling.hpp"
#include "swarm_planner/config/scenario.hpp"
#include "yaml_reader.hpp"

namespace swarm_planner {

namespace {

using Range = NumberRange;

/// Remembers which values were seen under which key, and faults a repetition.
template <typename Value>
class Uniqueness {
 public:
  void check(const YamlMap& map, const std::string& key, const Value& value, const std::string& owner) {
    const auto [first, is_new] = owners_.emplace(value, owner);
    if (!is_new) map.find(key)->unexpected("another " + key + " than that of " + first->second);
  }

 private:
  std::map<Value, std::string> owners_;
};

void readEnd(const YamlNode& node, EndCondition& end) {
  const YamlMap map(node, {"target_x", "duration", "all_at_goal", "timeout", "tolerance"});
  if (!map.isMap()) return;
  const bool at_goal = map.has("all_at_goal");
  const int kinds = int{map.has("target_x")} + int{map.has("duration")} + int{at_goal};
  if (kinds != 1) {
    node.fault("found " + std::to_string(kinds) + " of target_x, duration and all_at_goal, expected exactly one");
  }
  double value = 0.0;
  if (map.has("target_x") && map.read("target_x", Range::finite(), value)) end.target_x = value;
  if (map.has("duration") && map.read("duration", Range::above(0.0), value)) end.duration = value;
  if (at_goal) {
    const std::optional<bool> given = map.find("all_at_goal")->boolean();
    if (given && !*given) map.find("all_at_goal")->unexpected("true (or target_x or duration in its place)");
    end.all_at_goal = given.value_or(false);
    map.read("timeout", Range::above(0.0), end.timeout);
    map.read("tolerance", Range::above(0.0), end.tolerance);
    return;
  }
  for (const char* key : {"timeout", "tolerance"}) {
    if (map.has(key)) map.find(key)->fault("only goes with all_at_goal");
  }
}

void readReference(const YamlMap& map, std::vector<Vector3>& reference) {
  const std::string expected = "a list of at least one point [x, y, z]";
  const YamlNode* node = map.require("reference", expected);
  const auto points = node ? node->list(expected) : std::nullopt;
  if (!points) return;
  if (points->empty()) node->unexpected(expected);
  for (const YamlNode& point : *points) {
    if (const std::optional<Vector3> position = point.vector3(Range::finite())) reference.push_back(*position);
  }
}

ScenarioUav readUav(const YamlNode& node, Uniqueness<std::string>& names) {
  const YamlMap map(node, {"name", "start", "reference", "target", "external"});
  ScenarioUav uav;
  if (map.read("name", uav.name)) {
    if (!isGraphName(uav.name)) {
      map.find("name")->unexpected("a relative ROS name: a letter, then letters, digits, underscores, single slashes");
    }
    names.check(map, "name", uav.name, node.key());
  }
  map.read("start", Range::finite(), uav.start);
  readReference(map, uav.reference);
  if (const YamlNode* target_node = map.require("target", "a map {start: [m], speed: [m/s]}")) {
    const YamlMap target(*target_node, {"start", "speed"});
    target.read("start", Range::atLeast(0.0), uav.target.start);
    target.read("speed", Range::atLeast(0.0), uav.target.speed);
  }
  if (const YamlNode* external = map.find("external")) uav.external = external->boolean().value_or(false);
  return uav;
}

ScenarioObstacle readObstacle(const YamlNode& node, Uniqueness<int>& ids) {
  const YamlMap map(node, {"id", "center", "radii", "exponents", "velocity", "yaw"});
  ScenarioObstacle obstacle;
  if (map.read("id", Range::atLeast(0.0), obstacle.id)) ids.check(map, "id", obstacle.id, node.key());
  map.read("center", Range::finite(), obstacle.center);
  map.read("radii", Range::above(0.0), obstacle.radii);
  map.read("exponents", Range::atLeast(2.0), obstacle.exponents);
  map.read("velocity", Range::finite(), obstacle.velocity);
  if (map.has("yaw")) map.read("yaw", Range::finite(), obstacle.yaw);
  return obstacle;
}

void readWorkspace(const YamlNode& node, std::optional<Workspace>& out) {
  const YamlMap map(node, {"min", "max"});
  Workspace workspace;
  const bool has_min = map.read("min", Range::finite(), workspace.min);
  const bool has_max = map.read("max", Range::finite(), workspace.max);
  if (!has_min || !has_max) return;
  if ((workspace.min.array() < workspace.max.array()).all()) {
    out = workspace;
  } else {
    node.fault("expected min < max in each coordinate");
  }
}

void readMap(const YamlNode& node, Scenario& scenario) {
  const YamlMap map(node, {"octomap", "unknown_space"});
  if (!map.isMap()) return;
  if (!map.has("octomap") && !map.has("unknown_space")) node.fault("found neither octomap nor unknown_space");
  if (map.has("octomap")) map.read("octomap", scenario.map_file);
  std::string unknown = "free";
  if (!map.has("unknown_space") || !map.read("unknown_space", unknown)) return;
  scenario.unknown_is_occupied = unknown == "occupied";
  if (unknown != "free" && unknown != "occupied") map.find("unknown_space")->unexpected("free or occupied");
}

void readOverrides(const YamlNode& node, std::map<std::string, double>& overrides) {
  const auto entries = node.entries();
  if (!entries) return;
  for (const auto& [name, value_node] : *entries) {
    if (const std::optional<std::string> message = overrideNameFault(name)) {
      value_node.fault(*message);
      continue;
    }
    const std::optional<double> value = value_node.anyNumber();
    if (value && !overrideFault(name, *value)) {
      overrides[name] = *value;
    } else {
      value_node.unexpected(expectedValue(*findParameter(name), false));
    }
  }
}

void readUavs(const YamlMap& root, std::vector<ScenarioUav>& uavs) {
  const std::string expected = "a list of at least one UAV";
  const YamlNode* node = root.require("uavs", expected);
  const auto elements = node ? node->list(expected) : std::nullopt;
  if (!elements) return;
  if (elements->empty()) node->unexpected(expected);
  Uniqueness<std::string> names;
  for (const YamlNode& element : *elements) uavs.push_back(readUav(element, names));
}

void readObstacles(const YamlNode& node, std::vector<ScenarioObstacle>& obstacles) {
  const auto elements = node.list("a list of obstacles");
  if (!elements) return;
  Uniqueness<int> ids;
  for (const YamlNode& element : *elements) obstacles.push_back(readObstacle(element, ids));
}

Scenario readScenario(const YamlNode& node) {
  const YamlMap root(node, {"name", "frame_id", "end", "uavs", "obstacles", "map", "workspace", "overrides", "faults"});
  Scenario scenario;
  root.read("name", scenario.name);
  if (root.read("frame_id", scenario.frame_id) && !isFrameName(scenario.frame_id)) {
    root.find("frame_id")->unexpected("a tf2 frame: no leading slash, no white space");
  }
  if (const YamlNode* end = root.require("end", "one of target_x, duration, all_at_goal")) readEnd(*end, scenario.end);
  readUavs(root, scenario.uavs);
  if (const YamlNode* obstacles = root.find("obstacles")) readObstacles(*obstacles, scenario.obstacles);
  if (const YamlNode* map = root.find("map")) readMap(*map, scenario);
  if (const YamlNode* workspace = root.find("workspace")) readWorkspace(*workspace, scenario.workspace);
  if (const YamlNode* overrides = root.find("overrides")) readOverrides(*overrides, scenario.overrides);
  if (const YamlNode* faults = root.find("faults")) readFaultInjections(*faults, scenario.uavs, scenario.faults);
  return scenario;
}

}  // namespace

Scenario parseScenarioText(const std::string& yaml, const std::string& source, Faults& faults) {
  const YamlSource yaml_source{source, faults};
  const std::optional<YamlNode> root = YamlNode::parse(yaml, yaml_source);
  const Scenario scenario = root ? readScenario(*root) : Scenario();
  addAbsurdNumbers(scenario, source, faults);
  return scenario;
}

Scenario parseScenarioFile(const std::string& path, Faults& faults) {
  const YamlSource yaml_source{path, faults};
  const std::optional<YamlNode> root = YamlNode::load(yaml_source);
  Scenario scenario = root ? readScenario(*root) : Scenario();
  // An absolute path stays itself.
  if (!scenario.map_file.empty()) {
    scenario.map_file = (std::filesystem::path(path).parent_path() / scenario.map_file).string();
  }
  addAbsurdNumbers(scenario, path, faults);
  return scenario;
}

}  // namespace swarm_planner
