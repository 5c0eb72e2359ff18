// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/nearest_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {
namespace {

constexpr double kSoon = 6.0;  // the paper's horizon [s]

}  // namespace

NearestTracks::NearestTracks(std::size_t places, std::size_t tracks) {
  places_.reserve(places);
  ranks_.reserve(tracks);
  stays_.reserve(tracks);
}

std::size_t NearestTracks::keep(std::size_t most, const std::vector<Vector3>& places,
                                std::vector<TrackedObstacle>& tracks) {
  if (tracks.size() <= most) return 0;
  places_.assign(places.begin(), places.end());
  std::sort(places_.begin(), places_.end(), [](const Vector3& a, const Vector3& b) { return a.x() < b.x(); });
  ranks_.clear();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Superellipsoid& shape = tracks[i].shape;
    const double reach = shape.boundingRadius() + kSoon * shape.velocity().norm();
    ranks_.emplace_back(nearestPlace(shape.center()) - reach, i);
  }
  const auto last = ranks_.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(ranks_.begin(), last, ranks_.end());
  stays_.assign(tracks.size(), false);
  for (auto rank = ranks_.begin(); rank != last; ++rank) stays_[rank->second] = true;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (stays_[i]) tracks[kept++] = tracks[i];
  }
  const std::size_t gone = tracks.size() - kept;
  tracks.resize(kept);
  return gone;
}

double NearestTracks::nearestPlace(const Vector3& center) const {
  if (places_.empty()) return 0.0;
  double squared = std::numeric_limits<double>::infinity();
  const auto first = std::lower_bound(places_.begin(), places_.end(), center.x(),
                                      [](const Vector3& place, double x) { return place.x() < x; });
  const auto consider = [&squared, &center](const Vector3& place) {
    const double dx = place.x() - center.x();
    if (dx * dx >= squared) return false;
    squared = std::min(squared, (place - center).squaredNorm());
    return true;
  };
  for (auto right = first; right != places_.end() && consider(*right); ++right) continue;
  for (auto left = first; left != places_.begin() && consider(*(left - 1)); --left) continue;
  return std::sqrt(squared);
}

}  // namespace swarm_planner
