// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "swarm_planner/obstacles/obstacle_track.hpp"

namespace swarm_planner {

/// Picks the tracks that matter most where there are more than can be used: those that can come nearest to any of some
/// places soon.
class NearestTracks {
 public:
  /// Sets memory aside for so many places and tracks; more take it from the heap.
  NearestTracks(std::size_t places, std::size_t tracks);

  /// Leaves `most` of `tracks`, in the order that they had, and returns how many went. The rank of a track is the least
  /// over all places of |centre - place| - bounding radius - speed * 6 s; of equal ones the first stay, as they do
  /// without any place. Work: tracks times a strip of places.
  std::size_t keep(std::size_t most, const std::vector<Vector3>& places, std::vector<TrackedObstacle>& tracks);

 private:
  double nearestPlace(const Vector3& center) const;

  std::vector<Vector3> places_;                        ///< by x
  std::vector<std::pair<double, std::size_t>> ranks_;  ///< of each track, with its index
  std::vector<bool> stays_;
};

}  // namespace swarm_planner
