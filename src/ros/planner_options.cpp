// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planner_options.hpp"

#include <limits>

#include "swarm_planner/ros/node_constants.hpp"

namespace swarm_planner {
namespace {

void requirePlaceholder(const std::string& name, const std::string& pattern, Faults& faults) {
  if (pattern.find(kUavPlaceholder) == std::string::npos) {
    faults.add("parameters", name, "is '" + pattern + "', expected a topic with " + kUavPlaceholder + " in it");
  }
}

TwistFrame twistFrame(const std::string& name, Faults& faults) {
  if (name == "world") return TwistFrame::kWorld;
  if (name != "body") faults.add("parameters", "odometry_twist_frame", "is '" + name + "', expected body or world");
  return TwistFrame::kBody;
}

PlanningMode planningMode(const std::string& name, Faults& faults) {
  const std::optional<PlanningMode> mode = planningModeFrom(name);
  if (!mode) faults.add("parameters", "mode", "is '" + name + "', expected iterative, joint or groups");
  return mode.value_or(PlanningMode::kIterative);
}

SetpointDelivery setpointDelivery(const std::string& name, Faults& faults) {
  if (name == "at_epoch") return SetpointDelivery::kAtEpoch;
  if (name != "at_once")
    faults.add("parameters", "setpoint_delivery", "is '" + name + "', expected at_once or at_epoch");
  return SetpointDelivery::kAtOnce;
}

}  // namespace

const std::vector<NodeParameter>& plannerNodeTable() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static const std::vector<NodeParameter> table = {
      {"scenario", "path of the scenario file", std::string(), true},
      {"mode",
       "how plans are made: iterative, UAV by UAV, joint, at once for a small swarm, or groups, at once for "
       "those that interact strongly",
       std::string("iterative")},
      {"odometry_topic", "odometry of a UAV, {uav} stands for its name", std::string(kDefaultOdometryTopic)},
      {"trajectory_topic", "setpoints of a UAV, {uav} stands for its name", std::string(kDefaultTrajectoryTopic)},
      {"planning_frame", "frame to plan in, empty: the scenario's frame_id", std::string()},
      {"odometry_twist_frame", "axes of odometry twists: body or world", std::string("body")},
      {"planning_share", "of the time until the epoch that planning may take", 0.8, false, 0.001, 1.0},
      {"setpoint_dt", "time between setpoints [s]", 0.05, false, 0.001, 1.0},
      {"setpoint_horizon", "time that setpoints cover [s], .inf: the whole plan", kInfinity, false, 0.001},
      {"setpoint_delivery", "when setpoints are sent: at_once or at_epoch", std::string("at_once")},
      {"marker_rate", "markers for rviz [Hz], 0: none", 10.0, false, 0.0, 100.0},
      {"uav_marker_size", "drawn width of a UAV [m], 0: by the scene's size", 0.0, false, 0.0, 1000.0},
      {"trail_duration", "flown path to draw [s]", 60.0, false, 0.0, 3600.0},
      {"diagnostic_period", "time between diagnostics [s]", 1.0, false, 0.1, 60.0},
      {"flight_record", "path of the flight's record: auto, a path, or empty for none", std::string("auto")},
  };
  return table;
}

PlannerNodeOptions takePlannerNodeOptions(ParameterMap& given, Faults& faults) {
  const ParameterMap values = takeNodeParameters(plannerNodeTable(), given, faults);
  const auto text = [&values](const char* name) { return std::get<std::string>(values.at(name)); };
  const auto number = [&values](const char* name) { return std::get<double>(values.at(name)); };
  PlannerNodeOptions options;
  options.scenario = text("scenario");
  options.mode = planningMode(text("mode"), faults);
  options.odometry_topic = text("odometry_topic");
  options.trajectory_topic = text("trajectory_topic");
  options.planning_frame = text("planning_frame");
  options.odometry_twist_frame = twistFrame(text("odometry_twist_frame"), faults);
  options.planning_share = number("planning_share");
  options.setpoint_dt = number("setpoint_dt");
  options.setpoint_horizon = number("setpoint_horizon");
  options.setpoint_delivery = setpointDelivery(text("setpoint_delivery"), faults);
  options.marker_rate = number("marker_rate");
  options.uav_marker_size = number("uav_marker_size");
  options.trail_duration = number("trail_duration");
  options.diagnostic_period = number("diagnostic_period");
  options.flight_record = text("flight_record");
  requirePlaceholder("odometry_topic", options.odometry_topic, faults);
  requirePlaceholder("trajectory_topic", options.trajectory_topic, faults);
  return options;
}

}  // namespace swarm_planner
