// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/timer.h>
#include <ros/wall_timer.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/transform_broadcaster.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/ObstacleTrackArray.h"
#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/ros/fault_service.hpp"
#include "swarm_planner/ros/frame_transformer.hpp"
#include "swarm_planner/ros/input_watch.hpp"
#include "swarm_planner/ros/map_input.hpp"
#include "swarm_planner/ros/quad_sim_options.hpp"
#include "swarm_planner/ros/run_report.hpp"
#include "swarm_planner/ros/sim_clock.hpp"
#include "swarm_planner/simulation/external_flight.hpp"
#include "swarm_planner/simulation/message_link.hpp"
#include "swarm_planner/simulation/quad_simulator.hpp"
#include "swarm_planner/simulation/run_monitor.hpp"

namespace swarm_planner {

/// Flies every UAV of the scenario on the trajectories that it receives, external ones behind their targets, publishes
/// odometry and tf, makes /clock at speeds other than 1, and measures the run: every 10 ms from the planner's t = 0 to
/// the scenario's end. Trajectories and odometry go over links that delay and lose them as the parameters of the
/// simulation say. Faults of the scenario, and those that ~inject_fault asks for, are injected.
class QuadSimNode {
 public:
  QuadSimNode(const Mission& mission, const QuadSimOptions& options);

  /// Reports a run that was cut short; nothing if none is under way.
  void reportIfInterrupted();
  /// The last run ended and every UAV kept clear.
  bool clear() const { return clear_; }

 private:
  void subscribe();
  void subscribeTrajectories();
  void receiveTrajectory(std::size_t uav, const trajectory_msgs::MultiDOFJointTrajectory& message);
  void receiveTracks(const ObstacleTrackArray& message);
  void receiveStatus(const PlannerStatus& status);
  void deliverTrajectories(std::size_t uav);
  void catchUp();
  void restartClock(double now);
  void advance();
  /// Commands of whoever flies the external UAVs.
  void commandExternals();
  void measure();
  void publishOdometry(std::size_t uav);
  void observe();
  void endRun(const std::string& ended_by);

  const Mission mission_;
  const QuadSimOptions options_;
  SimClock clock_;
  std::vector<QuadSimulator> quads_;
  std::vector<std::optional<ExternalFlight>> externals_;  ///< of the UAVs that another system flies
  std::vector<MessageLink<SetpointTrajectory>> trajectory_links_;
  std::vector<MessageLink<nav_msgs::Odometry>> odometry_links_;
  FaultInjector faults_;
  tf2::BufferCore no_transforms_;  ///< the truth is given in the world's own frame
  FrameTransformer frames_;
  std::optional<MapInput> live_map_;
  std::vector<TrackedObstacle> obstacles_;  ///< the truth: as last received, or as in the scenario

  double origin_ = 0.0;         ///< simulated time at which steps are counted from [s]
  std::uint64_t steps_ = 0;     ///< since origin_
  double next_odometry_ = 0.0;  ///< [s]
  double time_ = 0.0;           ///< [s]

  std::optional<double> time_zero_;    ///< of the run [s]
  std::optional<RunMonitor> monitor_;  ///< of the run under way
  std::vector<UavSample> samples_;
  std::vector<Superellipsoid> obstacles_now_;
  std::uint64_t cycles_ = 0;
  double cycle_time_sum_ = 0.0, cycle_time_max_ = 0.0;  ///< [s]
  std::uint32_t deadline_misses_ = 0;
  bool clear_ = false;

  ros::NodeHandle node_;
  InputWatch watch_;
  std::vector<ros::Publisher> odometry_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::vector<geometry_msgs::TransformStamped> transforms_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Timer timer_;
  ros::WallTimer wall_timer_;
  FaultService fault_service_;
};

}  // namespace swarm_planner
