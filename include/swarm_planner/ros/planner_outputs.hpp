// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <string>
#include <vector>

#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/SwarmPlan.h"
#include "swarm_planner/model/setpoints.hpp"
#include "swarm_planner/ros/input_store.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// Publishes what a cycle decided: setpoints for every UAV that has a plan, the exact plans, the status.
class PlannerOutputs {
 public:
  PlannerOutputs(const std::vector<std::string>& uav_names, const std::string& planning_frame,
                 const PlannerNodeOptions& options);

  /// Setpoints first: vehicles wait for them. A UAV without a plan gets none. `inputs`: yaw is held as at the start.
  void publishPlans(const SwarmPlanner& planner, const std::vector<UavInput>& inputs, double now);
  void publishStatus(const PlannerStatus& status) { status_.publish(status); }

 private:
  const std::string frame_;
  const double setpoint_dt_;
  const double setpoint_horizon_;
  std::vector<ros::Publisher> setpoints_;
  ros::Publisher plans_;
  ros::Publisher status_;
  SetpointTrajectory samples_;  // the messages' memory is reused from cycle to cycle
  trajectory_msgs::MultiDOFJointTrajectory trajectory_;
  SwarmPlan swarm_plan_;
};

}  // namespace swarm_planner
