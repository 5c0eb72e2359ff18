// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/map_space.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

constexpr double kRecovery = 0.25;  // per metre of the way from a start that is too near, demanded again [m]
constexpr double kRounding = 1e-6;  // [m]
constexpr double kShort = 1e-3;     // lines shorter than this are as their middle [m]
constexpr double kFarSight = 0.4;   // how far is looked beyond what is demanded: looking farther takes longer [m]
constexpr double kStep = 0.25;      // of a voxel, along a line that is blocked or nearly

}  // namespace

void MapSpace::set(const VoxelMap* map, double distance) {
  map_ = map;
  distance_ = distance;
  comfort_ = 0.0;
  is_relieved_ = false;
}

void MapSpace::relieve(const Vector3& start) {
  if (map_ == nullptr) return;
  start_ = start;
  const double wanted = distance_ + std::max(comfort_, 0.0);
  has_ = map_->distance(start, wanted) - kRounding;
  is_relieved_ = has_ < wanted;
}

double MapSpace::demandAt(const Vector3& p) const {
  const double wanted = distance_ + comfort_;
  return is_relieved_ ? std::min(wanted, has_ + kRecovery * (p - start_).norm()) : wanted;
}

bool MapSpace::hasEmptyBox(const Vector3& from, const Vector3& to) const {
  const Vector3 wanted = Vector3::Constant(std::max(distance_ + comfort_, 0.0));
  return map_->isEmpty({from.cwiseMin(to) - wanted, from.cwiseMax(to) + wanted});
}

double MapSpace::clearance(const Vector3& p) const {
  if (map_ == nullptr) return 0.0;
  if (hasEmptyBox(p, p)) return 0.0;
  const double wanted = demandAt(p);
  return map_->distance(p, std::max(wanted, 0.0)) - wanted;
}

bool MapSpace::isClear(const Vector3& from, const Vector3& to) const {
  if (map_ == nullptr || hasEmptyBox(from, to)) return true;
  const double half = 0.5 * (to - from).norm();
  const Vector3 middle = 0.5 * (from + to);
  const double wanted = demandAt(middle);
  const double needed = (1.0 + kRecovery) * half;
  const double found = map_->distance(middle, std::max(wanted, 0.0) + std::min(needed, kFarSight));
  if (found < wanted) return false;
  if (found >= wanted + needed || half < 0.5 * kShort) return true;
  return isClear(from, middle) && isClear(middle, to);
}

std::optional<LineShare> MapSpace::firstBlocked(const Vector3& from, const Vector3& to, double share) const {
  if (map_ == nullptr) return std::nullopt;
  const double length = (to - from).norm();
  const double step = kStep * map_->resolution();
  std::optional<LineShare> blocked;
  for (double way = share * length; way <= length; way += step) {
    const Vector3 p = from + (length > 0.0 ? way / length : 0.0) * (to - from);
    const double wanted = demandAt(p);
    const double room = map_->distance(p, std::max(wanted, 0.0) + kFarSight) - wanted;
    const double at = length > 0.0 ? way / length : 0.0;
    if (room < 0.0 && !blocked) blocked = LineShare{at, 1.0};
    if (room >= 0.0 && blocked) {
      blocked->end = at;
      return blocked;
    }
    if (room > 0.0) way += room / (1.0 + kRecovery);
  }
  return blocked;
}

}  // namespace swarm_planner
