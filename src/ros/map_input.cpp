// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/map_input.hpp"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "swarm_planner/map/map_file.hpp"
#include "swarm_planner/map/octree_conversion.hpp"
#include "swarm_planner/map/octree_writer.hpp"
#include "swarm_planner/ros/cloud_conversion.hpp"
#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

constexpr double kListenerPeriod = 1.0;  // [s] of wall time
constexpr double kBytesPerMegabyte = 1e6;

double steadySeconds() { return ros::SteadyTime::now().toSec(); }

OctreeData octreeOf(const OctomapMessage& message, OctreeEncoding encoding) {
  OctreeData data;
  data.encoding = encoding;
  data.resolution = message.resolution;
  data.bytes.assign(message.data.begin(), message.data.end());
  return data;
}

/// The occupied voxels of a map as an octree.
OctreeData octreeOf(const VoxelMap& map) {
  OctreeWriter writer(map.resolution());
  map.forEachOccupied(map.bounds(), [&writer](const VoxelIndex& voxel) { writer.set(voxel, true); });
  std::string why;
  return parseMapFile(writer.file(), why).value_or(OctreeData());
}

}  // namespace

MapInput::MapInput(const Mission& mission, const MapOptions& options, const FrameTransformer& frames, Bodies bodies,
                   Listener listener)
    : mission_(mission),
      options_(options),
      frames_(frames),
      bodies_(std::move(bodies)),
      listener_(std::move(listener)),
      spinner_(1, &queue_) {
  if (mission.map != nullptr) takeUp(mission.map, mission.scenario.map_file, steadySeconds());
  node_.setCallbackQueue(&queue_);
  for (const char* topic : {kOctomapBinaryTopic, kOctomapFullTopic}) {
    const std::string name = topic;
    subscribers_.push_back(subscribeGuarded<OctomapMessage>(
        node_, topic, {kMapQueueSize, kMostMapMessageBytes},
        [this, name](const OctomapMessage& message) { receiveOctomap(name, message); },
        [this, name](InputFault fault, const std::string& why) { reject(name, fault, why); }));
  }
  if (bodies_) subscribeClouds();
  listener_timer_ =
      node_.createWallTimer(ros::WallDuration(kListenerPeriod), [this](const ros::WallTimerEvent&) { tellListener(); });
  spinner_.start();
}

void MapInput::subscribeClouds() {
  subscribers_.push_back(subscribeGuarded<sensor_msgs::PointCloud2>(
      node_, kMapCloudTopic, {kMapCloudQueueSize, kMostMapMessageBytes},
      [this](const sensor_msgs::PointCloud2& message) { receiveCloud(message); },
      [this](InputFault fault, const std::string& why) { reject(kMapCloudTopic, fault, why); }));
  cloud_timer_ = node_.createWallTimer(ros::WallDuration(options_.cloud_period),
                                       [this](const ros::WallTimerEvent&) { convertClouds(); });
}

MapInput::~MapInput() { spinner_.stop(); }

std::shared_ptr<const VoxelMap> MapInput::map() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return map_;
}

MapInputReport MapInput::report() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return report_;
}

void MapInput::receiveOctomap(const std::string& topic, const OctomapMessage& message) {
  const double received = steadySeconds();
  std::string why;
  const auto pose = frames_.toPlanning(message.header.frame_id, message.header.stamp, why);
  if (!pose) return reject(topic, InputFault::kFrame, why);
  const auto encoding = encodingOf(message.id, message.binary != 0, why);
  if (!encoding) return reject(topic, InputFault::kMap, shortened(why, 200));
  OctreeData data = octreeOf(message, *encoding);
  const std::shared_ptr<const VoxelMap> last = map();
  const bool in_place = pose->isApprox(Eigen::Isometry3d::Identity(), 1e-9);
  auto voxels = toVoxelMap(data, mission_.scenario.unknown_is_occupied, in_place ? last.get() : nullptr, why);
  if (voxels != nullptr && !in_place) voxels = resampled(*voxels, *pose, last.get(), why);
  if (voxels == nullptr) return reject(topic, InputFault::kMap, why);
  octree_.reset();
  if (in_place) octree_ = std::move(data);
  clouds_.reset();
  cloud_since_.reset();
  takeUp(std::move(voxels), topic, received);
}

