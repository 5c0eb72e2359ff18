// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/fault_watch.hpp"

#include <algorithm>
#include <limits>

#include "swarm_planner/swarm/following_watch.hpp"

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t indexOf(const std::string& name, const std::vector<ScenarioUav>& uavs) {
  const auto found = std::find_if(uavs.begin(), uavs.end(), [&](const ScenarioUav& uav) { return uav.name == name; });
  return static_cast<std::size_t>(found - uavs.begin());
}

}  // namespace

bool tellsOfFault(Reason reason) {
  switch (reason) {
    case Reason::kWaitingForOdometry:
    case Reason::kOdometryStale:
    case Reason::kOdometryFromFuture:
    case Reason::kOdometryNotFinite:
    case Reason::kOdometryFrozen:
    case Reason::kOdometryJumps:
    case Reason::kOdometryBackwards:
    case Reason::kOdometryDrifts:
    case Reason::kStraying:
    case Reason::kOffMotion:
    case Reason::kNotFollowing:
    case Reason::kOffPlan:
    case Reason::kEvadesUnseen:
    case Reason::kTakingOver:
      return true;
    default:
      return false;
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
  while (finished_ < begun_ && t > records_[finished_].end + kReportTime) ++finished_;
  for (std::size_t i = 0; i < uavs_.size(); ++i) uavs_[i].state = vehicles[i].state();
  for (std::size_t i = finished_; i < begun_; ++i) {
    Record& record = records_[i];
    if (record.uav >= vehicles.size() || t > record.end - twoCycles()) continue;
    record.moved = std::max(record.moved, (vehicles[record.uav].state().p - record.place).norm());
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

/// What a cycle at `now` finds: the vehicle is to fly what the one before has made.
void FaultWatch::watchVehicle(Record& record, double now) const {
  const Uav& uav = uavs_[record.uav];
  const bool is_due = uav.has_due && now >= uav.due.epoch();
  double least = kInfinity;
  Vector3 side = Vector3::Zero();
  for (const CommittedMotion* motion : {&uav.due, &uav.before}) {
    if (!is_due || (motion == &uav.before && !uav.has_before)) break;
    const KinematicState x = motion->at(now);
    const Vector3 dp = uav.state.p - x.p;
    const Vector3 dv = uav.state.v - x.v;
    const double excess = FollowingWatch::excess(dp, dv, parameters_.input);
    if (excess >= least) continue;
    least = excess;
    side = dp + parameters_.input.tracking_time * dv;
  }
  const bool lasts = now >= record.fault.at && now <= record.end + twoCycles();
  const bool is_off = is_due && lasts && least > 1.0;
  const bool same_side = record.strays > 0 && side.dot(record.side) > 0.0;
  record.strays = !is_off ? 0 : same_side ? record.strays + 1 : 1;
  record.side = side;
  record.strayed = std::max(record.strayed, record.strays);
}

void FaultWatch::onCycle(double epoch, const CycleReport& report) {
  const double now = epoch - parameters_.time.cycle_period;
  for (std::size_t i = finished_; i < begun_; ++i) {
    if (records_[i].uav < uavs_.size()) watchVehicle(records_[i], now);
  }
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    Uav& uav = uavs_[i];
    // A motion made before the planner died says nothing about the vehicle once there is a new one.
    uav.has_before = uav.has_due;
    uav.before = uav.due;
    uav.has_due = report.uavs[i].planned;
    if (uav.has_due) uav.due = planner_.committed(i);
    uav.tracks = report.uavs[i].state == UavState::kTracking;
    // That would be so without any fault, too.
    const bool waits = report.uavs[i].reason == Reason::kPlanRefused && report.uavs[i].planned &&
                       report.uavs[i].refusal == CheckReason::kRestingPlace;
    if (!uav.waiting || !(uav.tracks || waits) || now < uav.clear_at) continue;
    if (!uav.tracks) ++waited_;
    recover(i, epoch);
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
      return record.strayed >= kStrayCycles;
    default:
      return false;
  }
}

FaultSummary FaultWatch::summary() const {
  FaultSummary summary;
  summary.waited = waited_;
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
