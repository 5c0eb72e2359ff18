// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>

#include "swarm_planner/guide/convex_passage.hpp"
#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// The free space of a map, as guides ask for it: by distances from the voxels themselves.
class MapSpace {
 public:
  /// `distance` is to be kept from the occupied voxels [m]. Null: everything is free.
  void set(const VoxelMap* map, double distance);
  /// Where a flight begins nearer than demanded only so much is demanded as it has there, and more with the way from
  /// there.
  void relieve(const Vector3& start);
  /// So much more than demanded is kept from now on [m].
  void setComfort(double comfort) { comfort_ = comfort; }

  /// By how much a point is farther from everything than is demanded [m]; not more than 0 is told apart. Negative if
  /// and only if it is too near.
  double clearance(const Vector3& p) const;
  /// Whether a straight line is clear all the way; what is blocked for less than a millimetre counts as clear.
  bool isClear(const Vector3& from, const Vector3& to) const;
  /// The first part of a line after `share` of it that is too near, if there is one, to within a quarter of a voxel.
  std::optional<LineShare> firstBlocked(const Vector3& from, const Vector3& to, double share) const;

 private:
  double demandAt(const Vector3& p) const;
  /// Whether nothing is in the box that holds all that is demanded of a line: many are told clear by that, and it takes
  /// a tenth of a distance.
  bool hasEmptyBox(const Vector3& from, const Vector3& to) const;

  const VoxelMap* map_ = nullptr;
  double distance_ = 0.0;
  double comfort_ = 0.0;
  Vector3 start_ = Vector3::Zero();
  double has_ = 0.0;  ///< distance at the start, where it is less than demanded [m]
  bool is_relieved_ = false;
};

}  // namespace swarm_planner
