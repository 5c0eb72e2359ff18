// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/timer.h>

#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/ObstacleTrackArray.h"
#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/obstacles/superellipsoid.hpp"
#include "swarm_planner/ros/fault_service.hpp"
#include "swarm_planner/ros/input_watch.hpp"
#include "swarm_planner/simulation/message_link.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// Publishes the scenario's obstacles as perfect tracks, over a link that delays and loses them as the parameters of
/// the simulation say. They move from the run's t = 0 on, which the planner's status tells; until then they wait where
/// they are at t = 0, announced with the velocity that they will have. Faults of the scenario, and those that
/// ~inject_fault asks for, are injected.
class ObstacleSimNode {
 public:
  explicit ObstacleSimNode(const Mission& mission);

 private:
  void receiveStatus(const PlannerStatus& status);
  void measure();
  void publish();

  std::vector<Superellipsoid> obstacles_;  ///< at t = 0
  std::optional<double> time_zero_;        ///< [s]
  std::string frame_id_;
  MessageLink<ObstacleTrackArray> link_;
  FaultInjector faults_;
  ros::NodeHandle node_;
  InputWatch watch_;
  ros::Publisher publisher_;
  ros::Subscriber status_subscriber_;
  ros::Timer measurement_timer_, publication_timer_;
  FaultService fault_service_;
};

}  // namespace swarm_planner
