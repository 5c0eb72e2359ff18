// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planner_diagnostics.hpp"

#include <algorithm>
#include <numeric>

#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {
namespace {

using diagnostic_msgs::DiagnosticStatus;

unsigned char levelOf(const UavStatus& uav) {
  if (uav.state == UavStatus::LOST) return DiagnosticStatus::ERROR;
  if (uav.state == UavStatus::FALLBACK || !uav.reason.empty()) return DiagnosticStatus::WARN;
  return DiagnosticStatus::OK;
}

}  // namespace

PlannerDiagnostics::PlannerDiagnostics(const std::vector<std::string>& uav_names, double cycle_period,
                                       double track_timeout)
    : cycle_period_(cycle_period),
      track_timeout_(track_timeout),
      uavs_(uav_names.size()),
      last_uavs_(uav_names.size()) {
  updater_.setHardwareID("swarm_planner");
  updater_.add("planning cycle", this, &PlannerDiagnostics::describeCycle);
  updater_.add("obstacle tracks", this, &PlannerDiagnostics::describeTracks);
  for (std::size_t uav = 0; uav < uav_names.size(); ++uav) {
    updater_.add(uav_names[uav], [this, uav](Status& status) { describeUav(uav, status); });
  }
}

void PlannerDiagnostics::addCycle(const PlannerStatus& status) {
  planner_status_ = status;
  ++cycles_;
  misses_ += status.deadline_missed ? 1 : 0;
  time_sum_ += status.cycle_time;
  time_max_ = std::max(time_max_, status.cycle_time);
}

void PlannerDiagnostics::publish(const std::vector<UavInput>& uavs, const TrackInput& tracks, double now) {
  uavs_ = uavs;
  tracks_ = tracks;
  now_ = now;
  updater_.force_update();
  last_uavs_ = uavs_;
  last_tracks_ = tracks_;
  last_time_ = now;
  cycles_ = 0;
  misses_ = 0;
  time_sum_ = 0.0;
  time_max_ = 0.0;
}

void PlannerDiagnostics::restart() { last_time_ = 0.0; }

double PlannerDiagnostics::rate(std::uint64_t count, std::uint64_t last_count) const {
  const bool measurable = last_time_ > 0.0 && now_ > last_time_;
  return measurable ? static_cast<double>(count - last_count) / (now_ - last_time_) : 0.0;
}

void PlannerDiagnostics::describeCycle(Status& status) {
  if (cycles_ == 0) {
    status.summary(DiagnosticStatus::ERROR, "no planning cycle since the last report");
  } else if (misses_ > 0) {
    status.summaryf(DiagnosticStatus::WARN, "%u of %lu cycles missed their deadline", misses_,
                    static_cast<unsigned long>(cycles_));
  } else {
    status.summary(DiagnosticStatus::OK, planner_status_.started ? "planning" : "waiting");
  }
  status.addf("cycle time, mean [ms]", "%.2f", cycles_ > 0 ? 1e3 * time_sum_ / static_cast<double>(cycles_) : 0.0);
  status.addf("cycle time, max [ms]", "%.2f", 1e3 * time_max_);
  status.addf("cycle period [ms]", "%.0f", 1e3 * cycle_period_);
  status.add("cycles", planner_status_.cycle);
  status.add("deadline misses", planner_status_.deadline_misses);
}

void PlannerDiagnostics::describeTracks(Status& status) {
  const double age = now_ - tracks_.stamp;
  if (tracks_.faults > last_tracks_.faults) {
    status.summary(DiagnosticStatus::WARN, tracks_.last_fault);
  } else if (!tracks_.received) {
    status.summary(DiagnosticStatus::OK, "no obstacles received");
  } else if (age > track_timeout_) {
    status.summary(DiagnosticStatus::WARN, "no new tracks: the known obstacles are forgotten");
  } else {
    status.summaryf(DiagnosticStatus::OK, "%zu obstacles", tracks_.known);
  }
  status.addf("rate [Hz]", "%.1f", rate(tracks_.messages, last_tracks_.messages));
  if (tracks_.received) status.addf("age [s]", "%.2f", age);
  status.add("tracks or messages dropped", tracks_.faults);
}

void PlannerDiagnostics::describeUav(std::size_t uav, Status& status) {
  const UavInput& input = uavs_[uav];
  if (uav < planner_status_.uavs.size()) {
    const UavStatus& state = planner_status_.uavs[uav];
    const std::string text = stateText(static_cast<UavState>(state.state));
    status.summary(levelOf(state), state.reason.empty() ? text : text + ": " + state.reason);
    status.addf("lag [m]", "%.1f", state.lag);
    status.addf("predicted clearance to obstacles [m]", "%.2f", state.obstacle_clearance);
    status.addf("predicted distance to UAVs [m]", "%.2f", state.uav_distance);
    status.addf("largest slack [m]", "%.3f", state.max_slack);
    status.addf("solve time [ms]", "%.2f", 1e3 * state.solve_time);
  } else {
    status.summary(DiagnosticStatus::WARN, "not planned for yet");
  }
  status.addf("odometry rate [Hz]", "%.1f", rate(input.accepted, last_uavs_[uav].accepted));
  if (input.received) status.addf("odometry age [s]", "%.2f", now_ - input.sample.stamp);
  status.add("odometry dropped", std::accumulate(input.dropped.begin(), input.dropped.end(), std::uint64_t{0}));
  for (std::size_t fault = 1; fault < kOdometryFaults; ++fault) {
    if (input.dropped[fault] == 0) continue;
    status.add(std::string("odometry dropped: ") + faultText(static_cast<OdometryFault>(fault)), input.dropped[fault]);
  }
}

}  // namespace swarm_planner
