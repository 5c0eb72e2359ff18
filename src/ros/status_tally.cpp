// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/status_tally.hpp"

#include <algorithm>

#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

Concern concernOf(const UavStatus& uav) {
  if (uav.alarm || uav.state == UavStatus::LOST) return Concern::kAlarm;
  if (uav.state == UavStatus::FALLBACK || !(uav.reason.empty() || uav.commanded)) return Concern::kCaution;
  return Concern::kNone;
}

void StatusTally::add(const PlannerStatus& status) {
  ++cycles_;
  deadline_misses_ += status.deadline_missed ? 1 : 0;
  out_of_time_ += status.out_of_time ? 1 : 0;
  refused_tracks_ = std::max<std::size_t>(refused_tracks_, status.refused_tracks);
  time_sum_ += status.cycle_time;
  time_max_ = std::max(time_max_, status.cycle_time);
  for (const UavStatus& uav : status.uavs) rejected_plans_ += uav.refusal.empty() ? 0 : 1;
  if (worst_.size() != status.uavs.size()) worst_ = status.uavs;
  for (std::size_t uav = 0; uav < worst_.size(); ++uav) {
    if (concernOf(status.uavs[uav]) >= concernOf(worst_[uav])) worst_[uav] = status.uavs[uav];
  }
}

void StatusTally::clear() { *this = StatusTally(); }

double StatusTally::meanCycleTime() const { return cycles_ > 0 ? time_sum_ / static_cast<double>(cycles_) : 0.0; }

}  // namespace swarm_planner
