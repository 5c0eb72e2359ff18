// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/problem/free_polyhedron.hpp"
#include "swarm_planner/swarm/committed_motion.hpp"

namespace swarm_planner {

/// The edges of a polyhedron, within its window: pairs of points [m]. None if it is empty.
std::vector<Vector3> edgesOf(const FreePolyhedron& polyhedron);

/// What the planner makes of a map about a plan, drawn: the edges of the convex free spaces about some of its pieces,
/// which reach `band` [m] beyond them. Pieces that meet a voxel have none.
class CorridorDrawing {
 public:
  std::vector<Vector3> edges(const VoxelMap& map, const CommittedMotion& plan, double band);

 private:
  PolyhedronSearch search_;
  FreePolyhedron polyhedron_;
};

}  // namespace swarm_planner
