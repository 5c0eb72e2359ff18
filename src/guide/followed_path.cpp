// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/followed_path.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

constexpr std::size_t kMostStretches = 64;  // of a path that something blocks; more are not needed to find a way on

/// Blocked stretches of a path in the order of their beginnings.
class Stretches {
 public:
  void add(double begin, double end) {
    if (count_ == kMostStretches) return;
    std::size_t i = count_++;
    for (; i > 0 && list_[i - 1].begin > begin; --i) list_[i] = list_[i - 1];
    list_[i] = {begin, end};
  }
  bool empty() const { return count_ == 0; }
  double begin() const { return list_[0].begin; }

  /// Where it is clear for `gap` [m] after the stretches that begin within `reach` [m], and until where.
  LineShare clearAfter(double reach, double gap, double length) const {
    double end = list_[0].end;
    for (std::size_t i = 1; i < count_; ++i) {
      if (list_[i].begin > end + gap && list_[i].begin > reach) return {end, list_[i].begin};
      end = std::max(end, list_[i].end);
    }
    return {end, length};
  }

 private:
  std::array<LineShare, kMostStretches> list_;
  std::size_t count_ = 0;
};

/// Notes where the flight along one straight piece is blocked.
void addBlocked(const BodySpace& space, const TimedPoint& from, const TimedPoint& to, double way, Stretches& stretches,
                Blockage& sizes) {
  const double length = (to.p - from.p).norm();
  for (std::size_t i = 0; i < space.size(); ++i) {
    const std::optional<LineShare> part = space.blockedBy(i, from, to);
    if (!part) continue;
    stretches.add(way + part->begin * length, way + part->end * length);
    const GuideBody& body = space.body(i);
    sizes.smallest = std::min(sizes.smallest, body.shape.radii().minCoeff() + body.distance);
    sizes.largest = std::max(sizes.largest, body.shape.halfExtents().maxCoeff() + body.distance);
  }
  for (double share = 0.0; share < 1.0;) {
    const std::optional<LineShare> part = space.map().firstBlocked(from.p, to.p, share);
    if (!part) break;
    stretches.add(way + part->begin * length, way + part->end * length);
    sizes.in_map = true;
    share = part->end;
  }
  const std::optional<LineShare> inside = space.shareInWorkspace(from.p, to.p);
  if (!inside) {
    stretches.add(way, way + length);
  } else {
    if (inside->begin > 0.0) stretches.add(way, way + inside->begin * length);
    if (inside->end < 1.0) stretches.add(way + inside->end * length, way + length);
  }
}

}  // namespace

void FollowedPath::assign(const ReferencePath& reference, double arc_length) {
  const PathPoint first = reference.at(arc_length);
  begin = first.arc_length;
  points[0] = first.position;
  ways[0] = 0.0;
  count = 1;
  ends = true;
  reference.forEachPointAfter(begin, [this](const Vector3& point, double arc) {
    if (count == kMostPoints) {
      ends = false;
      return false;
    }
    points[count] = point;
    ways[count++] = arc - begin;
    return true;
  });
}

Vector3 FollowedPath::at(double way) const {
  if (way <= 0.0) return points[0];
  for (std::size_t i = 1; i < count; ++i) {
    if (way >= ways[i]) continue;
    return points[i - 1] + (way - ways[i - 1]) / (ways[i] - ways[i - 1]) * (points[i] - points[i - 1]);
  }
  return points[count - 1];
}

std::optional<Blockage> findBlockage(const FollowedPath& path, const Vector3& start, const Pace& pace,
                                     const LookAhead& look, const BodySpace& space) {
  Stretches stretches;
  Blockage blockage;
  blockage.smallest = BodySpace::kFar;
  // A UAV beside its path comes back to it at half a right angle.
  const double away = (path.points[0] - start).norm();
  const double joined = std::min(away, path.length());
  const Vector3 joint = path.at(joined);
  const double approach = (joint - start).norm();
  if (!space.isClear(pace.after(start, 0.0), pace.after(joint, approach))) {
    Stretches unused;
    addBlocked(space, pace.after(start, 0.0), pace.after(joint, approach), 0.0, unused, blockage);
    stretches.add(0.0, joined);
  }
  if (path.count == 1 && !space.isClear(pace.after(joint, approach), pace.after(joint, approach))) {
    addBlocked(space, pace.after(joint, approach), pace.after(joint, approach), 0.0, stretches, blockage);
  }
  for (std::size_t i = 0; i + 1 < path.count; ++i) {
    if (path.ways[i + 1] <= joined) continue;
    const double from = std::max(path.ways[i], joined);
    const Vector3 begin = path.at(from);
    addBlocked(space, pace.after(begin, approach + from - joined),
               pace.after(path.points[i + 1], approach + path.ways[i + 1] - joined), from, stretches, blockage);
  }
  if (stretches.empty() || stretches.begin() > look.reach) return std::nullopt;
  blockage.begin = stretches.begin();
  const LineShare near = stretches.clearAfter(0.0, look.least_gap, path.length());
  const LineShare far = stretches.clearAfter(look.reach, look.least_gap, path.length());
  blockage.near_end = near.begin;
  blockage.next = near.end;
  blockage.to_end = near.begin >= path.length();
  blockage.far_end = far.begin;
  blockage.far_next = far.end;
  blockage.far_to_end = far.begin >= path.length();
  return blockage;
}

}  // namespace swarm_planner
