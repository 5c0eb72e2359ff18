// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/swarm/way.hpp"

namespace swarm_planner {

/// A way to a place aside: from where a UAV is, over one point at most.
struct WayAside {
  std::array<Vector3, 3> points;
  std::size_t count = 0;
};

/// Looks for a place where a UAV can let others pass: off their ways, clear of obstacles and of UAVs that stand, and
/// such that a straight line leads there, or a retreat along the other's way and a step aside. The same input gives
/// the same place. Takes no heap within a cycle.
class Wayside {
 public:
  /// What has to be known of who gives way.
  struct Request {
    Vector3 from = Vector3::Zero();    ///< where it is [m]
    Vector3 wanted = Vector3::Zero();  ///< where it would go: of places as near the nearest to this is taken [m]
    const Way* way = nullptr;          ///< of whom it lets pass
    const Way* second = nullptr;       ///< another one to stay off, or null
  };

  Wayside(const Parameters& parameters, const std::optional<Workspace>& workspace, std::size_t uav_count,
          std::size_t max_obstacles);

  /// Obstacles at `epoch` [s], and what is mapped, or null; they have to outlive the cycle.
  void begin(const std::vector<TrackedObstacle>& obstacles, double epoch, const VoxelMap* map = nullptr);
  /// Other UAVs to keep clear of: their places [m]. One that `may_be_asked` to move is in the way only where there is
  /// another place.
  void forgetOthers() { others_.clear(); }
  void addOther(const Vector3& place, bool may_be_asked) { others_.push_back({place, may_be_asked}); }
  std::optional<WayAside> find(const Request& request);

  const PairSpacing& spacing() const { return spacing_; }

 private:
  struct Other {
    Vector3 place;
    bool may_be_asked;
  };

  void gatherObstacles(const Vector3& from);
  std::optional<WayAside> findStraight(const Request& request, bool strict) const;
  std::optional<WayAside> findBack(const Request& request, bool strict) const;
  /// Whether a UAV that comes from request.from may stay at `q`.
  bool isPlace(const Request& request, const Vector3& q, bool strict) const;
  /// Whether the line leads past obstacles and others.
  bool isPassable(const Vector3& from, const Vector3& to, const Vector3& start, bool strict) const;
  bool isClearOfObstacles(const Vector3& q, bool for_long) const;

  const Parameters& parameters_;
  PairSpacing spacing_;
  Workspace bounds_;  ///< with the margin [m]
  const std::vector<TrackedObstacle>* obstacles_ = nullptr;
  const VoxelMap* map_ = nullptr;
  double epoch_ = 0.0;
  std::vector<const TrackedObstacle*> near_;  ///< within reach of the search
  std::vector<Other> others_;
};

}  // namespace swarm_planner
