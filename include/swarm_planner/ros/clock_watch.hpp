// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace swarm_planner {

/// Finds out, in wall time, that ROS time never comes or stands still: then there are no cycles, and nothing that waits
/// for ROS time would tell of it. Or that it jumps back again and again, as it does where two nodes publish /clock.
class ClockWatch {
 public:
  /// Longer than that /clock may take from one message to the next [s] of wall time.
  static constexpr double kPatience = 1.0;
  /// So many jumps back, with less than kCalm between them, are no accident.
  static constexpr int kMostJumps = 3;
  static constexpr double kCalm = 5.0;  ///< [s] of wall time

  /// `now`: ROS time, zero if it has not come yet; `wall`: a clock that never stands still [s].
  void note(double now, double wall);
  /// ROS time has jumped back. False if it does so again and again, which fault() tells from the next note() on.
  bool noteJumpBack(double wall);
  /// What is amiss, in words; empty if nothing is.
  const std::string& fault() const { return fault_; }

 private:
  double now_ = -1.0;
  double since_ = 0.0;      ///< wall time at which `now_` was first seen [s]
  int jumps_ = 0;           ///< back, with less than kCalm between them
  double last_jump_ = 0.0;  ///< wall time [s]
  std::string fault_;
};

}  // namespace swarm_planner
