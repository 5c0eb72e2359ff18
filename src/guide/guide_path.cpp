// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/guide_path.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

constexpr int kSweeps = 6;
constexpr double kNoGain = 1e-6;      // of the length: a pull that shortens it by less is none
constexpr int kHalvings = 5;          // of a pull that is not clear
constexpr double kWorthwhile = 1e-3;  // of the length, for another sweep

/// Whether the path from its point `first` on is clear.
bool isClearFrom(const GuidePath& path, std::size_t first, double way, const Pace& pace, const FreeSpace& space) {
  for (std::size_t i = first; i + 1 < path.count; ++i) {
    const TimedPoint from = pace.after(path.points[i], way);
    way += (path.points[i + 1] - path.points[i]).norm();
    if (!space.isClear(from, pace.after(path.points[i + 1], way))) return false;
  }
  return true;
}

class Tightening {
 public:
  Tightening(GuidePath& path, const Pace& pace, const FreeSpace& space, const Traffic& traffic)
      : path_(path), pace_(pace), space_(space), traffic_(traffic), cost_(costOf(path, pace, traffic)) {}

  void run() {
    dropPoints();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      const double before = cost_;
      for (std::size_t i = 1; i + 1 < path_.count; ++i) pull(i);
      dropPoints();
      if (before - cost_ < kWorthwhile * before) break;
    }
  }

 private:
  /// Takes the other path if it is clear and costs at most `most`. What comes before point `first` is the same.
  bool take(const GuidePath& other, std::size_t first, double most) {
    const double cost = costOf(other, pace_, traffic_);
    if (!(cost <= most)) return false;
    double way = 0.0;
    for (std::size_t i = 0; i < first; ++i) way += (other.points[i + 1] - other.points[i]).norm();
    if (!isClearFrom(other, first, way, pace_, space_)) return false;
    path_ = other;
    cost_ = cost;
    return true;
  }

  void dropPoints() {
    for (std::size_t i = 1; i + 1 < path_.count;) {
      GuidePath shorter = path_;
      std::copy(path_.points.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                path_.points.begin() + static_cast<std::ptrdiff_t>(path_.count),
                shorter.points.begin() + static_cast<std::ptrdiff_t>(i));
      --shorter.count;
      if (!take(shorter, i - 1, cost_)) ++i;
    }
  }

  void pull(std::size_t i) {
    const Vector3& before = path_.points[i - 1];
    const Vector3 chord = path_.points[i + 1] - before;
    const double squared = chord.squaredNorm();
    const double along = (path_.points[i] - before).dot(chord);
    const double share = squared > 0.0 ? std::clamp(along / squared, 0.0, 1.0) : 0.0;
    const Vector3 pulled = before + share * chord;
    const Vector3 old = path_.points[i];
    double part = 1.0;
    for (int halving = 0; halving < kHalvings; ++halving, part *= 0.5) {
      GuidePath other = path_;
      other.points[i] = old + part * (pulled - old);
      if (take(other, i - 1, (1.0 - kNoGain) * cost_)) return;
    }
  }

  GuidePath& path_;
  const Pace& pace_;
  const FreeSpace& space_;
  const Traffic& traffic_;
  double cost_;
};

}  // namespace

double GuidePath::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < count; ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

bool GuidePath::append(const Vector3& point) {
  if (count == kMostPoints) return false;
  points[count++] = point;
  return true;
}

bool isClear(const GuidePath& path, const Pace& pace, const FreeSpace& space) {
  if (path.count == 1) return space.isClear(pace.after(path.points[0], 0.0), pace.after(path.points[0], 0.0));
  return isClearFrom(path, 0, 0.0, pace, space);
}

double costOf(const GuidePath& path, const Pace& pace, const Traffic& traffic) {
  double way = 0.0;
  double cost = 0.0;
  for (std::size_t i = 1; i < path.count; ++i) {
    const TimedPoint from = pace.after(path.points[i - 1], way);
    way += (path.points[i] - path.points[i - 1]).norm();
    cost += traffic.cost(from, pace.after(path.points[i], way));
  }
  return way + cost;
}

GuidePath restOf(const GuidePath& path, const Vector3& p) {
  std::size_t next = path.count - 1;
  Vector3 foot = path.end();
  double least = (p - foot).squaredNorm();
  for (std::size_t i = 0; i + 1 < path.count; ++i) {
    const Vector3 way = path.points[i + 1] - path.points[i];
    const double squared = way.squaredNorm();
    const double share = squared > 0.0 ? std::clamp((p - path.points[i]).dot(way) / squared, 0.0, 1.0) : 0.0;
    const Vector3 candidate = path.points[i] + share * way;
    const double distance = (p - candidate).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    foot = candidate;
    next = i + 1;
  }
  GuidePath rest;
  rest.append(p);
  rest.append(foot);
  for (std::size_t i = next; i < path.count; ++i) rest.append(path.points[i]);
  return rest;
}

void tighten(GuidePath& path, const Pace& pace, const FreeSpace& space, const Traffic& traffic) {
  if (path.count > 2) Tightening(path, pace, space, traffic).run();
}

}  // namespace swarm_planner
