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

  /// Sends the setpoints that wait for their epoch, if any. The epoch of a cycle's plans is the start of the next
  /// cycle, so call it there.
  void sendWaitingSetpoints();
  /// Setpoints first: vehicles wait for them; with SetpointDelivery::kAtEpoch they are kept until the next cycle. A UAV
  /// without a plan gets none. `inputs`: yaw is held as at the start.
  void publishPlans(const SwarmPlanner& planner, const std::vector<UavInput>& inputs, double now);
  /// Sends the last cycle's setpoints once more, unless they are kept for their epoch: a driver that flies what comes
  /// at once would begin anew.
  void repeatSetpoints();
  /// Time has jumped back: what waits is of another time.
  void clear();
  void publishStatus(const PlannerStatus& status) { status_.publish(status); }

 private:
  const std::string frame_;
  const double setpoint_dt_;
  const double setpoint_horizon_;
  const SetpointDelivery delivery_;
  std::vector<ros::Publisher> setpoints_;
  ros::Publisher plans_;
  ros::Publisher status_;
  // The messages' memory is reused from cycle to cycle.
  SetpointTrajectory samples_;
  std::vector<trajectory_msgs::MultiDOFJointTrajectory> trajectories_;  ///< per UAV
  std::vector<bool> waiting_;                                           ///< which of them are yet to be sent
  std::vector<bool> sent_;                                              ///< which are the last cycle's and on their way
  SwarmPlan swarm_plan_;
};

}  // namespace swarm_planner
