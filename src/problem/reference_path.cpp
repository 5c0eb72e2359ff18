// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/reference_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {

ReferencePath::ReferencePath(const std::vector<Vector3>& points) {
  points_.reserve(points.size());
  arc_lengths_.reserve(points.size());
  tangents_.reserve(points.size());
  for (const Vector3& point : points) {
    const double step = points_.empty() ? 0.0 : (point - points_.back()).norm();
    if (!points_.empty() && step < kShortestSegment) continue;
    if (!points_.empty()) tangents_.push_back((point - points_.back()) / step);
    arc_lengths_.push_back(length() + step);
    points_.push_back(point);
  }
}

void ReferencePath::assignLine(const Vector3& begin, const Vector3& end) {
  points_.assign(1, begin);
  arc_lengths_.assign(1, 0.0);
  tangents_.clear();
  const double step = (end - begin).norm();
  if (step < kShortestSegment) return;
  tangents_.push_back((end - begin) / step);
  arc_lengths_.push_back(step);
  points_.push_back(end);
}

std::size_t ReferencePath::segmentAt(double arc_length) const {
  const auto next = std::upper_bound(arc_lengths_.begin() + 1, arc_lengths_.end() - 1, arc_length);
  return static_cast<std::size_t>(next - arc_lengths_.begin()) - 1;
}

PathPoint ReferencePath::onSegment(std::size_t segment, double arc_length) const {
  PathPoint point;
  point.tangent = tangents_[segment];
  point.position = points_[segment] + (arc_length - arc_lengths_[segment]) * point.tangent;
  point.arc_length = arc_length;
  return point;
}

PathPoint ReferencePath::at(double arc_length) const {
  if (points_.size() < 2) {
    PathPoint point;
    if (!points_.empty()) point.position = points_.front();
    return point;
  }
  const double clamped = std::min(std::max(arc_length, 0.0), length());
  return onSegment(segmentAt(clamped), clamped);
}

PathPoint ReferencePath::nearest(const Vector3& position, double near, double window) const {
  return nearestBetween(position, near - window, near + window);
}

PathPoint ReferencePath::nearestBetween(const Vector3& position, double first, double last) const {
  first = std::min(std::max(first, 0.0), length());
  last = std::min(std::max(last, 0.0), length());
  PathPoint best = at(first);
  if (points_.size() < 2) return best;
  double best_squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = segmentAt(first); i + 1 < points_.size() && arc_lengths_[i] <= last; ++i) {
    const double from = std::max(first, arc_lengths_[i]);
    const double to = std::min(last, arc_lengths_[i + 1]);
    PathPoint foot = onSegment(i, from);
    const double along = std::min(std::max(foot.tangent.dot(position - foot.position), 0.0), to - from);
    foot.position += along * foot.tangent;
    foot.arc_length += along;
    const double squared = (position - foot.position).squaredNorm();
    if (squared < best_squared) {
      best_squared = squared;
      best = foot;
    }
  }
  return best;
}

double ReferencePath::nextTurn(double arc_length, double cosine) const {
  const auto next = std::upper_bound(arc_lengths_.begin(), arc_lengths_.end(), arc_length);
  for (auto i = static_cast<std::size_t>(next - arc_lengths_.begin()); i < tangents_.size(); ++i) {
    if (i > 0 && tangents_[i - 1].dot(tangents_[i]) < cosine) return arc_lengths_[i];
  }
  return std::numeric_limits<double>::infinity();
}

double ReferencePath::nextCorner(double arc_length) const {
  constexpr double kSameDirection = 1.0 - 1e-9;
  return nextTurn(arc_length, kSameDirection);
}

double ReferencePath::nextSharpCorner(double arc_length) const { return nextTurn(arc_length, kSharpTurn); }

double ReferencePath::lastSharpCorner(double arc_length) const {
  if (tangents_.empty()) return 0.0;
  for (std::size_t i = segmentAt(std::min(arc_length, length())); i > 0; --i) {
    if (tangents_[i - 1].dot(tangents_[i]) < kSharpTurn) return arc_lengths_[i];
  }
  return 0.0;
}

double ReferencePath::advance(const Vector3& position, double progress, double pass_distance) const {
  constexpr double kWindow = 5.0;  // that of nearest()
  const double first = std::max(progress - kWindow, lastSharpCorner(progress));
  const double corner = nextSharpCorner(progress);
  const PathPoint foot = nearestBetween(position, first, std::min(progress + kWindow, corner));
  if (corner > progress + kWindow) return foot.arc_length;
  const PathPoint beyond = nearestBetween(position, corner, progress + kWindow);
  const bool is_there = (position - at(corner).position).norm() < pass_distance;
  const bool is_nearer = (position - beyond.position).norm() + pass_distance < (position - foot.position).norm();
  return is_there || is_nearer ? beyond.arc_length : foot.arc_length;
}

TargetState MovingTarget::at(double t) const {
  const double moved = start + speed * std::max(0.0, t - time_zero);
  const PathPoint point = path.at(moved);
  TargetState target;
  target.p = point.position;
  target.arc_length = point.arc_length;
  if (t >= time_zero && moved < path.length()) target.v = speed * point.tangent;
  return target;
}

}  // namespace swarm_planner
