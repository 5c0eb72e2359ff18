// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/param.h>

#include "swarm_planner/ros/master_watch.hpp"
#include "swarm_planner/ros/node_parameters.hpp"
#include "swarm_planner/ros/quad_sim_node.hpp"
#include "swarm_planner/ros/quad_sim_options.hpp"

int main(int argc, char** argv) {
  using namespace swarm_planner;
  ros::init(argc, argv, "quad_sim_node");
  ros::NodeHandle private_node("~");
  try {
    Faults faults;
    ParameterMap parameters = readPrivateParameters(private_node, faults);
    const QuadSimOptions options = takeQuadSimOptions(parameters, faults);
    if (options.speed != 1.0 && !ros::param::param("/use_sim_time", false)) {
      faults.add("parameters", "speed", "is not 1, which needs /use_sim_time: nobody would listen to /clock");
    }
    QuadSimNode node(loadNodeMission(options.scenario, parameters, faults), options);
    const MasterWatch master_watch;
    ros::spin();
    node.reportIfInterrupted();
    return node.clear() ? 0 : 2;
  } catch (const ConfigError& error) {
    ROS_FATAL_STREAM("quad_sim_node cannot start:\n" << error.what());
    return 1;
  }
}
