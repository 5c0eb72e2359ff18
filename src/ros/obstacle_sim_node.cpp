// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/obstacle_sim_node.hpp"

#include <ros/transport_hints.h>

#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"
#include "swarm_planner/ros/track_conversion.hpp"

namespace swarm_planner {

ObstacleSimNode::ObstacleSimNode(const Mission& mission) {
  for (const ScenarioObstacle& obstacle : mission.scenario.obstacles) obstacles_.push_back(makeObstacle(obstacle));
  message_.header.frame_id = mission.scenario.frame_id;
  publisher_ = node_.advertise<ObstacleTrackArray>(kObstacleTracksTopic, kObstacleTracksQueueSize);
  status_subscriber_ = node_.subscribe(kPlannerStatusTopic, kStatusQueueSize, &ObstacleSimNode::receiveStatus, this,
                                       ros::TransportHints().tcpNoDelay());
  timer_ = node_.createTimer(ros::Duration(1.0 / mission.parameters.simulation.track_rate),
                             [this](const ros::TimerEvent&) { publish(); });
}

void ObstacleSimNode::receiveStatus(const PlannerStatus& status) {
  time_zero_.reset();
  if (status.started) time_zero_ = toSeconds(status.time_zero);
}

void ObstacleSimNode::publish() {
  const ros::Time now = ros::Time::now();
  const double run_time = time_zero_ ? toSeconds(now) - *time_zero_ : 0.0;
  message_.header.stamp = now;
  message_.tracks.clear();
  for (const Superellipsoid& obstacle : obstacles_) message_.tracks.push_back(toMessage(obstacle.movedBy(run_time)));
  publisher_.publish(message_);
}

}  // namespace swarm_planner
