// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/marker_publisher.hpp"

#include <algorithm>
#include <cstdio>

#include "swarm_planner/ros/marker_shapes.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// What does not move is sent once in so long, for viewers that join late [s].
constexpr double kRefreshPeriod = 1.0;
// More corridors are a tangle, and work for the thread of inputs.
constexpr std::size_t kMostCorridors = 12;
// Of the scene's diagonal: wide enough to be seen when the whole scene is in view.
constexpr double kUavShare = 0.02;
constexpr double kTextShare = 0.025;
constexpr double kLookAheadShare = 0.3;

double drawnUavWidth(const Mission& mission, double wanted, double diagonal) {
  if (wanted > 0.0) return wanted;
  return std::max(2.0 * mission.parameters.vehicle.arm_length, kUavShare * diagonal);
}

/// Two stages' way at full speed.
double corridorBand(const Parameters& parameters) {
  return 2.0 * parameters.limits.max_speed * parameters.time.sampling_time + parameters.limits.uav_radius;
}

}  // namespace

MarkerPublisher::MarkerPublisher(const Mission& mission, const std::string& frame, const PlannerNodeOptions& options,
                                 PlannerInputs& inputs, const MapInput& maps)
    : frame_(frame),
      trail_duration_(options.trail_duration),
      corridor_band_(corridorBand(mission.parameters)),
      inputs_(inputs),
      maps_(maps),
      box_(boundingBox(scenePoints(mission.scenario))),
      sizes_{drawnUavWidth(mission, options.uav_marker_size, box_.diagonal().norm()),
             std::max(0.3, kTextShare * box_.diagonal().norm()),
             0.5 * Vector3(mission.parameters.limits.pair_distance, mission.parameters.limits.pair_distance,
                           mission.parameters.limits.pair_distance_vertical)},
      markers_(frame, sizes_),
      drawings_(mission.scenario.uavs.size()),
      trails_(mission.scenario.uavs.size()) {
  for (std::size_t uav = 0; uav < drawings_.size(); ++uav) drawings_[uav].name = mission.scenario.uavs[uav].name;
  if (options.marker_rate <= 0.0) return;
  publisher_ = ros::NodeHandle("~").advertise<visualization_msgs::MarkerArray>(kMarkersTopic, kMarkersQueueSize);
  node_.setCallbackQueue(&inputs_.queue());
  timer_ = node_.createTimer(ros::Duration(1.0 / options.marker_rate), [this](const ros::TimerEvent&) { publish(); });
}

void MarkerPublisher::update(const SwarmPlanner& planner, const PlannerStatus& status) {
  if (!publisher_ || publisher_.getNumSubscribers() == 0) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  status_ = status;
  for (std::size_t uav = 0; uav < drawings_.size(); ++uav) {
    UavDrawing& drawing = drawings_[uav];
    drawing.note = status.uavs[uav].reason;
    drawing.concern = concernOf(status.uavs[uav]);
    drawing.planned = status.uavs[uav].planned;
    if (drawing.planned) drawing.plan = planner.committed(uav);
    drawing.targeted = true;
    drawing.reference = planner.reference(uav);
    drawing.target = planner.target(uav, toSeconds(status.header.stamp));
    drawing.guide.clear();
    if (const ReferencePath* guide = planner.guide(uav)) drawing.guide = guide->points();
  }
}

void MarkerPublisher::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  cleared_ = true;
  for (UavDrawing& drawing : drawings_) drawing.planned = false;
}

