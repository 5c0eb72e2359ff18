// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstdint>

#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/swarm/flight_mode.hpp"

namespace swarm_planner {

struct UavReport;

/// How far a landing is.
enum class LandingPhase : std::uint8_t {
  kBraking,    ///< comes to rest; it has no site yet
  kApproach,   ///< goes to above its site, at its height
  kDescending  ///< straight down
};

/// What a UAV flies while it does not fly its mission: where it holds or lands. Kept from cycle to cycle.
struct FlightTask {
  FlightMode mode = FlightMode::kWaiting;
  bool placed = false;              ///< `place` and `target` hold: they are found in the first cycle of a mode
  bool at_rest = false;             ///< it has braked: `place` stays
  Vector3 place = Vector3::Zero();  ///< where it holds, or came to rest before it lands [m]
  bool is_quickest_stop = false;    ///< the newest motion is that: it flies on while it is safe
  double quiet_since = 0.0;         ///< it has hardly moved since [s]
  LandingPhase phase = LandingPhase::kBraking;
  Vector3 site = Vector3::Zero();  ///< of its landing, on the ground; holds after kBraking [m]
  bool has_no_site = false;        ///< none was free
  double next_search = 0.0;        ///< for a site [s]
  /// May be below the workspace, down to `floor` [m]: it lands, has landed, or has not yet climbed into it.
  bool below_workspace = false;
  double floor = 0.0;

  // Instead of the mission's reference; room for two points, so that new ones take no heap.
  MovingTarget target;
  bool on_target_path = false;  ///< target_progress holds
  double target_progress = 0.0;

  FlightTask() { target.path = ReferencePath({Vector3::Zero(), Vector3::UnitX()}); }

  /// The next cycle finds out anew what to fly.
  void enter(FlightMode next) {
    mode = next;
    placed = false;
    at_rest = false;
    has_no_site = false;
    is_quickest_stop = false;
    phase = LandingPhase::kBraking;
  }
  /// The least height of what is flown, where the workspace's is `least`; `margin` [m] below the ground is let pass.
  double workspaceFloor(double least, double margin) const {
    return below_workspace ? std::min(least, floor - margin) : least;
  }
  /// A target that moves from `begin` at time `t` [s] to `end` with `speed` [m/s].
  void follow(const Vector3& begin, const Vector3& end, double speed, double t) {
    target.path.assignLine(begin, end);
    target.start = 0.0;
    target.speed = speed;
    target.time_zero = t;
    on_target_path = false;
  }
  /// The target sets out anew at `t` [s] beside the UAV, at `p`: it does not run ahead of one that is held up.
  void leadFrom(const Vector3& p, double t) {
    target.start = target.path.nearest(p, target.start).arc_length;
    target.time_zero = t;
  }
};

/// The state that goes with the mode and, where nothing is amiss, the mode as the reason.
void reportTask(const FlightTask& task, UavReport& report);

}  // namespace swarm_planner
