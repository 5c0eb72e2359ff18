// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/place_history.hpp"

#include <algorithm>

namespace swarm_planner {

void PlaceHistory::add(double stamp, const Vector3& p, const Vector3& v) {
  if (count_ > 0 && stamp <= place(0).stamp) return;
  const bool replaces_newest = count_ > 1 && stamp - place(1).stamp < kSpacing;
  if (!replaces_newest) {
    newest_ = (newest_ + 1) % kMost;
    count_ = std::min(count_ + 1, kMost);
  }
  places_[newest_] = {stamp, p};
  v_ = v;
}

std::optional<Vector3> PlaceHistory::at(double t) const {
  if (count_ == 0) return std::nullopt;
  const Place& newest = place(0);
  if (t >= newest.stamp) return newest.p + std::min(t - newest.stamp, kMostAhead) * v_;
  std::size_t age = 1;
  while (age < count_ && place(age).stamp > t) ++age;
  if (age == count_) return place(count_ - 1).p;
  const Place& before = place(age);
  const Place& after = place(age - 1);
  return before.p + (t - before.stamp) / (after.stamp - before.stamp) * (after.p - before.p);
}

}  // namespace swarm_planner
