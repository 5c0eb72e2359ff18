// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/time.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/ros/status_tally.hpp"
#include "swarm_planner/swarm/committed_motion.hpp"

namespace swarm_planner {

/// Sizes of what is drawn.
struct MarkerSizes {
  double uav = 1.0;                     ///< width of a UAV [m]
  double text = 1.0;                    ///< height of the status line [m]
  Vector3 pair_axes = Vector3::Ones();  ///< semi-axes of a UAV's half of the pair ellipsoid [m]
};

/// What is drawn of one UAV.
struct UavDrawing {
  std::string name;
  std::string note;  ///< shown beside the name; empty if all is well
  Concern concern = Concern::kNone;
  bool located = false;  ///< position and orientation are known
  Vector3 position = Vector3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  std::vector<Vector3> trail;
  bool planned = false;  ///< `plan` holds what it is to fly
  CommittedMotion plan;
  bool targeted = false;  ///< `reference` and `target` are known
  MovingTarget reference;
  TargetState target;
  std::vector<Vector3> guide;     ///< what it flies along in place of the reference; empty if it does not
  std::vector<Vector3> corridor;  ///< edges of the free space that the map leaves about its plan, pairs of points
};

/// Makes rviz markers of a swarm. Namespaces, to switch on and off in rviz: uav, label, trail, plan, rest, reference,
/// target, guide, corridor, separation, obstacle, velocity, status. Ids are the UAV's index and the obstacle's id. The
/// label of a UAV that is of concern is orange; where there is an alarm, label, plan and separation are red.
class SceneMarkers {
 public:
  SceneMarkers(std::string frame, const MarkerSizes& sizes);

  /// The following markers are for this time.
  void begin(const ros::Time& stamp);
  void addUav(int index, const UavDrawing& uav);
  void addReference(int index, const MovingTarget& reference, double until);
  /// Surface, and an arrow of four seconds' way if it moves. `now` [s]: where it has moved to.
  void addObstacle(const TrackedObstacle& obstacle, double now);
  void removeObstacle(int id);
  /// At `position`, or as far above it as the labels drawn since begin() demand. `concern`: the greatest of all UAVs.
  void addStatus(const Vector3& position, const std::string& text, Concern concern);
  void removeAll();

  const visualization_msgs::MarkerArray& message() const { return message_; }

 private:
  visualization_msgs::Marker& add(const char* ns, int id, int type);
  void addPlan(int index, const UavDrawing& uav);
  void addTarget(int index, const UavDrawing& uav);
  void addGuide(int index, const UavDrawing& uav);
  void addCorridor(int index, const UavDrawing& uav);

  const std::string frame_;
  const MarkerSizes sizes_;
  const std::vector<geometry_msgs::Point> uav_mesh_;
  ros::Time stamp_;
  double labels_top_ = 0.0;  ///< no label reaches above this height [m]
  visualization_msgs::MarkerArray message_;
};

/// A colour per UAV, neighbours far apart in hue.
std_msgs::ColorRGBA uavColor(int index, float alpha);

}  // namespace swarm_planner
