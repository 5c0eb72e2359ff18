// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <string>

#include "number_text.hpp"
#include "ros_names.hpp"
#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

namespace {

std::string vectorText(const Vector3& vector) {
  return "[" + formatNumber(vector.x()) + ", " + formatNumber(vector.y()) + ", " + formatNumber(vector.z()) + "]";
}

/// In quotes, so that no text is taken for another type; "name" stays plain where that is safe.
std::string scalarText(const std::string& text) {
  static const std::string kReserved[] = {"true", "false", "yes", "no", "on", "off", "y", "n", "null"};
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const bool is_reserved = std::find(std::begin(kReserved), std::end(kReserved), lower) != std::end(kReserved);
  if (isGraphName(text) && !is_reserved) return text;
  constexpr const char* kHex = "0123456789abcdef";
  std::string quoted_text = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted_text += {'\\', c};
    } else if (static_cast<unsigned char>(c) < ' ') {
      quoted_text += {'\\', 'x', kHex[c / 16], kHex[c % 16]};
    } else {
      quoted_text += c;
    }
  }
  return quoted_text + '"';
}

std::string endText(const EndCondition& end) {
  if (end.target_x) return "{target_x: " + formatNumber(*end.target_x) + "}";
  if (end.duration) return "{duration: " + formatNumber(*end.duration) + "}";
  return "{all_at_goal: true, timeout: " + formatNumber(end.timeout) + ", tolerance: " + formatNumber(end.tolerance) +
         "}";
}

std::string uavText(const ScenarioUav& uav) {
  std::string points;
  for (const Vector3& point : uav.reference) points += (points.empty() ? "" : ", ") + vectorText(point);
  return "  - name: " + scalarText(uav.name) + "\n    start: " + vectorText(uav.start) + "\n    reference: [" + points +
         "]\n    target: {start: " + formatNumber(uav.target.start) + ", speed: " + formatNumber(uav.target.speed) +
         (uav.external ? "}\n    external: true\n" : "}\n");
}

std::string obstacleText(const ScenarioObstacle& obstacle) {
  std::string text = "  - {id: " + std::to_string(obstacle.id) + ", center: " + vectorText(obstacle.center) +
                     ", radii: " + vectorText(obstacle.radii) + ", exponents: " + vectorText(obstacle.exponents) +
                     ", velocity: " + vectorText(obstacle.velocity);
  if (obstacle.yaw != 0.0) text += ", yaw: " + formatNumber(obstacle.yaw);
  return text + "}\n";
}

std::string faultText(const FaultInjection& fault) {
  const FaultKindInfo& info = faultKindInfo(fault.kind);
  std::string text = std::string("  - {kind: ") + info.name;
  if (info.of_uav) text += ", uav: " + scalarText(fault.uav);
  text += ", at: " + formatNumber(fault.at);
  if (info.lasts) text += ", duration: " + formatNumber(fault.duration);
  if (info.magnitude != nullptr) text += ", magnitude: " + formatNumber(fault.magnitude);
  return text + "}\n";
}

std::string mapText(const Scenario& scenario) {
  if (scenario.map_file.empty() && !scenario.unknown_is_occupied) return "";
  std::string text;
  if (!scenario.map_file.empty()) text = "octomap: " + scalarText(scenario.map_file);
  if (scenario.unknown_is_occupied) text += std::string(text.empty() ? "" : ", ") + "unknown_space: occupied";
  return "map: {" + text + "}\n";
}

std::string overridesText(const std::map<std::string, double>& overrides) {
  std::string text;
  for (const auto& [name, value] : overrides) text += "  " + name + ": " + formatNumber(value) + "\n";
  return text;
}

}  // namespace

std::string toYaml(const Scenario& scenario) {
  std::string text = "name: " + scalarText(scenario.name) + "\nframe_id: " + scalarText(scenario.frame_id) +
                     "\nend: " + endText(scenario.end) + (scenario.uavs.empty() ? "\nuavs: []\n" : "\nuavs:\n");
  for (const ScenarioUav& uav : scenario.uavs) text += uavText(uav);
  text += scenario.obstacles.empty() ? "obstacles: []\n" : "obstacles:\n";
  for (const ScenarioObstacle& obstacle : scenario.obstacles) text += obstacleText(obstacle);
  text += mapText(scenario);
  if (scenario.workspace) {
    text += "workspace: {min: " + vectorText(scenario.workspace->min) +
            ", max: " + vectorText(scenario.workspace->max) + "}\n";
  }
  if (!scenario.overrides.empty()) text += "overrides:\n" + overridesText(scenario.overrides);
  if (!scenario.faults.empty()) text += "faults:\n";
  for (const FaultInjection& fault : scenario.faults) text += faultText(fault);
  return text;
}

}  // namespace swarm_planner
