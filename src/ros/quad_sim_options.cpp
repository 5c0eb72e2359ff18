// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/quad_sim_options.hpp"

#include "swarm_planner/ros/node_constants.hpp"

namespace swarm_planner {

const std::vector<NodeParameter>& quadSimTable() {
  static const std::vector<NodeParameter> table = {
      {"scenario", "path of the scenario file", std::string(), true},
      {"odometry_topic", "odometry of a UAV, {uav} stands for its name", std::string(kDefaultOdometryTopic)},
      {"trajectory_topic", "setpoints of a UAV, {uav} stands for its name", std::string(kDefaultTrajectoryTopic)},
      {"speed", "simulated over wall time; other than 1 needs use_sim_time", 1.0, false, 0.01, 100.0},
      {"duration", "ends the run after so long since t = 0 [s], 0: when the scenario does", 0.0, false, 0.0},
      {"summary_file", "where to write the summary as a line of JSON, empty: nowhere", std::string()},
      {"live_map", "octomaps that come in flight are what UAVs may collide with, too", false},
      {"exit_at_end", "shut down when the run has ended", false},
  };
  return table;
}

QuadSimOptions takeQuadSimOptions(ParameterMap& given, Faults& faults) {
  const ParameterMap values = takeNodeParameters(quadSimTable(), given, faults);
  const auto text = [&values](const char* name) { return std::get<std::string>(values.at(name)); };
  QuadSimOptions options;
  options.scenario = text("scenario");
  options.odometry_topic = text("odometry_topic");
  options.trajectory_topic = text("trajectory_topic");
  options.speed = std::get<double>(values.at("speed"));
  options.duration = std::get<double>(values.at("duration"));
  options.summary_file = text("summary_file");
  options.live_map = std::get<bool>(values.at("live_map"));
  options.exit_at_end = std::get<bool>(values.at("exit_at_end"));
  return options;
}

}  // namespace swarm_planner
