// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/run_report.hpp"

#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

namespace swarm_planner {
namespace {

std::string jsonNumber(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return "null";
  std::ostringstream text;
  text << std::setprecision(9) << *value;
  return text.str();
}

std::string jsonString(const std::string& value) {
  std::ostringstream text;
  text << '"';
  for (const char c : value) {
    if (c == '"' || c == '\\') text << '\\';
    if (static_cast<unsigned char>(c) >= 0x20) text << c;
  }
  text << '"';
  return text.str();
}

std::string jsonMeanMax(double mean, double max) {
  return "{\"mean\": " + jsonNumber(mean) + ", \"max\": " + jsonNumber(max) + "}";
}

std::string metres(std::optional<double> value) {
  if (!value) return "none to measure";
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << *value << " m";
  return text.str();
}

}  // namespace

std::string toText(const RunReport& report) {
  const RunSummary& summary = report.summary;
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  text << "Run of '" << report.scenario << "' with " << report.uavs << " UAVs: "
       << (report.clear()               ? "every UAV kept clear"
           : summary.collisions.empty() ? "interrupted"
                                        : "COLLISION")
       << "\n";
  text << "  ended by             " << report.ended_by << " after " << summary.mission_time << " s\n";
  text << "  collisions           " << summary.collisions.size() << "\n";
  text << "  least distance       " << metres(summary.min_uav_distance) << " between UAVs, "
       << metres(summary.min_obstacle_clearance) << " clearance to obstacles\n";
  text << "  final lag            " << summary.final_lag.mean << " m mean, " << summary.final_lag.max << " m max\n";
  text << "  tracking error       " << summary.tracking_error.mean << " m mean, " << summary.tracking_error.max
       << " m max\n";
  text << "  stuck, arrived       " << summary.stuck_uavs << ", " << summary.arrived_uavs << "\n";
  text << "  planning cycles      " << report.cycles << ", " << 1e3 * report.cycle_time_mean << " ms mean, "
       << 1e3 * report.cycle_time_max << " ms max, " << report.deadline_misses << " deadlines missed";
  return text.str();
}

std::string toJson(const RunReport& report) {
  const RunSummary& summary = report.summary;
  std::ostringstream json;
  json << "{\"clear\": " << (report.clear() ? "true" : "false") << ", \"scenario\": " << jsonString(report.scenario)
       << ", \"ended_by\": " << jsonString(report.ended_by) << ", \"uavs\": " << report.uavs
       << ", \"collisions\": " << summary.collisions.size()
       << ", \"min_uav_distance_m\": " << jsonNumber(summary.min_uav_distance)
       << ", \"min_obstacle_clearance_m\": " << jsonNumber(summary.min_obstacle_clearance)
       << ", \"final_lag_m\": " << jsonMeanMax(summary.final_lag.mean, summary.final_lag.max)
       << ", \"stuck_uavs\": " << summary.stuck_uavs << ", \"arrived_uavs\": " << summary.arrived_uavs
       << ", \"mission_time_s\": " << jsonNumber(summary.mission_time)
       << ", \"path_length_m\": " << jsonNumber(summary.path_length)
       << ", \"tracking_error_m\": " << jsonMeanMax(summary.tracking_error.mean, summary.tracking_error.max)
       << ", \"workspace_violations\": " << summary.workspace_violations << ", \"cycles\": " << report.cycles
       << ", \"cycle_ms\": " << jsonMeanMax(1e3 * report.cycle_time_mean, 1e3 * report.cycle_time_max)
       << ", \"deadline_misses\": " << report.deadline_misses << ", \"cost\": " << jsonNumber(summary.cost) << "}";
  return json.str();
}

}  // namespace swarm_planner