void MarkerPublisher::publish() {
  const double now = toSeconds(ros::Time::now());
  markers_.begin(toRosTime(now));
  std::vector<UavDrawing> uavs;
  std::string text;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (cleared_) {
      for (auto& trail : trails_) trail.clear();
      drawn_obstacles_.clear();
      markers_.removeAll();
      cleared_ = false;
      next_refresh_ = 0.0;
    }
    uavs = drawings_;
    text = statusText(now);
  }
  const double wall = ros::WallTime::now().toSec();
  const bool everything = wall >= next_refresh_;
  if (everything) next_refresh_ = wall + kRefreshPeriod;

  locate(now, uavs);  // trails grow also while nobody looks
  if (publisher_.getNumSubscribers() == 0) return;
  findCorridors(uavs);
  for (std::size_t uav = 0; uav < uavs.size(); ++uav) {
    const int index = static_cast<int>(uav);
    markers_.addUav(index, uavs[uav]);
    const double until = uavs[uav].target.arc_length + kLookAheadShare * box_.diagonal().norm();
    if (everything && uavs[uav].targeted) markers_.addReference(index, uavs[uav].reference, until);
  }
  drawObstacles(now, everything);
  Concern concern = Concern::kNone;
  for (const UavDrawing& uav : uavs) concern = std::max(concern, uav.concern);
  markers_.addStatus(statusPosition(box_), text, concern);
  publisher_.publish(markers_.message());
}

void MarkerPublisher::locate(double now, std::vector<UavDrawing>& uavs) {
  const std::vector<UavInput> inputs = inputs_.store().uavs();
  for (std::size_t uav = 0; uav < uavs.size(); ++uav) {
    if (!inputs[uav].received) continue;
    const OdometrySample& sample = inputs[uav].sample;
    uavs[uav].located = true;
    uavs[uav].position = sample.p;
    uavs[uav].orientation = sample.orientation;
    std::deque<TrailPoint>& trail = trails_[uav];
    const double least_move = 0.1 * sizes_.uav;
    if (trail.empty() || (sample.p - trail.back().position).norm() > least_move) trail.push_back({now, sample.p});
    while (!trail.empty() && trail.front().time < now - trail_duration_) trail.pop_front();
    for (const TrailPoint& point : trail) uavs[uav].trail.push_back(point.position);
  }
}

void MarkerPublisher::findCorridors(std::vector<UavDrawing>& uavs) {
  const std::shared_ptr<const VoxelMap> map = maps_.map();
  if (map == nullptr) return;
  for (std::size_t uav = 0; uav < std::min(uavs.size(), kMostCorridors); ++uav) {
    if (uavs[uav].planned) uavs[uav].corridor = corridors_.edges(*map, uavs[uav].plan, corridor_band_);
  }
}

void MarkerPublisher::drawObstacles(double now, bool everything) {
  Snapshot snapshot;
  inputs_.store().fill(now, snapshot);
  std::set<int> known;
  for (const TrackedObstacle& obstacle : snapshot.obstacles) {
    const int id = obstacle.shape.id();
    known.insert(id);
    const bool is_new = drawn_obstacles_.count(id) == 0;
    const bool moves = !obstacle.shape.velocity().isZero();
    if (everything || is_new || moves) markers_.addObstacle(obstacle, now);
  }
  for (const int id : drawn_obstacles_) {
    if (known.count(id) == 0) markers_.removeObstacle(id);
  }
  drawn_obstacles_ = known;
}

std::string MarkerPublisher::statusText(double now) const {
  const auto tracking = std::count_if(status_.uavs.begin(), status_.uavs.end(),
                                      [](const UavStatus& uav) { return uav.state == UavStatus::TRACKING; });
  const auto alarms =
      std::count_if(status_.uavs.begin(), status_.uavs.end(), [](const UavStatus& uav) { return uav.alarm; });
  char text[160];
  const double run_time = status_.started ? now - toSeconds(status_.time_zero) : 0.0;
  std::snprintf(text, sizeof(text), "t = %.1f s    cycle %.1f ms    %ld of %zu tracking", run_time,
                1e3 * status_.cycle_time, static_cast<long>(tracking), drawings_.size());
  std::string line = text;
  if (alarms > 0) line += "    ALARM: " + std::to_string(alarms);
  return line;
}

}  // namespace swarm_planner
