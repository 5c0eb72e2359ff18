// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/body_space.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

constexpr double kRounding = 1e-6;  // more than what is missing at the start is relieved [m]

}  // namespace

Box GuideBody::boxUntil(double t) const {
  const Vector3 end = shape.center() + t * shape.velocity();
  const Vector3 extent = shape.halfExtents() + Vector3::Constant(distanceAt(t));
  Box box;
  box.min = shape.center().cwiseMin(end) - extent;
  box.max = shape.center().cwiseMax(end) + extent;
  return box;
}

void BodySpace::clear(const Workspace& workspace) {
  entries_.clear();
  workspace_ = workspace;
  comfort_ = 0.0;
  map_.set(nullptr, 0.0);
}

void BodySpace::add(const GuideBody& body) {
  if (entries_.size() < entries_.capacity()) entries_.push_back({&body, 0.0});
}

void BodySpace::relieve(const Vector3& start) {
  for (Entry& entry : entries_) {
    const GuideBody& body = *entry.body;
    const double wanted = body.distance + comfort_;
    if (body.shape.distanceLowerBound(start) >= wanted) continue;
    const double distance = body.shape.signedDistance(start);
    if (distance < wanted) entry.relief = body.distance - distance + kRounding;
    if (entry.relief <= 0.0 && distance < wanted) entry.relief = kRounding;
  }
  map_.relieve(start);
  workspace_.min = workspace_.min.cwiseMin(start);
  workspace_.max = workspace_.max.cwiseMax(start);
}

bool BodySpace::isInWorkspace(const Vector3& p) const {
  return (p.array() >= workspace_.min.array()).all() && (p.array() <= workspace_.max.array()).all();
}

std::optional<LineShare> BodySpace::shareInWorkspace(const Vector3& a, const Vector3& b) const {
  LineShare inside;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = b[axis] - a[axis];
    const double low = workspace_.min[axis] - a[axis];
    const double high = workspace_.max[axis] - a[axis];
    if (way == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    inside.begin = std::max(inside.begin, std::min(low / way, high / way));
    inside.end = std::min(inside.end, std::max(low / way, high / way));
  }
  if (inside.begin > inside.end) return std::nullopt;
  return inside;
}

double BodySpace::clearance(const TimedPoint& x) const {
  double least = std::min({kFar, (x.p - workspace_.min).minCoeff(), (workspace_.max - x.p).minCoeff()});
  for (const Entry& entry : entries_) {
    if (least < 0.0) break;
    const Superellipsoid& shape = entry.body->shape;
    const Vector3 p = x.p - x.t * shape.velocity();
    const double wanted = demand(entry, x.t);
    if (shape.distanceLowerBound(p) - wanted >= least) continue;
    least = std::min(least, shape.signedDistance(p) - wanted);
  }
  if (least >= 0.0) least = std::min(least, map_.clearance(x.p));
  return least;
}

bool BodySpace::mayTouch(const Entry& entry, const TimedPoint& from, const TimedPoint& to) const {
  const Superellipsoid& shape = entry.body->shape;
  const Vector3 a = from.p - from.t * shape.velocity() - shape.center();
  const Vector3 b = to.p - to.t * shape.velocity() - shape.center();
  const Vector3 extent = shape.halfExtents() + Vector3::Constant(std::max(demand(entry, to.t), 0.0));
  return (a.cwiseMin(b).array() < extent.array()).all() && (a.cwiseMax(b).array() > -extent.array()).all();
}

ConvexPassage BodySpace::passage(const Entry& entry, const TimedPoint& from, const TimedPoint& to) const {
  const Superellipsoid& shape = entry.body->shape;
  return ConvexPassage(shape, from.p - from.t * shape.velocity(), to.p - to.t * shape.velocity(), demand(entry, to.t));
}

bool BodySpace::isClear(const TimedPoint& from, const TimedPoint& to) const {
  if (!isInWorkspace(from.p) || !isInWorkspace(to.p)) return false;
  return std::all_of(
             entries_.begin(), entries_.end(),
             [&](const Entry& entry) { return !mayTouch(entry, from, to) || passage(entry, from, to).isClear(); }) &&
         map_.isClear(from.p, to.p);
}

std::optional<LineShare> BodySpace::blockedBy(std::size_t i, const TimedPoint& from, const TimedPoint& to) const {
  const Entry& entry = entries_[i];
  if (!mayTouch(entry, from, to)) return std::nullopt;
  return passage(entry, from, to).blocked();
}

}  // namespace swarm_planner
