// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/map_check.hpp"

#include <algorithm>
#include <cmath>

#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {
namespace {

/// Halvings of one piece, and pieces looked at for one motion: a bound on the time that a proof takes.
constexpr int kMaxDepth = 16;
constexpr int kMaxNodes = 4000;

double gapTo(const Box& box, const Vector3& p) { return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).norm(); }

}  // namespace

MapProof::MapProof(const VoxelMap& map, double least, const Vector3& committed)
    : map_(map), demanded_(std::max(least - kDistanceTolerance, 0.0)), committed_(committed) {
  const double has = map.distance(committed, demanded_);
  if (has >= demanded_) return;
  is_inside_ = has <= 0.0;
  exempt_ = least;
  if (!is_inside_) demanded_ = std::max(has - kDistanceTolerance, 0.0);
}

ClearanceFinding MapProof::prove(const CommittedMotion& motion) {
  for (int k = 0; k <= motion.pieces(); ++k) {
    const double from = k * motion.dt();
    const ClearanceFinding finding = prove(motion.piece(k), from, k < motion.pieces() ? from + motion.dt() : from, 0);
    if (!finding.clear) return finding;
  }
  return {};
}

ClearanceFinding MapProof::prove(const BernsteinPoints<4>& points, double from, double to, int depth) {
  const Vector3 middle = curveMiddle(points);
  const double time = 0.5 * (from + to);
  double squared_radius = 0.0;
  Box hull;
  for (const Vector3& point : points) {
    squared_radius = std::max(squared_radius, (point - middle).squaredNorm());
    hull.include(point);
  }
  // The box first: it takes the words of some rows of voxels, the distance a search.
  const Vector3 room = Vector3::Constant(demanded_);
  if (middle.allFinite() && isEmpty({hull.min - room, hull.max + room})) return {};
  const double radius = std::sqrt(squared_radius);
  const double found = distance(middle, demanded_ + radius);
  if (!(found >= demanded_)) return {false, false, time};
  if (found >= demanded_ + radius) return {};
  if (depth == kMaxDepth || ++nodes_ > kMaxNodes) return {false, true, time};
  BernsteinPoints<4> left;
  BernsteinPoints<4> right;
  halve(points, left, right);
  const ClearanceFinding first = prove(left, from, time, depth + 1);
  return first.clear ? prove(right, time, to, depth + 1) : first;
}

double MapProof::distance(const Vector3& p, double limit) const {
  if (!is_inside_) return map_.distance(p, limit);
  double least = limit;
  const Vector3 reach = Vector3::Constant(limit);
  map_.forEachOccupied({p - reach, p + reach}, [&](const VoxelIndex& voxel) {
    if (counts(voxel)) least = std::min(least, gapTo(map_.boxOf(voxel), p));
  });
  return least;
}

bool MapProof::isEmpty(const Box& box) const {
  if (!is_inside_) return map_.isEmpty(box);
  bool is_empty = true;
  map_.forEachOccupied(box, [&](const VoxelIndex& voxel) { is_empty = is_empty && !counts(voxel); });
  return is_empty;
}

bool MapProof::counts(const VoxelIndex& voxel) const { return gapTo(map_.boxOf(voxel), committed_) >= exempt_; }

}  // namespace swarm_planner
