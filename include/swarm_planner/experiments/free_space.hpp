// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// Where the centre of a UAV may be: in a box, `radius` [m] or more from every obstacle's surface and from every
/// occupied voxel. Obstacles stand still.
class FreeSpace {
 public:
  /// `map` may be null.
  FreeSpace(std::vector<Superellipsoid> obstacles, double radius, const Workspace& box,
            std::shared_ptr<const VoxelMap> map = nullptr);

  const Workspace& box() const { return box_; }
  /// Distance by which a point is clear of obstacles and voxels [m]; negative: too close. Capped at 2 m and the size of
  /// the box does not count.
  double clearance(const Vector3& p) const;
  /// In the box and clear of obstacles and voxels, but for rounding.
  bool isFree(const Vector3& p) const;
  /// Every point of the segment is. Steps as far as the clearance allows, and no less than a fiftieth of `radius`.
  bool isFree(const Vector3& a, const Vector3& b) const;

 private:
  std::vector<Superellipsoid> obstacles_;
  std::shared_ptr<const VoxelMap> map_;
  double radius_;
  Workspace box_;
};

/// Length of a polyline [m].
double lengthOf(const std::vector<Vector3>& path);

/// A path in `space` with the same ends, shorter by all that can be had without a jump over an obstacle. `step` [m]:
/// how far corners are moved at first.
std::vector<Vector3> tightened(const FreeSpace& space, std::vector<Vector3> path, double step);

}  // namespace swarm_planner
