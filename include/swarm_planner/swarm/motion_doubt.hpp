// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>

namespace swarm_planner {

/// How far a UAV that is not seen any more may be from the motion that it was to fly: rate (t - since), at most
/// `limit`, and nothing before `since`. Never less at a later time.
struct MotionDoubt {
  double since = 0.0;  ///< when it was seen last [s]
  double rate = 0.0;   ///< >= 0 [m/s]
  double limit = 0.0;  ///< >= 0 [m]

  bool isNone() const { return !(limit > 0.0); }
  /// At absolute time `t` [s]; in metres.
  double at(double t) const { return std::clamp(rate * (t - since), 0.0, limit); }
  /// No less than this one and `other` together at any time.
  MotionDoubt with(const MotionDoubt& other) const {
    if (isNone()) return other;
    if (other.isNone()) return *this;
    return {std::min(since, other.since), rate + other.rate, limit + other.limit};
  }
  /// `share` of it at every time.
  MotionDoubt times(double share) const { return {since, share * rate, share * limit}; }
};

}  // namespace swarm_planner
