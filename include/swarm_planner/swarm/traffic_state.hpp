// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>

#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {

/// What a UAV does because of another one.
enum class Courtesy : std::uint8_t {
  kNone,
  kGivesWay,  ///< has left the other's way and stays aside until it is past
  kWaits,     ///< the other stands in its way
  kParked     ///< stands beside its end, which the other occupies
};

/// What is kept of one UAV from cycle to cycle to settle who goes first (RightOfWay).
struct TrafficState {
  bool takes_part = false;  ///< flies its mission on a motion of its own
  /// On its way since [s]: the earlier, the higher its rank. The present while nothing is left to do for it.
  double since = 0.0;
  bool is_anchored = false;          ///< `anchor` holds
  Vector3 anchor = Vector3::Zero();  ///< it has hardly moved from here ...
  double anchored_since = 0.0;       ///< ... since [s]
  double jammed_until = 0.0;         ///< held up lately: it waits less long before it asks again [s]
  double blocked_at = -1e300;        ///< somebody stood in its way last [s]
  double insistence = 1.0;           ///< times the patience before it asks a UAV at its goal to move
  Courtesy courtesy = Courtesy::kNone;
  std::size_t partner = 0;  ///< the other one

  bool gives_way = false;       ///< all that follows holds
  std::size_t beneficiary = 0;  ///< for whom
  std::size_t senior = 0;       ///< whose rank counts: the beneficiary gives way in its turn, or is that one
  bool is_chained = false;      ///< the beneficiary gives way
  double asked_at = 0.0;        ///< [s]
  double passed_at = 0.0;       ///< arc length at which the beneficiary is past [m]
  MovingTarget aside;           ///< instead of the reference; room for three points, so that new ones take no heap
  bool on_aside_path = false;   ///< aside_progress holds
  double aside_progress = 0.0;  ///< [m]
  double next_search = 0.0;     ///< for a place, after one that was in vain [s]

  TrafficState() { aside.path = ReferencePath({Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY()}); }

  void leaveAside() {
    gives_way = false;
    is_anchored = false;
  }
  /// Neither held up nor giving way at `t` [s].
  void forget(double t) {
    leaveAside();
    takes_part = false;
    since = t;
    insistence = 1.0;
    courtesy = Courtesy::kNone;
  }
};

}  // namespace swarm_planner
