// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "swarm_planner/experiments/free_space.hpp"

namespace swarm_planner {

/// Shortest paths in a free space, for measuring others by. A search on a grid with parents in any direction (Lazy
/// Theta*: Nash, Koenig and Tovey, AAAI 2010) finds which way round; the path found is then drawn tight against the
/// obstacles. Slow and careful: seconds for a field of some ten thousand m^3.
class ShortestPath {
 public:
  /// `space` must outlive this. The grid's cells are `cell` [m] wide and twice as high: gaps in which a UAV has less
  /// room than that are missed.
  ShortestPath(const FreeSpace& space, double cell);
  ~ShortestPath();

  /// Corners of a path from `start` to `goal` [m], both included; empty if no way was found.
  std::vector<Vector3> find(const Vector3& start, const Vector3& goal);

 private:
  class Grid;
  const FreeSpace& space_;
  double cell_;
  std::unique_ptr<Grid> grid_;
};

}  // namespace swarm_planner
