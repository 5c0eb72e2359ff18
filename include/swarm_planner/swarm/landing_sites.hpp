// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"

namespace swarm_planner {

/// Where UAVs land: each in a column of its own, straight down from where it came to rest or, where that is taken or
/// blocked, the nearest free one on rings around it. A column is taken within pair_distance + pair_margin of another
/// one's or of a UAV that stands, however high; it is blocked where an obstacle comes closer to it than the planner
/// keeps within the time that the check looks ahead, by what is mapped above a floor at its foot, or outside of the
/// workspace. The same input gives the same sites.
/// Takes no heap unless more than `uav_count` columns are taken.
class LandingSites {
 public:
  LandingSites(const Parameters& parameters, const std::optional<Workspace>& workspace, std::size_t uav_count);

  /// A new cycle. `obstacles`, and what is mapped, have to outlive it; `epoch` [s] is when they are looked at first.
  void begin(const std::vector<TrackedObstacle>& obstacles, double epoch, const VoxelMap* map = nullptr);
  /// The column through `place` is taken by `uav`.
  void take(std::size_t uav, const Vector3& place) { taken_.push_back({uav, place}); }

  /// The site of `uav`, which is at rest at `place`: at the height `ground` [m]. Nothing if no column within reach is
  /// free. It is not taken by this.
  std::optional<Vector3> find(std::size_t uav, const Vector3& place, double ground) const;
  /// Whether `site` can be kept by `uav`, which is at the height `top` [m]: nothing stands closer to its column than
  /// the pair distance alone, and no obstacle blocks it.
  bool canKeep(std::size_t uav, const Vector3& site, double top) const;
  /// How many distances were looked at since begin().
  std::size_t effort() const { return effort_; }

 private:
  struct Column {
    std::size_t uav;
    Vector3 place;  ///< [m]
  };

  /// Whether the column of `x`, `y` from `bottom` to `top` is free; `apart` [m] from those that are taken.
  bool isFree(std::size_t uav, const Vector3& bottom, double top, double apart) const;
  bool isInside(const Vector3& site) const;
  /// Whether something mapped is too near to the column, but for what it ends above.
  bool isMapped(const Vector3& bottom, double top) const;
  bool isBlockedBy(const TrackedObstacle& obstacle, const Vector3& bottom, double top) const;

  const Parameters& parameters_;
  Workspace bounds_;  ///< with the margin
  double spacing_;    ///< of new columns [m]
  const std::vector<TrackedObstacle>* obstacles_ = nullptr;
  const VoxelMap* map_ = nullptr;
  double epoch_ = 0.0;
  std::vector<Column> taken_;
  mutable std::size_t effort_ = 0;
};

}  // namespace swarm_planner
