// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/track_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "swarm_planner/config/plausible.hpp"

namespace swarm_planner {
namespace {

bool isUsable(const TrackedObstacle& track, double now) {
  const Superellipsoid& shape = track.shape;
  return std::isfinite(track.stamp) && track.stamp <= now + kClockTolerance &&
         isWithin(shape.center(), kMostCoordinate) && isWithin(shape.velocity(), kMostSpeed) &&
         isPlausibleShape(shape.radii(), shape.exponents()) && std::isfinite(shape.yaw()) &&
         isPlausibleSigma(track.position_sigma) && isPlausibleSigma(track.velocity_sigma);
}

}  // namespace

TrackMemory::TrackMemory(double timeout, std::size_t capacity, std::size_t places)
    : timeout_(timeout), capacity_(capacity), nearest_(places, 2 * capacity) {
  // Until the farthest have gone there are those known and those reported.
  tracks_.reserve(2 * capacity);
  merged_.reserve(2 * capacity);
  candidates_.reserve(capacity);
}

void TrackMemory::update(const std::vector<TrackedObstacle>& tracks, double now) {
  candidates_.clear();
  for (const TrackedObstacle& track : tracks) {
    if (isUsable(track, now)) candidates_.push_back(&track);
  }
  refused_ = tracks.size() - candidates_.size();
  // Those of one id stay in the order in which they came. std::stable_sort would take memory from the heap.
  std::sort(candidates_.begin(), candidates_.end(), [](const TrackedObstacle* a, const TrackedObstacle* b) {
    return a->shape.id() != b->shape.id() ? a->shape.id() < b->shape.id() : a < b;
  });

  merged_.clear();
  const auto take = [this](const TrackedObstacle& track) {
    if (merged_.empty() || merged_.back().shape.id() != track.shape.id()) {
      merged_.push_back(track);
    } else if (track.stamp > merged_.back().stamp) {
      merged_.back() = track;
    }
  };
  auto known = tracks_.cbegin();
  for (const TrackedObstacle* candidate : candidates_) {
    for (; known != tracks_.cend() && known->shape.id() <= candidate->shape.id(); ++known) take(*known);
    take(*candidate);
  }
  for (; known != tracks_.cend(); ++known) take(*known);
  std::swap(tracks_, merged_);
  forget(now);
}

std::size_t TrackMemory::keepNearest(const std::vector<Vector3>& places) {
  return nearest_.keep(capacity_, places, tracks_);
}

void TrackMemory::forget(double now) {
  const auto is_old = [this, now](const TrackedObstacle& track) { return now - track.stamp > timeout_; };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is_old), tracks_.end());
}

}  // namespace swarm_planner
