// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "swarm_planner/ros/master_watch.hpp"
#include "swarm_planner/ros/node_parameters.hpp"
#include "swarm_planner/ros/planner_node.hpp"
#include "swarm_planner/ros/planner_options.hpp"

int main(int argc, char** argv) {
  using namespace swarm_planner;
  ros::init(argc, argv, "planner_node");
  ros::NodeHandle private_node("~");
  try {
    Faults faults;
    ParameterMap parameters = readPrivateParameters(private_node, faults);
    const PlannerNodeOptions options = takePlannerNodeOptions(parameters, faults);
    const Mission mission = loadNodeMission(options.scenario, parameters, faults);
    const std::optional<std::string> mode_fault =
        planningModeFault(options.mode, mission.scenario.uavs.size(), mission.parameters.limits.as_paper);
    if (mode_fault)
      throw ConfigError(std::string("parameters: mode: is ") + planningModeText(options.mode) + "; " + *mode_fault);
    PlannerNode node(SwarmPlanner(mission, options.mode), mission, options);
    const MasterWatch master_watch;
    ros::spin();
  } catch (const ConfigError& error) {
    ROS_FATAL_STREAM("planner_node cannot start:\n" << error.what());
    return 1;
  }
  return 0;
}
