// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/map_watch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFirstLook = 1.0;  // [m]
// Looked for beyond what matters, so that a UAV need not be looked at each time [m].
constexpr double kSpare = 0.5;
// Farther from everything a UAV is not measured [m].
constexpr double kFarthest = 1000.0;

}  // namespace

MapWatch::MapWatch(std::shared_ptr<const VoxelMap> map, double uav_radius)
    : uav_radius_(uav_radius), min_clearance_(kInfinity) {
  setMap(std::move(map));
}

void MapWatch::setMap(std::shared_ptr<const VoxelMap> map) {
  const bool has_any = map != nullptr && (map->occupiedCount() > 0 || map->outsideIsOccupied());
  if (!has_any) map.reset();
  if (map == map_) return;
  map_ = std::move(map);
  for (Uav& uav : uavs_) uav.slack = -1.0;
}

const std::vector<std::size_t>& MapWatch::observe(const std::vector<Vector3>& positions) {
  entered_.clear();
  if (map_ == nullptr) return entered_;
  uavs_.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Uav& uav = uavs_[i];
    if ((positions[i] - uav.position).norm() <= uav.slack) continue;
    const bool was_in_contact = uav.in_contact;
    if (look(uav, positions[i]) && !was_in_contact) entered_.push_back(i);
  }
  return entered_;
}

std::optional<double> MapWatch::minClearance() const {
  if (min_clearance_ == kInfinity) return std::nullopt;
  return min_clearance_;
}

double MapWatch::distanceThatMatters(const Vector3& position) const {
  if (min_clearance_ < kInfinity) {
    return map_->distance(position, uav_radius_ + std::max(min_clearance_, 0.0) + kSpare);
  }
  for (double limit = kFirstLook; limit <= kFarthest; limit *= 2.0) {
    const double distance = map_->distance(position, limit);
    if (distance < limit) return distance;
  }
  return kInfinity;
}

bool MapWatch::look(Uav& uav, const Vector3& position) {
  const double clearance = distanceThatMatters(position) - uav_radius_;
  min_clearance_ = std::min(min_clearance_, clearance);
  uav.position = position;
  // Nothing at all was near: it takes some way until there is.
  uav.slack = clearance == kInfinity ? 0.5 * kFarthest : clearance - std::max(min_clearance_, 0.0);
  uav.in_contact = clearance < 0.0;
  return uav.in_contact;
}

}  // namespace swarm_planner
