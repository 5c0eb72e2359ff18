// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <sensor_msgs/PointCloud2.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/map/cloud_map.hpp"
#include "swarm_planner/ros/frame_transformer.hpp"
#include "swarm_planner/ros/input_fault.hpp"
#include "swarm_planner/ros/octomap_message.hpp"
#include "swarm_planner/ros/planner_options.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// What is known of the map's sources.
struct MapInputReport {
  std::string source;          ///< of the map in use: a file or a topic; empty: there is no map
  std::size_t voxels = 0;      ///< occupied
  double resolution = 0.0;     ///< [m]
  double memory = 0.0;         ///< of the map in use [MB]
  double delay = 0.0;          ///< from a message to the use of what it brought, the last time [s]
  std::uint64_t accepted = 0;  ///< messages
  FaultCounts dropped;         ///< messages
  std::string last_fault;
};

/// Makes maps in a thread of its own, from the topics octomap_binary, octomap_full and map_cloud, so that neither the
/// planning cycle nor any other input ever waits for one. An octomap replaces the map, clouds are added to it. What is
/// no good changes nothing: the last good map stays.
class MapInput {
 public:
  /// Called in the thread of maps with a new map, once per second at most.
  using Listener = std::function<void(const VoxelMap&)>;
  /// Where the UAVs were at a time [s], in the planning frame.
  using Bodies = std::function<std::vector<Vector3>(double)>;

  /// Starts receiving; clouds only if there are `bodies` to cut out of them. Mission and `frames` must outlive this.
  /// The first map is that of the mission.
  MapInput(const Mission& mission, const MapOptions& options, const FrameTransformer& frames, Bodies bodies,
           Listener listener);
  ~MapInput();
  MapInput(const MapInput&) = delete;
  MapInput& operator=(const MapInput&) = delete;

  /// The map in use; null: there is none. Takes a lock that is only ever held while a pointer is copied.
  std::shared_ptr<const VoxelMap> map() const;
  MapInputReport report() const;

 private:
  void subscribeClouds();
  void receiveOctomap(const std::string& topic, const OctomapMessage& message);
  void receiveCloud(const sensor_msgs::PointCloud2& message);
  /// Makes a map of the clouds that came since the last.
  void convertClouds();
  CloudMap& cloudMap();
  void takeUp(std::shared_ptr<const VoxelMap> map, const std::string& source, double received);
  void reject(const std::string& topic, InputFault fault, const std::string& why);
  /// Frees maps that the planner no longer uses: here, not in its cycle.
  void release();
  void tellListener();

  const Mission& mission_;
  const MapOptions options_;
  const FrameTransformer& frames_;
  const Bodies bodies_;
  const Listener listener_;
  std::optional<OctreeData> octree_;   ///< the last octomap in the planning frame
  std::optional<CloudMap> clouds_;     ///< octree_ or the mission's map with clouds added; empty: none came since
  std::optional<double> cloud_since_;  ///< when the first cloud came that is not in the map yet: steady time [s]
  std::vector<std::shared_ptr<const VoxelMap>> retired_;
  std::shared_ptr<const VoxelMap> told_;  ///< what the listener knows

  mutable std::mutex mutex_;  ///< of map_ and report_
  std::shared_ptr<const VoxelMap> map_;
  MapInputReport report_;

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer cloud_timer_, listener_timer_;
  ros::AsyncSpinner spinner_;
};

}  // namespace swarm_planner
