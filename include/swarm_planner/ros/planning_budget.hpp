// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>

namespace swarm_planner {

/// How long a cycle may plan, so that its plans are out before their epoch.
///
/// The epoch is in ROS time, planning takes wall time. Where a simulator makes ROS time, nobody knows how fast that
/// will run until the epoch: the pace since the cycle before is what can be had. A pace below 1, as after a pause,
/// counts as 1: a cycle never gets more than real vehicles would leave it, and none that follows a pause gets the
/// pause's length.
class PlanningBudget {
 public:
  /// `share`: of the time until the epoch, in (0, 1]; the rest is for the plan in work when it ends, and for sending.
  explicit PlanningBudget(double share) : share_(share) {}

  /// Under simulated time, when a cycle begins: at `now` [s] of ROS time and `wall` [s] of a steady clock.
  void noteCycle(double now, double wall);
  /// Seconds of wall clock for plans that are due in `left` seconds of ROS time; 0 if they are late already.
  double forPlansDueIn(double left) const;

 private:
  struct Instant {
    double now;
    double wall;
  };

  const double share_;
  std::optional<Instant> last_;
  double pace_ = 1.0;  ///< ROS time per wall time, at least 1
};

}  // namespace swarm_planner
