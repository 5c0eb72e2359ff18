// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/timer.h>

#include <deque>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/ros/corridor_drawing.hpp"
#include "swarm_planner/ros/map_input.hpp"
#include "swarm_planner/ros/planner_inputs.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/ros/scene_markers.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// Shows the swarm in rviz: markers at a fixed rate, made in the input thread from copies, so that drawing costs the
/// planning cycle no more than those copies. Does nothing while nobody looks.
class MarkerPublisher {
 public:
  /// `inputs` and `maps` must outlive this.
  MarkerPublisher(const Mission& mission, const std::string& frame, const PlannerNodeOptions& options,
                  PlannerInputs& inputs, const MapInput& maps);

  /// Takes over what a cycle decided.
  void update(const SwarmPlanner& planner, const PlannerStatus& status);
  /// Time has jumped back: trails and plans are forgotten.
  void clear();

 private:
  struct TrailPoint {
    double time;
    Vector3 position;
  };

  void publish();
  void locate(double now, std::vector<UavDrawing>& uavs);
  void findCorridors(std::vector<UavDrawing>& uavs);
  void drawObstacles(double now, bool everything);
  std::string statusText(double now) const;

  const std::string frame_;
  const double trail_duration_;
  const double corridor_band_;  ///< [m]
  PlannerInputs& inputs_;
  const MapInput& maps_;
  CorridorDrawing corridors_;
  Eigen::AlignedBox3d box_;  ///< of the scene [m]
  MarkerSizes sizes_;
  SceneMarkers markers_;
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Timer timer_;

  std::mutex mutex_;  ///< of drawings_, status_ and cleared_, which cycle and timer share
  std::vector<UavDrawing> drawings_;
  PlannerStatus status_;
  bool cleared_ = false;

  std::vector<std::deque<TrailPoint>> trails_;
  std::set<int> drawn_obstacles_;
  double next_refresh_ = 0.0;  ///< wall time at which unmoving things are sent again [s]
};

}  // namespace swarm_planner
