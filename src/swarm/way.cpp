// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/way.hpp"

#include <algorithm>

#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {
namespace {

Vector3 nearestOnSegment(const Vector3& from, const Vector3& to, const Vector3& q) {
  const Vector3 d = to - from;
  const double squared = d.squaredNorm();
  if (squared == 0.0) return from;
  return from + std::clamp(d.dot(q - from) / squared, 0.0, 1.0) * d;
}

}  // namespace

double PairSpacing::gauge(const Vector3& d) const { return pairGauge(d, horizontal, vertical); }

Way::Way(const MovingTarget& target, const Vector3& p, double foot, double t)
    : path_(&target.path),
      p_(p),
      foot_(foot),
      end_(std::max(foot, target.speed > 0.0 ? target.path.length() : target.at(t).arc_length)) {}

double Way::arcOf(const Vector3& q, double length) const {
  const double half = 0.5 * std::min(length, end_ - foot_);
  return path_->nearest(q, foot_ + half, half).arc_length;
}

double Way::gaugeTo(const Vector3& q, double length, const PairSpacing& spacing) const {
  const double on_path = spacing.gauge(q - path_->at(arcOf(q, length)).position);
  const Vector3 joined = path_->at(std::min(foot_ + spacing.horizontal, end_)).position;
  return std::min(on_path, spacing.gauge(q - nearestOnSegment(p_, joined, q)));
}

bool Way::isBlockedAt(const Vector3& q, double length, double least, const PairSpacing& spacing) const {
  const double ahead = std::min(foot_ + spacing.horizontal, end_);
  const Vector3 onwards = path_->at(ahead).position - p_;
  const bool is_behind = onwards.dot(q - p_) <= 0.0 && arcOf(q, length) <= foot_;
  return !is_behind && gaugeTo(q, length, spacing) < least;
}

}  // namespace swarm_planner
