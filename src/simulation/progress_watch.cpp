// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/progress_watch.hpp"

#include <algorithm>
#include <limits>

#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {
namespace {

constexpr double kStuckLag = 20.0;      // [m]
constexpr double kStuckAdvance = 1.0;   // [m]
constexpr double kStuckMove = 5.0;      // [m]
constexpr double kParkedSpeed = 0.2;    // [m/s]
constexpr double kMemoryPeriod = 0.1;   // [s]
constexpr double kTimeRounding = 1e-9;  // [s]

/// The first foot: near the path's beginning if that is as near as any other point, so that a path which returns to
/// where it began is not taken for flown.
PathPoint firstFoot(const ReferencePath& path, const Vector3& position) {
  constexpr double kSameDistance = 1e-6;  // [m]
  const PathPoint at_beginning = path.nearest(position, 0.0);
  const PathPoint anywhere = path.nearest(position, 0.0, std::numeric_limits<double>::infinity());
  const bool as_near =
      (position - at_beginning.position).norm() <= (position - anywhere.position).norm() + kSameDistance;
  return as_near ? at_beginning : anywhere;
}

}  // namespace

ProgressWatch::ProgressWatch(const Mission& mission)
    : end_(mission.scenario.end),
      pair_distance_(mission.parameters.limits.pair_distance),
      pair_distance_vertical_(mission.parameters.limits.pair_distance_vertical) {
  if (!end_.all_at_goal) end_.tolerance = kDefaultTolerance;
  parking_margin_ = end_.tolerance + mission.parameters.limits.pair_margin;
  for (const ScenarioUav& uav : mission.scenario.uavs) {
    MovingTarget reference;
    reference.path = ReferencePath(uav.reference);
    reference.start = uav.target.start;
    reference.speed = uav.target.speed;
    references_.push_back(reference);
  }
}

void ProgressWatch::observe(double t, const std::vector<Vector3>& positions, const std::vector<Vector3>& velocities) {
  const bool first = feet_.empty();
  feet_.resize(positions.size());
  targets_.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const ReferencePath& path = references_[i].path;
    feet_[i] = first ? firstFoot(path, positions[i]) : path.nearest(positions[i], feet_[i].arc_length);
    targets_[i] = references_[i].at(t);
  }
  time_ = t;
  positions_ = positions;
  velocities_ = velocities;
  arrived_.clear();
  remember();
}

double ProgressWatch::lag(std::size_t uav) const { return targets_[uav].arc_length - feet_[uav].arc_length; }

Vector3 ProgressWatch::end(std::size_t uav) const { return references_[uav].path.points().back(); }

Vector3 ProgressWatch::targetTangent(std::size_t uav) const {
  return references_[uav].path.at(targets_[uav].arc_length).tangent;
}

bool ProgressWatch::stuck(std::size_t uav) const {
  const double most_lag = end_.all_at_goal ? end_.tolerance : kStuckLag;
  if (lag(uav) <= most_lag || arrived(uav)) return false;
  const Past& past = past_.front();
  return feet_[uav].arc_length - past.arc_lengths[uav] < kStuckAdvance &&
         (positions_[uav] - past.positions[uav]).norm() < kStuckMove;
}

bool ProgressWatch::arrived(std::size_t uav) const {
  if (arrived_.empty()) findArrived();
  return arrived_[uav];
}

void ProgressWatch::findArrived() const {
  arrived_.resize(positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) arrived_[i] = atEnd(i) || parked(i);
  // From the inside out.
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      if (arrived_[i] || !parkedBehind(i)) continue;
      arrived_[i] = more = true;
    }
  }
}

bool ProgressWatch::allAtGoal() const {
  for (std::size_t i = 0; i < references_.size(); ++i) {
    if (!atEnd(i)) return false;
  }
  return true;
}

bool ProgressWatch::allTargetsCrossed(double x) const {
  for (std::size_t i = 0; i < references_.size(); ++i) {
    const MovingTarget& reference = references_[i];
    const double end_x = reference.path.at(reference.path.length()).position.x();
    const double start_x = reference.path.at(reference.start).position.x();
    const bool crossed = end_x >= start_x ? targets_[i].p.x() >= x : targets_[i].p.x() <= x;
    const bool stands = reference.speed == 0.0 || targets_[i].arc_length >= reference.path.length();
    if (!crossed && !stands) return false;
  }
  return true;
}

void ProgressWatch::remember() {
  if (past_.empty() || time_ >= past_.back().time + kMemoryPeriod - kTimeRounding) {
    Past now{time_, {}, positions_};
    for (const PathPoint& foot : feet_) now.arc_lengths.push_back(foot.arc_length);
    past_.push_back(std::move(now));
  }
  while (past_.size() > 1 && past_[1].time <= time_ - kStuckTime + kTimeRounding) past_.pop_front();
}

bool ProgressWatch::atEnd(std::size_t uav) const { return (positions_[uav] - end(uav)).norm() <= end_.tolerance; }

bool ProgressWatch::parked(std::size_t uav) const {
  const Vector3 off = positions_[uav] - end(uav);
  if (velocities_[uav].norm() > kParkedSpeed) return false;
  if (pairGauge(off, pair_distance_ + parking_margin_, pair_distance_vertical_ + parking_margin_) > 1.0) return false;
  for (std::size_t other = 0; other < positions_.size(); ++other) {
    const bool occupies = other != uav && atEnd(other) &&
                          pairGauge(positions_[other] - end(uav), pair_distance_, pair_distance_vertical_) < 1.0;
    if (occupies) return true;
  }
  return false;
}

bool ProgressWatch::parkedBehind(std::size_t uav) const {
  if (velocities_[uav].norm() > kParkedSpeed) return false;
  const auto gauge = [this](const Vector3& d, double margin) {
    return pairGauge(d, pair_distance_ + margin, pair_distance_vertical_ + margin);
  };
  const double own = gauge(positions_[uav] - end(uav), 0.0);
  int beside = 0;
  for (std::size_t other = 0; other < positions_.size(); ++other) {
    if (other == uav || !arrived_[other] || gauge(end(other) - end(uav), 0.0) >= 1.0) continue;
    const bool is_nearer = gauge(positions_[other] - end(uav), 0.0) < own;
    beside += is_nearer && gauge(positions_[other] - positions_[uav], parking_margin_) <= 1.0 ? 1 : 0;
  }
  return beside >= 2;
}

}  // namespace swarm_planner
