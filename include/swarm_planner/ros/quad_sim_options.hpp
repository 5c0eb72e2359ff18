// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/ros/node_parameters.hpp"

namespace swarm_planner {

/// Parameters that quad_sim_node has beside those of planner and simulation.
struct QuadSimOptions {
  std::string scenario;          ///< path of the scenario file
  std::string odometry_topic;    ///< with {uav}
  std::string trajectory_topic;  ///< with {uav}
  double speed = 1.0;            ///< simulated over wall time; other than 1: the node publishes /clock
  double duration = 0.0;         ///< ends the run after so long [s] since t = 0; 0: when the scenario does
  std::string summary_file;      ///< where to write the summary as a line of JSON; empty: nowhere
  bool live_map = false;         ///< maps of octomap_binary and octomap_full count, in place of the scenario's
  bool exit_at_end = false;      ///< shut down when the run has ended
};

/// Every parameter of QuadSimOptions with default and range.
const std::vector<NodeParameter>& quadSimTable();

/// Takes the options out of `given`; what is wrong is added to `faults`.
QuadSimOptions takeQuadSimOptions(ParameterMap& given, Faults& faults);

}  // namespace swarm_planner
