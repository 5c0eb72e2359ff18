// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/convex_passage.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

constexpr int kMostTangents = 40;
constexpr int kHalvings = 14;
constexpr double kShortest = 1e-9;  // part of a line between two tangents that is not divided further

}  // namespace

ConvexPassage::Sample ConvexPassage::at(double share) const {
  Vector3 normal;
  const double distance = shape_.signedDistance(a_ + share * way_, normal);
  return {share, distance - distance_, normal.dot(way_)};
}

std::optional<ConvexPassage::Sample> ConvexPassage::findBlocked() const {
  Sample left = at(0.0);
  if (left.value < -kTolerance) return left;
  if (left.slope >= 0.0) return std::nullopt;
  Sample right = at(1.0);
  if (right.value < -kTolerance) return right;
  if (right.slope <= 0.0) return std::nullopt;
  for (int i = 0; i < kMostTangents && right.share - left.share > kShortest; ++i) {
    // Where the tangents of both ends meet, the distance is at least theirs.
    const double width = right.share - left.share;
    const double step = (right.value - left.value - right.slope * width) / (left.slope - right.slope);
    if (left.value + left.slope * step >= -kTolerance) return std::nullopt;
    const Sample middle = at(left.share + std::min(std::max(step, 0.01 * width), 0.99 * width));
    if (middle.value < -kTolerance) return middle;
    (middle.slope < 0.0 ? left : right) = middle;
  }
  return std::nullopt;
}

double ConvexPassage::edge(double blocked, double clear) const {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (blocked + clear);
    (at(middle).value < -kTolerance ? blocked : clear) = middle;
  }
  return clear;
}

std::optional<LineShare> ConvexPassage::blocked() const {
  const std::optional<Sample> inside = findBlocked();
  if (!inside) return std::nullopt;
  LineShare part;
  if (at(0.0).value >= -kTolerance) part.begin = edge(inside->share, 0.0);
  if (at(1.0).value >= -kTolerance) part.end = edge(inside->share, 1.0);
  return part;
}

}  // namespace swarm_planner
