// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// Where a UAV was measured in the last seconds. Fixed memory.
class PlaceHistory {
 public:
  /// `stamp` [s], `p` [m], `v` [m/s]. Stamps are to ascend; one that is not newer is left out.
  void add(double stamp, const Vector3& p, const Vector3& v);
  void clear() { count_ = 0; }

  /// Where it was at a time [s]: between two measurements along the line between them, before the first one there, and
  /// after the last one as fast as it was then, for kMostAhead at most. Nothing without measurements.
  std::optional<Vector3> at(double t) const;

  static constexpr double kMostAhead = 0.5;  // [s]

 private:
  struct Place {
    double stamp = 0.0;
    Vector3 p = Vector3::Zero();
  };
  static constexpr std::size_t kMost = 64;
  /// From one to the next but one at least [s], so that 2.5 s are known; else the one between is left out.
  static constexpr double kSpacing = 0.08;

  const Place& place(std::size_t age) const { return places_[(newest_ + kMost - age) % kMost]; }

  std::array<Place, kMost> places_;
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
  Vector3 v_ = Vector3::Zero();  ///< of the newest
};

}  // namespace swarm_planner
