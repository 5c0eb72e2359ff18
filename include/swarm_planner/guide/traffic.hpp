// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swarm_planner/guide/free_space.hpp"
#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {

/// What a UAV is about to fly, coarsely: where it will be at the ends of every other stage, from the search's time
/// zero.
struct PlannedFlight {
  static constexpr std::size_t kPoints = kHorizon / 2 + 1;

  std::array<Vector3, kPoints> points;  ///< [m]
  Box box;                              ///< of all points

  /// Where it will be at time `t` [s]; `spacing` [s] between two points.
  Vector3 at(double t, double spacing) const;
};

/// What it costs to fly where other UAVs will be at the same time: their plans may change, so that they are no
/// obstacles, but who has the choice goes round the other side.
class Traffic {
 public:
  /// Room for `capacity` flights before others are left out. `horizontal`, `vertical`: semi-axes of the ellipsoid about
  /// another UAV [m].
  Traffic(double horizontal, double vertical, std::size_t capacity);

  /// `spacing`: of the points of the flights to come [s].
  void clear(double spacing) {
    flights_.clear();
    spacing_ = spacing;
  }
  /// The flight must outlive its use here.
  void add(const PlannedFlight& flight);
  /// By how many metres longer a straight and steady flight counts.
  double cost(const TimedPoint& from, const TimedPoint& to) const;

 private:
  double horizontal_;
  double vertical_;
  double spacing_ = 1.0;
  std::vector<const PlannedFlight*> flights_;
};

}  // namespace swarm_planner
