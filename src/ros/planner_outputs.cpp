// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planner_outputs.hpp"

#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"
#include "swarm_planner/ros/trajectory_conversion.hpp"

namespace swarm_planner {

PlannerOutputs::PlannerOutputs(const std::vector<std::string>& uav_names, const std::string& planning_frame,
                               const PlannerNodeOptions& options)
    : frame_(planning_frame),
      setpoint_dt_(options.setpoint_dt),
      setpoint_horizon_(options.setpoint_horizon),
      delivery_(options.setpoint_delivery),
      trajectories_(uav_names.size()),
      waiting_(uav_names.size(), false),
      sent_(uav_names.size(), false) {
  ros::NodeHandle node;
  ros::NodeHandle private_node("~");
  for (const std::string& name : uav_names) {
    setpoints_.push_back(node.advertise<trajectory_msgs::MultiDOFJointTrajectory>(
        nameForUav(options.trajectory_topic, name), kTrajectoryQueueSize));
  }
  plans_ = private_node.advertise<SwarmPlan>(kPlansTopic, kPlansQueueSize);
  status_ = private_node.advertise<PlannerStatus>(kStatusTopic, kStatusQueueSize);
}

void PlannerOutputs::publishPlans(const SwarmPlanner& planner, const std::vector<UavInput>& inputs, double now) {
  const CycleReport& report = planner.report();
  swarm_plan_.plans.clear();
  for (std::size_t uav = 0; uav < report.uavs.size(); ++uav) {
    waiting_[uav] = report.uavs[uav].planned;
    if (!waiting_[uav]) continue;
    const CommittedMotion& motion = planner.committed(uav);
    sampleMotion(motion, motion.epoch(), setpoint_dt_, setpoint_horizon_, inputs[uav].start_yaw, samples_);
    toMessage(samples_, frame_, trajectories_[uav]);
    swarm_plan_.plans.emplace_back();
    toMessage(motion, planner.uavName(uav), swarm_plan_.plans.back());
  }
  if (delivery_ == SetpointDelivery::kAtOnce) sendWaitingSetpoints();
  swarm_plan_.header.stamp = toRosTime(now);
  swarm_plan_.header.frame_id = frame_;
  swarm_plan_.cycle = report.cycle;
  plans_.publish(swarm_plan_);
}

void PlannerOutputs::sendWaitingSetpoints() {
  for (std::size_t uav = 0; uav < setpoints_.size(); ++uav) {
    if (waiting_[uav]) setpoints_[uav].publish(trajectories_[uav]);
    sent_[uav] = waiting_[uav];
    waiting_[uav] = false;
  }
}

void PlannerOutputs::repeatSetpoints() {
  if (delivery_ == SetpointDelivery::kAtEpoch) return;
  for (std::size_t uav = 0; uav < setpoints_.size(); ++uav) {
    if (sent_[uav]) setpoints_[uav].publish(trajectories_[uav]);
  }
}

void PlannerOutputs::clear() {
  waiting_.assign(waiting_.size(), false);
  sent_.assign(sent_.size(), false);
}

}  // namespace swarm_planner
