// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/ros/node_parameters.hpp"
#include "swarm_planner/ros/odometry_conversion.hpp"
#include "swarm_planner/swarm/planning_mode.hpp"

namespace swarm_planner {

/// When setpoints are sent. Their stamp is their epoch either way.
enum class SetpointDelivery {
  kAtOnce,   ///< up to a cycle period before the epoch, for drivers that honour the stamp
  kAtEpoch,  ///< when they take effect, for drivers that fly whatever comes at once
};

/// Parameters that planner_node has beside those of the planner: topics, frames, time to plan, messages, markers.
/// config/node.yaml describes each.
struct PlannerNodeOptions {
  std::string scenario;  ///< path of the scenario file
  PlanningMode mode = PlanningMode::kIterative;
  std::string odometry_topic;    ///< with {uav}
  std::string trajectory_topic;  ///< with {uav}
  std::string planning_frame;    ///< empty: the scenario's frame_id
  TwistFrame odometry_twist_frame = TwistFrame::kBody;
  double planning_share = 0.8;    ///< of the time until the epoch that planning may take
  double setpoint_dt = 0.05;      ///< [s]
  double setpoint_horizon = 0.0;  ///< [s], infinity: the whole plan
  SetpointDelivery setpoint_delivery = SetpointDelivery::kAtOnce;
  double marker_rate = 10.0;       ///< [Hz], 0: no markers
  double uav_marker_size = 0.0;    ///< [m], 0: by the scene's size
  double trail_duration = 60.0;    ///< [s]
  double diagnostic_period = 1.0;  ///< [s]
  std::string flight_record;       ///< path of FlightRecord, "auto": defaultRecordPath, empty: none
};

/// Every parameter of PlannerNodeOptions with default and range.
const std::vector<NodeParameter>& plannerNodeTable();

/// Takes the options out of `given`; what is wrong is added to `faults`.
PlannerNodeOptions takePlannerNodeOptions(ParameterMap& given, Faults& faults);

}  // namespace swarm_planner
