// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/timer.h>
#include <ros/wall_timer.h>

#include <cstdint>
#include <string>
#include <vector>

#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/SetReference.h"
#include "swarm_planner/ros/command_services.hpp"
#include "swarm_planner/ros/marker_publisher.hpp"
#include "swarm_planner/ros/planner_diagnostics.hpp"
#include "swarm_planner/ros/planner_inputs.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/ros/planner_outputs.hpp"
#include "swarm_planner/ros/planning_budget.hpp"
#include "swarm_planner/swarm/mission.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// Runs the planner under ROS: every cycle period a snapshot of the inputs, new plans for the epoch one period ahead,
/// setpoints, plans, status, diagnostics. Cycle, service and diagnostics share the global queue and so exclude each
/// other; inputs and markers have their own thread.
class PlannerNode {
 public:
  /// Starts cycling as soon as callbacks are served.
  PlannerNode(SwarmPlanner planner, const Mission& mission, const PlannerNodeOptions& options);

 private:
  void runCycle(const ros::TimerEvent& event);
  void publishCycle(double now, bool deadline_missed);
  /// Spreads the repeats of this cycle's setpoints over the time until the next cycle.
  void startRepeats();
  void repeatSetpoints(const ros::TimerEvent& event);
  /// Warns of UAVs that do not track, and raises the alarm for those that are not safe.
  void tellOperator() const;
  void resetAfterTimeJump(double now);
  void advertiseServices();
  bool setReference(SetReference::Request& request, SetReference::Response& response);
  void refuseReference(const std::string& why, SetReference::Response& response);
  std::vector<Vector3> pathInPlanningFrame(const SetReference::Request& request) const;
  std::size_t uavIndex(const std::string& name) const;

  SwarmPlanner planner_;
  const std::vector<std::string> names_;
  const std::string frame_;
  const double cycle_period_;  ///< [s]
  const int setpoint_repeats_;
  PlannerInputs inputs_;
  PlannerOutputs outputs_;
  PlannerDiagnostics diagnostics_;
  MarkerPublisher markers_;

  PlanningBudget budget_;
  Snapshot snapshot_;
  PlannerStatus status_;
  double last_now_ = 0.0;    ///< ROS time of the last cycle [s]
  double last_epoch_ = 0.0;  ///< of the last cycle's plans [s]
  int repeats_left_ = 0;     ///< of the last cycle's setpoints
  std::uint32_t deadline_misses_ = 0;
  std::uint32_t rejected_plans_ = 0;

  ros::Timer cycle_timer_;
  ros::Timer repeat_timer_;
  ros::WallTimer diagnostics_timer_;
  ros::ServiceServer set_reference_server_;
  CommandServices commands_;
};

}  // namespace swarm_planner