void MapInput::receiveCloud(const sensor_msgs::PointCloud2& message) {
  const double received = steadySeconds();
  std::string why;
  InputFault fault = InputFault::kNone;
  const auto pose = frames_.toPlanning(message.header.frame_id, message.header.stamp, why);
  if (!pose) return reject(kMapCloudTopic, InputFault::kFrame, why);
  auto points = pointsOf(message, fault, why);
  if (!points) return reject(kMapCloudTopic, fault, why);
  for (Vector3& point : *points) point = *pose * point;
  const ros::Time stamp = message.header.stamp.isZero() ? ros::Time::now() : message.header.stamp;
  const BodyPlaces bodies{bodies_(toSeconds(stamp)), options_.body_radius};
  if (!cloudMap().reaches(pose->translation(), options_.cloud_range)) {
    return reject(kMapCloudTopic, InputFault::kAbsurd, "a sensor that is too far from the frame's origin");
  }
  if (cloudMap().insert(*points, pose->translation(), options_.cloud_range, bodies) == 0) {
    return reject(kMapCloudTopic, InputFault::kNotFinite, "a cloud without any point to use");
  }
  if (!cloud_since_) cloud_since_ = received;
}

CloudMap& MapInput::cloudMap() {
  if (clouds_) return *clouds_;
  std::string why;
  const std::shared_ptr<const VoxelMap> last = map();
  if (octree_) {
    clouds_.emplace(*octree_, last);
  } else if (last == nullptr) {
    clouds_.emplace(options_.resolution);
  } else if (last == mission_.map) {
    const auto file = readMapFile(mission_.scenario.map_file, why);
    if (file) {
      clouds_.emplace(*file, last);
    } else {
      clouds_.emplace(octreeOf(*last));
    }
  } else {
    clouds_.emplace(octreeOf(*last));
  }
  return *clouds_;
}

void MapInput::convertClouds() {
  if (!cloud_since_) return;
  const double received = *cloud_since_;
  cloud_since_.reset();
  std::string why;
  const std::shared_ptr<const VoxelMap> last = map();
  auto voxels = clouds_->voxels(mission_.scenario.unknown_is_occupied, last.get(), why);
  if (voxels == nullptr) return reject(kMapCloudTopic, InputFault::kMap, why);
  takeUp(std::move(voxels), kMapCloudTopic, received);
}

void MapInput::takeUp(std::shared_ptr<const VoxelMap> map, const std::string& source, double received) {
  MapInputReport report = this->report();
  report.source = source;
  report.voxels = map->occupiedCount();
  report.resolution = map->resolution();
  report.memory = static_cast<double>(map->memory()) / kBytesPerMegabyte;
  ++report.accepted;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    report.delay = steadySeconds() - received;
    report_ = report;
    map_.swap(map);
  }
  if (map != nullptr) retired_.push_back(std::move(map));
  release();
  ROS_INFO_STREAM_THROTTLE(kWarningPeriod, "Map of '" << shortened(source, 200) << "' in use: " << report.voxels
                                                      << " occupied voxels of " << report.resolution << " m, "
                                                      << 1e3 * report.delay << " ms after it came");
}

void MapInput::reject(const std::string& topic, InputFault fault, const std::string& why) {
  bool has_map = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    report_.dropped.add(fault);
    report_.last_fault = topic + ": " + why;
    has_map = map_ != nullptr;
  }
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << " ignored: " << why
                                                 << (has_map ? "; the last good map stays" : "; there is no map yet"));
}

void MapInput::tellListener() {
  release();
  const std::shared_ptr<const VoxelMap> newest = map();
  if (newest == told_) return;
  told_ = newest;
  listener_(*newest);
}

void MapInput::release() {
  retired_.erase(std::remove_if(retired_.begin(), retired_.end(),
                                [](const std::shared_ptr<const VoxelMap>& map) { return map.use_count() == 1; }),
                 retired_.end());
}

}  // namespace swarm_planner
