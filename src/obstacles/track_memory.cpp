// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/track_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swarm_planner {
namespace {

/// False for NaN too.
bool isSigma(double sigma) { return sigma >= 0.0 && std::isfinite(sigma); }

bool isUsable(const TrackedObstacle& track, double now) {
  const Superellipsoid& shape = track.shape;
  return std::isfinite(track.stamp) && track.stamp <= now + kClockTolerance && shape.center().allFinite() &&
         shape.velocity().allFinite() && shape.radii().allFinite() && shape.exponents().allFinite() &&
         std::isfinite(shape.yaw()) && isSigma(track.position_sigma) && isSigma(track.velocity_sigma);
}

}  // namespace

TrackMemory::TrackMemory(double timeout, std::size_t capacity) : timeout_(timeout) {
  tracks_.reserve(capacity);
  merged_.reserve(capacity);
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

void TrackMemory::forget(double now) {
  const auto is_old = [this, now](const TrackedObstacle& track) { return now - track.stamp > timeout_; };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is_old), tracks_.end());
}

}  // namespace swarm_planner
