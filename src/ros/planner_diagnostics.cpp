// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planner_diagnostics.hpp"

#include "swarm_planner/ros/input_watch.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {
namespace {

using diagnostic_msgs::DiagnosticStatus;

unsigned char levelOf(const UavStatus& uav) {
  switch (concernOf(uav)) {
    case Concern::kNone:
      return DiagnosticStatus::OK;
    case Concern::kCaution:
      return DiagnosticStatus::WARN;
    case Concern::kAlarm:
      break;
  }
  return DiagnosticStatus::ERROR;
}

std::string textOf(const UavStatus& uav) {
  const std::string state = stateText(static_cast<UavState>(uav.state));
  return uav.reason.empty() ? state : state + ": " + uav.reason;
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
  updater_.add("transforms", this, &PlannerDiagnostics::describeTransforms);
  updater_.add("map", this, &PlannerDiagnostics::describeMap);
  for (std::size_t uav = 0; uav < uav_names.size(); ++uav) {
    updater_.add(uav_names[uav], [this, uav](Status& status) { describeUav(uav, status); });
  }
}

void PlannerDiagnostics::addCycle(const PlannerStatus& status) {
  planner_status_ = status;
  tally_.add(status);
}

void PlannerDiagnostics::publish(const std::vector<UavInput>& uavs, const TrackInput& tracks,
                                 const TransformInputReport& transforms, const MapInputReport& map, double now,
                                 const std::string& clock) {
  uavs_ = uavs;
  tracks_ = tracks;
  transforms_ = transforms;
  map_ = map;
  now_ = now;
  clock_ = clock;
  updater_.force_update();
  last_uavs_ = uavs_;
  last_tracks_ = tracks_;
  last_transforms_ = transforms_;
  last_map_ = map_;
  last_time_ = now;
  tally_.clear();
}

void PlannerDiagnostics::restart() { last_time_ = 0.0; }

double PlannerDiagnostics::rate(std::uint64_t count, std::uint64_t last_count) const {
  const bool measurable = last_time_ > 0.0 && now_ > last_time_;
  return measurable ? static_cast<double>(count - last_count) / (now_ - last_time_) : 0.0;
}

void PlannerDiagnostics::describeCycle(Status& status) {
  status.summary(DiagnosticStatus::OK, planner_status_.started ? "planning" : "waiting");
  if (!clock_.empty()) {
    status.summary(DiagnosticStatus::ERROR, clock_);
  } else if (tally_.cycles() == 0) {
    status.summary(DiagnosticStatus::ERROR, "no planning cycle since the last report");
  }
  if (tally_.deadlineMisses() > 0) {
    status.mergeSummaryf(DiagnosticStatus::WARN, "%zu of %zu cycles missed their deadline", tally_.deadlineMisses(),
                         tally_.cycles());
  }
  if (tally_.outOfTime() > 0) {
    status.mergeSummaryf(DiagnosticStatus::WARN, "%zu of %zu cycles had no time to plan for every UAV",
                         tally_.outOfTime(), tally_.cycles());
  }
  if (tally_.refusedTracks() > 0) {
    status.mergeSummaryf(DiagnosticStatus::WARN, "%zu obstacle tracks could not be used", tally_.refusedTracks());
  }
  status.addf("cycle time, mean [ms]", "%.2f", 1e3 * tally_.meanCycleTime());
  status.addf("cycle time, max [ms]", "%.2f", 1e3 * tally_.maxCycleTime());
  status.addf("cycle period [ms]", "%.0f", 1e3 * cycle_period_);
  status.add("cycles", planner_status_.cycle);
  status.add("deadline misses", planner_status_.deadline_misses);
  status.add("cycles out of time since the last report", tally_.outOfTime());
  status.add("plans rejected since the last report", tally_.rejectedPlans());
  status.add("plans rejected", planner_status_.rejected_plans);
  status.add("obstacle tracks refused", tally_.refusedTracks());
  status.add("references set", references_);
  status.add("references refused", references_refused_);
}

void PlannerDiagnostics::describeTracks(Status& status) {
  const double age = now_ - tracks_.stamp;
  if (tracks_.crowded > last_tracks_.crowded) {
    status.summaryf(DiagnosticStatus::ERROR, "too many tracks: the %zu nearest to the UAVs are used", tracks_.known);
  } else if (tracks_.dropped.total() > last_tracks_.dropped.total()) {
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
  addDropped("tracks or messages dropped", tracks_.dropped, status);
}

void PlannerDiagnostics::describeTransforms(Status& status) {
  const bool dropped = transforms_.dropped.total() > last_transforms_.dropped.total();
  status.summary(dropped ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                 dropped ? transforms_.last_fault : "no transform dropped");
  status.addf("rate [Hz]", "%.1f", rate(transforms_.accepted, last_transforms_.accepted));
  addDropped("transforms or messages dropped", transforms_.dropped, status);
}

void PlannerDiagnostics::describeMap(Status& status) {
  if (map_.dropped.total() > last_map_.dropped.total()) {
    status.summary(DiagnosticStatus::WARN, map_.last_fault);
  } else if (map_.source.empty()) {
    status.summary(DiagnosticStatus::OK, "no map");
  } else {
    status.summaryf(DiagnosticStatus::OK, "%zu occupied voxels of %g m", map_.voxels, map_.resolution);
  }
  status.add("source", map_.source.empty() ? "none" : shortened(map_.source, 200));
  status.addf("rate [Hz]", "%.1f", rate(map_.accepted, last_map_.accepted));
  status.addf("delay from message to use [ms]", "%.1f", 1e3 * map_.delay);
  status.addf("memory [MB]", "%.1f", map_.memory);
  addDropped("maps or clouds dropped", map_.dropped, status);
}

void PlannerDiagnostics::describeUav(std::size_t uav, Status& status) {
  const UavInput& input = uavs_[uav];
  if (uav < planner_status_.uavs.size()) {
    const UavStatus& state = planner_status_.uavs[uav];
    status.summary(levelOf(state), textOf(state));
    if (uav < tally_.worst().size() && levelOf(tally_.worst()[uav]) > levelOf(state)) {
      status.summary(levelOf(tally_.worst()[uav]),
                     textOf(state) + "; since the last report: " + textOf(tally_.worst()[uav]));
    }
    status.add("plan refused because", state.refusal.empty() ? "not refused" : state.refusal);
    status.addf("deviation [m]", "%.3f", state.deviation);
    status.addf("lag [m]", "%.1f", state.lag);
    status.addf("predicted clearance to obstacles [m]", "%.2f", state.obstacle_clearance);
    status.addf("predicted distance to UAVs [m]", "%.2f", state.uav_distance);
    status.addf("largest slack [m]", "%.3f", state.max_slack);
    status.addf("solve time [ms]", "%.2f", 1e3 * state.solve_time);
  } else {
    status.summary(DiagnosticStatus::WARN, "not planned for yet");
  }
  // Messages that overtake each other are usual on slow links.
  const auto faulty = [](const FaultCounts& dropped) { return dropped.total() - dropped.of(InputFault::kOutOfOrder); };
  const std::uint64_t dropped = faulty(input.dropped) - faulty(last_uavs_[uav].dropped);
  if (dropped > 0) status.mergeSummary(DiagnosticStatus::WARN, std::to_string(dropped) + " odometry messages dropped");
  status.addf("odometry rate [Hz]", "%.1f", rate(input.accepted, last_uavs_[uav].accepted));
  if (input.received) status.addf("odometry age [s]", "%.2f", now_ - input.sample.stamp);
  addDropped("odometry dropped", input.dropped, status);
}

}  // namespace swarm_planner
