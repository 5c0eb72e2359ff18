// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Watches the distances between UAVs: the least centre distance of a run, and when a pair is inside the pair
/// ellipsoid (d_xy / horizontal)^2 + (d_z / vertical)^2 < 1, eq. (14).
///
/// Exact, yet cheap for thousands: only pairs nearer than the least distance so far or than the ellipsoid's longer
/// axis can change the answer. A list of the pairs within that reach plus a skin is kept until a UAV has moved by half
/// the skin, and is then rebuilt from a grid of cells.
class PairWatch {
 public:
  using Pair = std::pair<std::size_t, std::size_t>;  ///< first < second

  /// `horizontal`, `vertical`: semi-axes of the pair ellipsoid [m], > 0.
  PairWatch(double horizontal, double vertical);

  /// Looks at one instant; the number of UAVs must not change between calls. Returns the pairs that are inside the
  /// ellipsoid now and were not at the instant before.
  const std::vector<Pair>& observe(const std::vector<Vector3>& positions);

  /// Least centre distance so far [m]; empty with fewer than two UAVs.
  std::optional<double> minDistance() const;

 private:
  struct Cell {
    long long x, y, z;
    std::size_t uav;
  };

  void measureAllPairs(const std::vector<Vector3>& positions);
  bool movedTooFar(const std::vector<Vector3>& positions) const;
  void rebuild(const std::vector<Vector3>& positions);
  void addNeighbours(const Cell& cell, const std::vector<Vector3>& positions, double reach);
  void look(const Pair& pair, const std::vector<Vector3>& positions);

  double horizontal_;
  double vertical_;
  double min_squared_;
  double skin_ = 0.0;
  std::vector<Vector3> built_at_;  ///< positions at the last rebuild
  std::vector<Cell> cells_;        ///< sorted by cell
  std::vector<Pair> near_;         ///< sorted
  std::vector<Pair> inside_;       ///< sorted
  std::vector<Pair> inside_now_;
  std::vector<Pair> entered_;
};

}  // namespace swarm_planner
