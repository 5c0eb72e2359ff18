// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/swarm/clearance_proof.hpp"
#include "swarm_planner/swarm/committed_motion.hpp"

namespace swarm_planner {

/// Proves that motions keep a distance from the occupied voxels of a map, by the voxels themselves and by nothing that
/// plans are made with:
///  - the distance to a set changes by 1 m per metre at most: that at a point of the curve, minus the radius about it
///    that holds the control points;
///  - no voxel in a box round the control points that is larger by the distance.
/// What neither decides is halved, up to a depth and a number of pieces; the rest is not clear.
class MapProof {
 public:
  /// The distance is `least` [m], less kDistanceTolerance; where `committed` has less, what that has. Where it is
  /// within an occupied voxel, those closer to it than `least` count for nothing, so that there is a way out. The map
  /// must outlive this.
  MapProof(const VoxelMap& map, double least, const Vector3& committed);

  /// The whole motion, its rest included. Times are in seconds after its epoch.
  ClearanceFinding prove(const CommittedMotion& motion);

 private:
  ClearanceFinding prove(const BernsteinPoints<4>& points, double from, double to, int depth);
  /// To the nearest voxel that counts [m], or `limit`.
  double distance(const Vector3& p, double limit) const;
  /// Whether none that counts lies in the box.
  bool isEmpty(const Box& box) const;
  bool counts(const VoxelIndex& voxel) const;

  const VoxelMap& map_;
  double demanded_;
  bool is_inside_ = false;  ///< `committed` is within an occupied voxel
  Vector3 committed_;
  double exempt_ = 0.0;  ///< radius about `committed` in which voxels do not count then [m]
  int nodes_ = 0;
};

}  // namespace swarm_planner
