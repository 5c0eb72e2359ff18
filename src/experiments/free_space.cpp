// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/free_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace swarm_planner {
namespace {

constexpr double kRounding = 1e-4;      // what a point may be too close by [m]
constexpr double kMostClearance = 2.0;  // [m]

/// What is gained by going straight from `a` to `c` instead of over `b` [m].
double detour(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b - a).norm() + (c - b).norm() - (c - a).norm();
}

/// The path without the corners that are not needed.
void dropCorners(const FreeSpace& space, std::vector<Vector3>& path) {
  for (std::size_t i = 1; i + 1 < path.size();) {
    if (space.isFree(path[i - 1], path[i + 1])) {
      path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
      i = std::max<std::size_t>(i - 1, 1);
    } else {
      ++i;
    }
  }
}

/// The largest t in [0, most] for which `accepts`, to a thousandth; 0 if there is none.
template <class Accepts>
double largest(double most, const Accepts& accepts) {
  if (accepts(most)) return most;
  double good = 0.0, bad = most;
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (good + bad);
    (accepts(middle) ? good : bad) = middle;
  }
  return good;
}

/// Moves a corner by `step` along an axis wherever that makes the path shorter, and towards the straight line.
void slide(const FreeSpace& space, const Vector3& before, Vector3& corner, const Vector3& after, double step) {
  const auto isFree = [&](const Vector3& p) { return space.isFree(before, p) && space.isFree(p, after); };
  const Vector3 chord = after - before;
  const double share = chord.squaredNorm() > 0.0 ? (corner - before).dot(chord) / chord.squaredNorm() : 0.5;
  const Vector3 pull = before + std::clamp(share, 0.0, 1.0) * chord - corner;
  corner += largest(1.0, [&](double t) { return isFree(corner + t * pull); }) * pull;
  for (int direction = 0; direction < 6; ++direction) {
    Vector3 moved = corner;
    moved[direction / 2] += direction % 2 == 0 ? step : -step;
    if (detour(before, moved, after) < detour(before, corner, after) && isFree(moved)) corner = moved;
  }
}

/// Cuts corners that turn by more than some degrees off, as far as that is free.
void cutCorners(const FreeSpace& space, std::vector<Vector3>& path) {
  constexpr double kLeastTurn = 0.08;  // [rad]
  std::vector<Vector3> cut = {path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Vector3 back = path[i - 1] - path[i];
    const Vector3 ahead = path[i + 1] - path[i];
    const double turn = std::atan2(back.cross(ahead).norm(), -back.dot(ahead));
    const double least = std::min(back.norm(), ahead.norm());
    const auto isFree = [&](double t) {
      return space.isFree(path[i] + t * back.normalized(), path[i] + t * ahead.normalized());
    };
    const double t = turn > kLeastTurn ? largest(0.5 * least, isFree) : 0.0;
    if (t > 0.0) cut.push_back(path[i] + t * back.normalized());
    cut.push_back(t > 0.0 ? path[i] + t * ahead.normalized() : path[i]);
  }
  cut.push_back(path.back());
  path = std::move(cut);
}

}  // namespace

FreeSpace::FreeSpace(std::vector<Superellipsoid> obstacles, double radius, const Workspace& box,
                     std::shared_ptr<const VoxelMap> map)
    : obstacles_(std::move(obstacles)), map_(std::move(map)), radius_(radius), box_(box) {}

double FreeSpace::clearance(const Vector3& p) const {
  double least = kMostClearance + radius_;
  for (const Superellipsoid& obstacle : obstacles_) {
    if (obstacle.distanceLowerBound(p) < least) least = std::min(least, obstacle.signedDistance(p));
  }
  if (map_ != nullptr) least = map_->distance(p, least);
  return least - radius_;
}

bool FreeSpace::isFree(const Vector3& p) const {
  return (p.array() >= box_.min.array() - kRounding).all() && (p.array() <= box_.max.array() + kRounding).all() &&
         clearance(p) >= -kRounding;
}

bool FreeSpace::isFree(const Vector3& a, const Vector3& b) const {
  if (!isFree(a) || !isFree(b)) return false;
  const double length = (b - a).norm();
  const double least_step = std::max(0.02 * radius_, 1e-3);
  for (double s = 0.0; s < length;) {
    const double free = clearance(a + (s / length) * (b - a));
    if (free < -kRounding) return false;
    s += std::max(free, least_step);
  }
  return true;
}

double lengthOf(const std::vector<Vector3>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

std::vector<Vector3> tightened(const FreeSpace& space, std::vector<Vector3> path, double step) {
  constexpr int kHalvings = 6, kCuts = 5;
  const auto slideAll = [&](double by) {
    for (std::size_t i = 1; i + 1 < path.size(); ++i) slide(space, path[i - 1], path[i], path[i + 1], by);
  };
  for (int i = 0; i < kHalvings; ++i) {
    dropCorners(space, path);
    slideAll(step);
    slideAll(step);
    step *= 0.5;
  }
  for (int i = 0; i < kCuts; ++i) {
    cutCorners(space, path);
    dropCorners(space, path);
    slideAll(step);
  }
  return path;
}

}  // namespace swarm_planner
