// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

#include "swarm_planner/obstacles/nearest_tracks.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"

namespace swarm_planner {

/// The newest track of every obstacle. One that is reported no more is remembered until its track is too old: a tracker
/// that loses an obstacle for a moment has not moved it away.
class TrackMemory {
 public:
  /// A track is forgotten once it is older than `timeout` [s]. Up to `capacity` tracks at a time and in memory, and so
  /// many `places`, before memory has to grow.
  TrackMemory(double timeout, std::size_t capacity, std::size_t places = 0);

  /// Takes what is reported at `now` [s], which need not be every obstacle, and forgets what is too old by then. For
  /// each id the track with the latest stamp stays, the first that came if stamps are equal. A track is refused, and
  /// the older one of its id stays, if a number of it is not finite or beyond those of plausible.hpp, a standard
  /// deviation is negative or its stamp is more than kClockTolerance after `now`.
  void update(const std::vector<TrackedObstacle>& tracks, double now);
  /// Forgets all but the `capacity` tracks nearest to any of `places` (see NearestTracks). Returns how many went:
  /// trackers that invent ids do not fill the memory.
  std::size_t keepNearest(const std::vector<Vector3>& places);
  /// Forgets what is too old at `now` [s].
  void forget(double now);
  /// Forgets everything: time has jumped back.
  void reset() { tracks_.clear(); }

  /// By ascending id, one each.
  const std::vector<TrackedObstacle>& tracks() const { return tracks_; }
  /// How many tracks the last update refused.
  std::size_t refused() const { return refused_; }

 private:
  double timeout_;
  std::size_t capacity_;
  std::vector<TrackedObstacle> tracks_;
  std::vector<TrackedObstacle> merged_;             ///< tracks_ in the making
  std::vector<const TrackedObstacle*> candidates_;  ///< of one update, by id
  std::size_t refused_ = 0;
  NearestTracks nearest_;
};

}  // namespace swarm_planner
