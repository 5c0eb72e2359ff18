// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/guide/convex_passage.hpp"
#include "swarm_planner/guide/free_space.hpp"
#include "swarm_planner/guide/map_space.hpp"
#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {

/// Something that guides lead around: an obstacle on its way, or a UAV at rest.
struct GuideBody {
  static constexpr std::uint32_t kNoUav = std::numeric_limits<std::uint32_t>::max();

  Superellipsoid shape;        ///< at time zero; at constant velocity from then on
  double distance = 0.0;       ///< to be kept from its surface at time zero [m]
  double growth_rate = 0.0;    ///< of the distance, because the prediction gets worse [m/s]
  double growth_limit = 0.0;   ///< [m]
  std::uint32_t uav = kNoUav;  ///< the one at rest

  /// To be kept at time `t` [s].
  double distanceAt(double t) const { return distance + std::min(growth_rate * t, growth_limit); }
  /// Contains what is to be kept clear of from time zero until `t` [s].
  Box boxUntil(double t) const;
};

/// Bodies, a workspace and a map that a guide keeps clear of. Takes no heap while it has room.
class BodySpace : public FreeSpace {
 public:
  /// Farther than this free distances are not told apart [m].
  static constexpr double kFar = 1e6;

  /// Empty, with room for `capacity` bodies.
  explicit BodySpace(std::size_t capacity) { entries_.reserve(capacity); }

  /// Nothing but the workspace.
  void clear(const Workspace& workspace);
  /// `distance` is to be kept from the occupied voxels of `map` [m], which must outlive its use here; null: none.
  void setMap(const VoxelMap* map, double distance) { map_.set(map, distance); }
  /// The body must outlive its use here. Left out if there is no room.
  void add(const GuideBody& body);
  /// Of a body that is nearer to `start` than demanded only so much is demanded as it has there; of the workspace, too.
  void relieve(const Vector3& start);
  /// So much more than demanded is kept from now on [m]; not from what was relieved.
  void setComfort(double comfort) {
    comfort_ = comfort;
    map_.setComfort(comfort);
  }

  std::size_t size() const { return entries_.size(); }
  const GuideBody& body(std::size_t i) const { return *entries_[i].body; }

  double clearance(const TimedPoint& x) const override;
  bool isClear(const TimedPoint& from, const TimedPoint& to) const override;
  /// The part of a flight that is too near to body `i`, if there is one.
  std::optional<LineShare> blockedBy(std::size_t i, const TimedPoint& from, const TimedPoint& to) const;
  const MapSpace& map() const { return map_; }
  bool isInWorkspace(const Vector3& p) const;
  /// The part of a line that lies in the workspace, if there is one.
  std::optional<LineShare> shareInWorkspace(const Vector3& a, const Vector3& b) const;

 private:
  struct Entry {
    const GuideBody* body = nullptr;
    double relief = 0.0;  ///< not demanded of its distance [m]
  };

  double demand(const Entry& entry, double t) const {
    return entry.body->distanceAt(t) + (entry.relief > 0.0 ? -entry.relief : comfort_);
  }
  bool mayTouch(const Entry& entry, const TimedPoint& from, const TimedPoint& to) const;
  ConvexPassage passage(const Entry& entry, const TimedPoint& from, const TimedPoint& to) const;

  std::vector<Entry> entries_;
  MapSpace map_;
  Workspace workspace_;
  double comfort_ = 0.0;
};

}  // namespace swarm_planner
