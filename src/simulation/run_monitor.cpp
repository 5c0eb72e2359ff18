// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/run_monitor.hpp"

#include <algorithm>
#include <stdexcept>

namespace swarm_planner {
namespace {

constexpr double kTimeRounding = 1e-9;  // [s]

bool isOutside(const Vector3& p, const Workspace& box) {
  return (p.array() < box.min.array()).any() || (p.array() > box.max.array()).any();
}

/// Of those that there are.
std::optional<double> lesser(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

}  // namespace

RunMonitor::RunMonitor(const Mission& mission)
    : scenario_(mission.scenario),
      outside_(mission.scenario.uavs.size(), false),
      pairs_(mission.parameters.limits.pair_distance, mission.parameters.limits.pair_distance_vertical),
      obstacles_(mission.parameters.limits.uav_radius),
      map_(mission.map, mission.parameters.limits.uav_radius),
      progress_(mission),
      flights_(mission.scenario.uavs.size(), mission.map),
      cost_(mission.parameters.cost) {}

void RunMonitor::setMap(const std::shared_ptr<const VoxelMap>& map) {
  map_.setMap(map);
  flights_.setMap(map);
}

void RunMonitor::observe(double t, const std::vector<UavSample>& uavs, const std::vector<Superellipsoid>& obstacles) {
  if (uavs.size() != scenario_.uavs.size()) {
    throw std::invalid_argument("RunMonitor: the number of vehicles is not the scenario's");
  }
  const bool first = samples_ == 0;
  positions_.resize(uavs.size());
  velocities_.resize(uavs.size());
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    if (!first) path_length_ += (uavs[i].p - positions_[i]).norm();
    positions_[i] = uavs[i].p;
    velocities_[i] = uavs[i].v;
    tracking_error_sum_ += uavs[i].tracking_error;
    tracking_error_max_ = std::max(tracking_error_max_, uavs[i].tracking_error);
  }
  time_ = t;
  ++samples_;
  for (const auto& pair : pairs_.observe(positions_)) collisions_.push_back({t, pair.first, false, pair.second});
  for (const auto& contact : obstacles_.observe(positions_, obstacles)) {
    collisions_.push_back({t, contact.first, true, contact.second});
  }
  for (const std::size_t uav : map_.observe(positions_)) collisions_.push_back({t, uav, true, kMapPartner});
  progress_.observe(t, positions_, velocities_);
  flights_.observe(t, positions_, obstacles, progress_);
  watchWorkspace();
  integrateCost(uavs, obstacles);
  if (!ended_) ended_ = endConditionHolds();
}

void RunMonitor::watchWorkspace() {
  if (!scenario_.workspace) return;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const bool outside = isOutside(positions_[i], *scenario_.workspace);
    if (outside && !outside_[i]) ++workspace_violations_;
    outside_[i] = outside;
  }
}

void RunMonitor::integrateCost(const std::vector<UavSample>& uavs, const std::vector<Superellipsoid>& obstacles) {
  double integrand = 0.0;
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    integrand +=
        trackingCost(uavs[i].p, uavs[i].v, uavs[i].jerk, progress_.foot(i), progress_.target(i), cost_.weights());
    integrand += robustnessCost(uavs[i].p, obstacles, cost_.weights());
  }
  cost_.add(time_, integrand);
}

bool RunMonitor::endConditionHolds() {
  const EndCondition& end = scenario_.end;
  if (end.target_x) return progress_.allTargetsCrossed(*end.target_x);
  if (end.duration) return time_ >= *end.duration - kTimeRounding;
  if (progress_.allAtGoal()) return true;
  timed_out_ = time_ >= end.timeout - kTimeRounding;
  return timed_out_;
}

RunSummary RunMonitor::summary() const {
  RunSummary summary;
  summary.min_uav_distance = pairs_.minDistance();
  summary.min_obstacle_clearance = lesser(obstacles_.minClearance(), map_.minClearance());
  summary.collisions = collisions_;
  summary.mission_time = time_;
  summary.path_length = path_length_;
  summary.workspace_violations = workspace_violations_;
  summary.cost = cost_.value();
  summary.timed_out = timed_out_;
  const std::size_t count = positions_.size();
  if (count == 0) return summary;
  summary.tracking_error = {tracking_error_sum_ / static_cast<double>(samples_ * count), tracking_error_max_};
  summary.final_lag.max = progress_.lag(0);
  for (std::size_t i = 0; i < count; ++i) {
    const UavFlight flight = flights_.flight(i, progress_);
    summary.final_lag.mean += flight.lag / static_cast<double>(count);
    summary.final_lag.max = std::max(summary.final_lag.max, flight.lag);
    summary.stuck_uavs += flight.stuck ? 1 : 0;
    summary.arrived_uavs += flight.arrived ? 1 : 0;
    summary.flights.push_back(flight);
  }
  return summary;
}

}  // namespace swarm_planner
