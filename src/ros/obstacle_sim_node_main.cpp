// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "swarm_planner/ros/master_watch.hpp"
#include "swarm_planner/ros/node_parameters.hpp"
#include "swarm_planner/ros/obstacle_sim_node.hpp"

int main(int argc, char** argv) {
  using namespace swarm_planner;
  ros::init(argc, argv, "obstacle_sim_node");
  ros::NodeHandle private_node("~");
  try {
    Faults faults;
    ParameterMap parameters = readPrivateParameters(private_node, faults);
    const std::vector<NodeParameter> table = {{"scenario", "path of the scenario file", std::string(), true}};
    const ParameterMap own = takeNodeParameters(table, parameters, faults);
    ObstacleSimNode node(loadNodeMission(std::get<std::string>(own.at("scenario")), parameters, faults));
    const MasterWatch master_watch;
    ros::spin();
  } catch (const ConfigError& error) {
    ROS_FATAL_STREAM("obstacle_sim_node cannot start:\n" << error.what());
    return 1;
  }
  return 0;
}
