// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/timer.h>
#include <ros/wall_timer.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/SetReference.h"
#include "swarm_planner/ros/clock_watch.hpp"
#include "swarm_planner/ros/command_services.hpp"
#include "swarm_planner/ros/flight_record.hpp"
#include "swarm_planner/ros/map_input.hpp"
#include "swarm_planner/ros/map_markers.hpp"
#include "swarm_planner/ros/marker_publisher.hpp"
#include "swarm_planner/ros/planner_diagnostics.hpp"
#include "swarm_planner/ros/planner_inputs.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/ros/planner_outputs.hpp"
#include "swarm_planner/ros/planning_budget.hpp"
#include "swarm_planner/swarm/guide_thread.hpp"
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
  /// Opens the flight's record and takes the operators' orders of a planner before from it.
  void openRecord(const std::string& path, const Mission& mission);
  /// Takes over what UAVs fly from the record, in the first cycle.
  void takeOver(double now);
  /// Writes down what UAVs have been told to do, for a planner that may have to take over.
  void keepModes();
  /// Diagnostics, in wall time: they go on where ROS time does not.
  void reportHealth();
  bool setReference(SetReference::Request& request, SetReference::Response& response);
  void refuseReference(const std::string& why, SetReference::Response& response);
  std::vector<Vector3> pathInPlanningFrame(const SetReference::Request& request) const;
  std::size_t uavIndex(const std::string& name) const;

  SwarmPlanner planner_;
  GuideThread guides_;  ///< searches for planner_
  const std::vector<std::string> names_;
  const std::string frame_;
  const double cycle_period_;  ///< [s]
  const int setpoint_repeats_;
  PlannerInputs inputs_;
  MapMarkers map_markers_;
  MapInput maps_;
  PlannerOutputs outputs_;
  PlannerDiagnostics diagnostics_;
  MarkerPublisher markers_;

  std::unique_ptr<FlightRecord> record_;  ///< null: none is kept
  ClockWatch clock_;
  const double track_timeout_;        ///< [s]
  double next_health_warning_ = 0.0;  ///< wall time [s]
  bool has_cycled_ = false;
  std::vector<FlightMode> modes_;  ///< of the UAVs, as last kept

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
