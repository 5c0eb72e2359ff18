// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What planner_node does about failures around it: its own death, ROS time that stands still.
#include <ros/console.h>
#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <ros/time.h>

#include <algorithm>
#include <stdexcept>

#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/planner_node.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {

void PlannerNode::openRecord(const std::string& path, const Mission& mission) {
  if (path.empty()) return;
  std::string run_id;
  ros::param::get("/run_id", run_id);
  const std::string chosen =
      path == "auto" ? defaultRecordPath(ros::this_node::getName(), ros::master::getURI()) : path;
  try {
    record_ = std::make_unique<FlightRecord>(chosen, mission, run_id, ros::WallTime::now().toSec());
  } catch (const std::runtime_error& error) {
    ROS_ERROR("No record of the flight is kept: %s. A planner started in flight will know nothing but odometry.",
              error.what());
    return;
  }
  modes_.resize(names_.size());
  for (std::size_t uav = 0; uav < names_.size(); ++uav) {
    const FlightMode mode = record_->orders()[uav].mode;
    // Only with the motions at hand does a UAV go on flying by itself; whatever keeps it from flying holds anyway.
    if (mode != FlightMode::kWaiting && mode != FlightMode::kFlying && mode != planner_.mode(uav)) {
      planner_.restoreMode(uav, mode);
      ROS_WARN("%s is %s, as it was told before the planner was started", names_[uav].c_str(), modeText(mode));
    }
    const auto& reference = record_->orders()[uav].reference;
    if (!reference) continue;
    try {
      planner_.setReference(uav, reference->path, reference->start, reference->speed);
      ROS_WARN("%s follows the reference that was set before the planner was started", names_[uav].c_str());
    } catch (const std::invalid_argument& error) {
      ROS_ERROR("%s: the reference on record is of no use: %s", names_[uav].c_str(), error.what());
    }
  }
}

void PlannerNode::takeOver(double now) {
  if (!record_) return;
  const auto memory = record_->takeMotions(now, ros::WallTime::now().toSec());
  if (!record_->ignored().empty()) ROS_WARN("Flight's record: %s", record_->ignored().c_str());
  if (!memory) return;
  const auto known =
      std::count_if(memory->uavs.begin(), memory->uavs.end(), [](const UavMemory& uav) { return uav.motions > 0; });
  ROS_WARN("Started in flight: taking over %zd of %zu UAVs from the record of the planner before", known,
           names_.size());
  planner_.takeOver(*memory);
  for (std::size_t uav = 0; uav < names_.size(); ++uav) {
    if (record_->orders()[uav].mode == FlightMode::kFlying) planner_.restoreMode(uav, FlightMode::kFlying);
  }
}

void PlannerNode::keepModes() {
  if (!record_) return;
  for (std::size_t uav = 0; uav < modes_.size(); ++uav) modes_[uav] = planner_.mode(uav);
  if (!record_->setModes(modes_)) {
    ROS_WARN_THROTTLE(kWarningPeriod,
                      "Commands could not be written to the flight's record: a planner restarted will "
                      "not know of them");
  }
}

void PlannerNode::reportHealth() {
  const double now = toSeconds(ros::Time::now());
  const double wall = ros::SteadyTime::now().toSec();
  clock_.note(now, wall);
  const TrackInput tracks = inputs_.store().tracks();
  diagnostics_.publish(inputs_.store().uavs(), tracks, inputs_.transforms(), maps_.report(), now, clock_.fault());
  // The throttled macros of roscpp count ROS time, which may be what stands still.
  if (wall < next_health_warning_) return;
  std::string text = clock_.fault();
  if (text.empty() && tracks.received && now - tracks.stamp > track_timeout_) {
    text = "no obstacle tracks any more: the known obstacles are forgotten, UAVs fly on without them";
  }
  if (text.empty()) return;
  next_health_warning_ = wall + kWarningPeriod;
  ROS_ERROR_STREAM(text);
}

}  // namespace swarm_planner
