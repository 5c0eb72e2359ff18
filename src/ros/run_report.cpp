// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/run_report.hpp"

#include <iomanip>
#include <optional>
#include <sstream>

#include "swarm_planner/experiments/json_object.hpp"

namespace swarm_planner {
namespace {

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
  const RunSummary& flown = report.summary;
  JsonObject object;
  object.addFlag("clear", report.clear())
      .add("scenario", report.scenario)
      .add("ended_by", report.ended_by)
      .addCount("uavs", report.uavs)
      .addCount("cycles", report.cycles)
      .add("cycle_ms", toObject(MeanMax{1e3 * report.cycle_time_mean, 1e3 * report.cycle_time_max}))
      .addCount("deadline_misses", report.deadline_misses)
      .addCount("collisions", flown.collisions.size())
      .add("min_uav_distance_m", flown.min_uav_distance)
      .add("min_obstacle_clearance_m", flown.min_obstacle_clearance)
      .add("final_lag_m", toObject(flown.final_lag))
      .addCount("stuck_uavs", static_cast<unsigned>(flown.stuck_uavs))
      .addCount("arrived_uavs", static_cast<unsigned>(flown.arrived_uavs))
      .add("mission_time_s", flown.mission_time)
      .add("path_length_m", flown.path_length)
      .add("tracking_error_m", toObject(flown.tracking_error))
      .addCount("workspace_violations", static_cast<unsigned>(flown.workspace_violations))
      .add("cost", flown.cost);
  return object.text();
}

}  // namespace swarm_planner
