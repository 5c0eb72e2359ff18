// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swarm_planner/PlannerStatus.h"

namespace swarm_planner {

/// How much of the operator's attention a UAV needs.
enum class Concern : std::uint8_t {
  kNone,
  kCaution,  ///< something is not as it should be; see the reason
  kAlarm,    ///< look at once: lost, or safety cannot be assured any more
};
Concern concernOf(const UavStatus& uav);

/// What happened in the cycles between two reports to the operator: an alarm of one cycle must not pass unseen.
class StatusTally {
 public:
  void add(const PlannerStatus& status);
  /// A new period begins.
  void clear();

  std::size_t cycles() const { return cycles_; }
  std::size_t deadlineMisses() const { return deadline_misses_; }
  std::size_t outOfTime() const { return out_of_time_; }         ///< cycles in which time did not suffice for all UAVs
  std::size_t rejectedPlans() const { return rejected_plans_; }  ///< that the check refused
  std::size_t refusedTracks() const { return refused_tracks_; }  ///< the most in one cycle
  double meanCycleTime() const;                                  ///< [s], 0 without a cycle
  double maxCycleTime() const { return time_max_; }              ///< [s]
  /// The newest of the most alarming states of each UAV, in the scenario's order; empty without a cycle.
  const std::vector<UavStatus>& worst() const { return worst_; }

 private:
  std::size_t cycles_ = 0;
  std::size_t deadline_misses_ = 0;
  std::size_t out_of_time_ = 0;
  std::size_t rejected_plans_ = 0;
  std::size_t refused_tracks_ = 0;
  double time_sum_ = 0.0;
  double time_max_ = 0.0;
  std::vector<UavStatus> worst_;
};

}  // namespace swarm_planner
