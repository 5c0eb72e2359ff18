// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/obstacle_watch.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace swarm_planner {

ObstacleWatch::ObstacleWatch(double uav_radius)
    : uav_radius_(uav_radius), min_clearance_(std::numeric_limits<double>::infinity()) {}

const std::vector<ObstacleWatch::Contact>& ObstacleWatch::observe(const std::vector<Vector3>& positions,
                                                                  const std::vector<Superellipsoid>& obstacles) {
  entered_.clear();
  if (positions.empty() || obstacles.empty()) return entered_;
  measured_ = true;
  sleep_.resize(positions.size());
  obstacle_travel_ += farthestObstacleMove(obstacles);
  contacts_now_.clear();
  for (std::size_t uav = 0; uav < positions.size(); ++uav) {
    const Sleep& sleep = sleep_[uav];
    const double moved = (positions[uav] - sleep.position).norm() + obstacle_travel_ - sleep.obstacle_travel;
    if (moved > sleep.slack) look(uav, positions[uav], obstacles);
  }
  std::set_difference(contacts_now_.begin(), contacts_now_.end(), contacts_.begin(), contacts_.end(),
                      std::back_inserter(entered_));
  contacts_.swap(contacts_now_);
  return entered_;
}

std::optional<double> ObstacleWatch::minClearance() const {
  if (!measured_) return std::nullopt;
  return min_clearance_;
}

double ObstacleWatch::farthestObstacleMove(const std::vector<Superellipsoid>& obstacles) {
  obstacle_centers_.resize(obstacles.size(), Vector3::Zero());
  double farthest = 0.0;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    farthest = std::max(farthest, (obstacles[i].center() - obstacle_centers_[i]).norm());
    obstacle_centers_[i] = obstacles[i].center();
  }
  return farthest;
}

void ObstacleWatch::look(std::size_t uav, const Vector3& position, const std::vector<Superellipsoid>& obstacles) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    double clearance = obstacles[i].distanceLowerBound(position) - uav_radius_;
    if (clearance < std::max(min_clearance_, 0.0)) {
      clearance = obstacles[i].signedDistance(position) - uav_radius_;
      min_clearance_ = std::min(min_clearance_, clearance);
      if (clearance < 0.0) contacts_now_.emplace_back(uav, i);
    }
    least = std::min(least, clearance);
  }
  // Distances change by no more than what is moved, so this much movement changes nothing that is measured.
  sleep_[uav] = {position, obstacle_travel_, least - std::max(min_clearance_, 0.0)};
}

}  // namespace swarm_planner
