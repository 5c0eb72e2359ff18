// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/fault_watch.hpp"

#include <algorithm>
#include <limits>

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// So long after its end nothing about a fault is looked at any more, but for recovery [s].
constexpr double kAftermath = std::max(FaultWatch::kReportTime, FaultWatch::kStrayTime);

std::size_t indexOf(const std::string& name, const std::vector<ScenarioUav>& uavs) {
  const auto found = std::find_if(uavs.begin(), uavs.end(), [&](const ScenarioUav& uav) { return uav.name == name; });
  return static_cast<std::size_t>(found - uavs.begin());
}

}  // namespace

bool tellsOfFault(Reason reason) {
  switch (reason) {
    case Reason::kNone:
    case Reason::kSolverFailed:
    case Reason::kPlanRefused:
    case Reason::kBraking:
    case Reason::kUnsafeRest:
    case Reason::kNoSafePlan:
    case Reason::kOverrun:
    case Reason::kGivesWay:
    case Reason::kWaits:
    case Reason::kParked:
      return false;
    default:
      return true;
  }
}

FaultWatch::FaultWatch(const Mission& mission, const CyclePlanner& planner)
    : parameters_(mission.parameters), planner_(planner), uavs_(mission.scenario.uavs.size()) {
  for (const FaultInjection& fault : mission.scenario.faults) {
    Record record;
    record.fault = fault;
    record.uav = indexOf(fault.uav, mission.scenario.uavs);
    record.end = fault.at + fault.duration;
    record.waiting = record.uav == uavs_.size() ? uavs_.size() : 1;
    records_.push_back(record);
  }
  std::stable_sort(records_.begin(), records_.end(),
                   [](const Record& x, const Record& y) { return x.fault.at < y.fault.at; });
}

void FaultWatch::onSample(double t, const std::vector<QuadSimulator>& vehicles, const std::vector<Superellipsoid>&) {
  for (; begun_ < records_.size() && records_[begun_].fault.at <= t; ++begun_) {
    Record& record = records_[begun_];
    if (record.uav < vehicles.size()) record.place = vehicles[record.uav].state().p;
    begin(record);
  }
  while (finished_ < begun_ && t > records_[finished_].end + kAftermath) ++finished_;
  for (std::size_t i = finished_; i < begun_; ++i) {
    Record& record = records_[i];
    if (record.uav < vehicles.size() && t <= record.end + kStrayTime) watchVehicle(record, t, vehicles[record.uav]);
  }
}

void FaultWatch::begin(Record& record) {
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    if (!concerns(record, i)) continue;
    Uav& uav = uavs_[i];
    if (!uav.waiting) {
      uav.waiting = uav.tracks;
      uav.unrecovered = static_cast<std::size_t>(&record - records_.data());
      uav.clear_at = record.end;
    }
    uav.clear_at = std::max(uav.clear_at, record.end);
    if (!uav.waiting) --record.waiting;
  }
}

void FaultWatch::watchVehicle(Record& record, double t, const QuadSimulator& vehicle) const {
  if (t <= record.end - twoCycles()) record.moved = std::max(record.moved, (vehicle.state().p - record.place).norm());
  const Uav& uav = uavs_[record.uav];
  const bool next_flies = uav.has_next && t >= uav.next.epoch();
  if (!next_flies && !uav.has_due) return;
  const Vector3 due = (next_flies ? uav.next : uav.due).at(t).p;
  const bool strays = (vehicle.state().p - due).norm() > 2.0 * parameters_.limits.tracking_margin;
  if (strays && !record.strays) record.strayed_since = t;
  if (strays) record.strayed_for = std::max(record.strayed_for, t - record.strayed_since);
  record.strays = strays;
}

void FaultWatch::onCycle(double epoch, const CycleReport& report) {
  const double now = epoch - parameters_.time.cycle_period;
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    Uav& uav = uavs_[i];
    uav.due = uav.next;
    uav.has_due = uav.has_next;
    uav.has_next = report.uavs[i].planned;
    if (uav.has_next) uav.next = planner_.committed(i);
    uav.tracks = report.uavs[i].state == UavState::kTracking;
    if (uav.waiting && uav.tracks && now >= uav.clear_at) recover(i, epoch);
  }
  for (std::size_t i = finished_; i < begun_; ++i) {
    Record& record = records_[i];
    if (now >= visibleFrom(record) && now < record.end) ++record.met;
    if (record.reported || record.uav >= uavs_.size() || now > record.end + kReportTime) continue;
    if (!tellsOfFault(report.uavs[record.uav].reason)) continue;
    record.reported = true;
    record.first_report = now;
  }
}

/// The UAV flies from `epoch` on.
void FaultWatch::recover(std::size_t uav, double epoch) {
  Uav& recovered = uavs_[uav];
  for (std::size_t i = recovered.unrecovered; i < begun_; ++i) {
    if (!concerns(records_[i], uav)) continue;
    records_[i].recovery_time = std::max(records_[i].recovery_time, epoch - recovered.clear_at);
    --records_[i].waiting;
  }
  recovered.waiting = false;
}

double FaultWatch::visibleFrom(const Record& record) const {
  const bool after_timeout =
      record.fault.kind == FaultKind::kOdometryLost || record.fault.kind == FaultKind::kOdometryFrozen;
  return record.fault.at + (after_timeout ? parameters_.input.odometry_timeout : 0.0);
}

bool FaultWatch::isNoticeable(const Record& record) const {
  const double margins = 2.0 * parameters_.limits.tracking_margin;
  const FaultInjection& fault = record.fault;
  const bool met = record.met >= 2;
  switch (fault.kind) {
    case FaultKind::kOdometryLost:
    case FaultKind::kOdometryNotFinite:
      return met;
    case FaultKind::kOdometryStale:
      return met && fault.magnitude > parameters_.input.odometry_timeout;
    case FaultKind::kOdometryFrozen:
      return met && record.moved > margins;
    case FaultKind::kOdometryJump:
      return met && fault.magnitude > margins;
    case FaultKind::kOdometryDrift:
      return met && fault.magnitude * (fault.duration - twoCycles()) > margins;
    case FaultKind::kSetpointsLost:
    case FaultKind::kSetpointsIgnored:
    case FaultKind::kPush:
    case FaultKind::kWind:
      return record.strayed_for > kStrayTime;
    default:
      return false;
  }
}

FaultSummary FaultWatch::summary() const {
  FaultSummary summary;
  for (const FaultKindInfo& info : faultKinds()) summary.kinds.push_back({info.kind, 0, 0, 0, 0.0, 0, 0.0});
  for (std::size_t i = 0; i < begun_; ++i) {
    const Record& record = records_[i];
    FaultTally& tally = summary.kinds[static_cast<std::size_t>(record.fault.kind)];
    const bool noticeable = isNoticeable(record);
    const bool recovered = record.waiting == 0;
    ++tally.injected;
    if (noticeable) ++tally.noticeable;
    if (noticeable && record.reported) {
      ++tally.reported;
      tally.report_delay = std::max(tally.report_delay, record.first_report - record.fault.at);
    }
    if (recovered) ++tally.recovered;
    const double recovery_time = recovered ? record.recovery_time : kInfinity;
    tally.recovery_time = std::max(tally.recovery_time, recovery_time);
    summary.recovery_time = std::max(summary.recovery_time, recovery_time);
    const bool unreported = noticeable && !record.reported;
    if (!unreported && recovery_time <= kRecoveryTime) continue;
    summary.misses.push_back({record.fault.kind, record.fault.at, record.fault.uav, unreported, recovery_time});
  }
  const auto none = [](const FaultTally& tally) { return tally.injected == 0; };
  summary.kinds.erase(std::remove_if(summary.kinds.begin(), summary.kinds.end(), none), summary.kinds.end());
  return summary;
}

}  // namespace swarm_planner
