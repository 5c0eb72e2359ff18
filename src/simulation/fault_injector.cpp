// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/fault_injector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace swarm_planner {
namespace {

constexpr double kBraking = 3.0;  // of a vehicle that ignores its setpoints, as autopilots do it [m/s^2]

}  // namespace

FaultInjector::FaultInjector(const Mission& mission, std::uint64_t seed)
    : scenario_faults_(mission.scenario.faults),
      drag_over_mass_(mission.parameters.vehicle.dragOverMass()),
      directions_(streamSeed(seed, RandomUse::kFaultDirection)),
      flicker_(streamSeed(seed, RandomUse::kTrackFlicker)),
      wind_(mission.scenario.uavs.size(), Vector3::Zero()),
      time_(-std::numeric_limits<double>::infinity()) {
  for (const ScenarioUav& uav : mission.scenario.uavs) names_.push_back(uav.name);
}

void FaultInjector::scheduleScenario(double time_zero) {
  const auto is_of_scenario = [](const Fault& fault) { return fault.of_scenario; };
  pending_.erase(std::remove_if(pending_.begin(), pending_.end(), is_of_scenario), pending_.end());
  active_.erase(std::remove_if(active_.begin(), active_.end(), is_of_scenario), active_.end());
  for (const FaultInjection& fault : scenario_faults_) schedule(fault, time_zero, true);
}

void FaultInjector::schedule(const FaultInjection& fault, double now) { schedule(fault, now, false); }

void FaultInjector::schedule(const FaultInjection& fault, double now, bool of_scenario) {
  constexpr double kFullTurn = 6.283185307179586;  // [rad]
  Fault scheduled;
  scheduled.kind = fault.kind;
  if (faultKindInfo(fault.kind).of_uav) {
    const auto name = std::find(names_.begin(), names_.end(), fault.uav);
    if (name == names_.end()) throw std::invalid_argument("there is no UAV " + fault.uav);
    scheduled.uav = static_cast<std::size_t>(name - names_.begin());
  }
  scheduled.begin = now + fault.at;
  scheduled.end = scheduled.begin + fault.duration;
  scheduled.magnitude = fault.magnitude;
  const double heading = kFullTurn * directions_.nextUniform();
  scheduled.direction = Vector3(std::cos(heading), std::sin(heading), 0.0);
  scheduled.of_scenario = of_scenario;
  const auto later = std::upper_bound(pending_.begin(), pending_.end(), scheduled,
                                      [](const Fault& x, const Fault& y) { return x.begin > y.begin; });
  pending_.insert(later, scheduled);
}

void FaultInjector::clear() {
  pending_.clear();
  active_.clear();
  time_ = -std::numeric_limits<double>::infinity();
}

void FaultInjector::advanceTo(double t) {
  time_ = t;
  // A push is over as soon as it has been given.
  const auto is_over = [t](const Fault& fault) {
    return fault.end <= t && (fault.done || faultKindInfo(fault.kind).lasts);
  };
  active_.erase(std::remove_if(active_.begin(), active_.end(), is_over), active_.end());
  while (!pending_.empty() && pending_.back().begin <= t) {
    if (!is_over(pending_.back())) active_.push_back(pending_.back());
    pending_.pop_back();
  }
}

bool FaultInjector::isActive(FaultKind kind) const {
  return std::any_of(active_.begin(), active_.end(), [kind](const Fault& fault) { return fault.kind == kind; });
}

bool FaultInjector::isActive(FaultKind kind, std::size_t uav) const {
  return std::any_of(active_.begin(), active_.end(),
                     [kind, uav](const Fault& fault) { return fault.kind == kind && fault.uav == uav; });
}

bool FaultInjector::spoilOdometry(std::size_t uav, UavMeasurement& measurement, QuadState& state) {
  if (isActive(FaultKind::kOdometryLost, uav)) return false;
  // The kinds in the order in which they act: what repeats old values first, then what is added to values and stamps.
  for (Fault& fault : active_) {
    if (fault.uav != uav || fault.kind != FaultKind::kOdometryFrozen) continue;
    if (!fault.done) {
      fault.frozen = measurement;
      fault.frozen_state = state;
      fault.done = true;
    }
    measurement.p = fault.frozen.p;
    measurement.v = fault.frozen.v;
    state = fault.frozen_state;
  }
  for (const Fault& fault : active_) {
    if (fault.uav != uav) continue;
    if (fault.kind == FaultKind::kOdometryJump) measurement.p += fault.magnitude * fault.direction;
    if (fault.kind == FaultKind::kOdometryDrift) {
      measurement.p += fault.magnitude * (time_ - fault.begin) * fault.direction;
    }
    if (fault.kind == FaultKind::kOdometryNotFinite) measurement.p.setConstant(std::nan(""));
    if (fault.kind == FaultKind::kOdometryStale) measurement.stamp -= fault.magnitude;
  }
  return true;
}

bool FaultInjector::setpointsReach(std::size_t uav) const {
  return !isActive(FaultKind::kSetpointsLost, uav) && !isActive(FaultKind::kSetpointsIgnored, uav);
}

void FaultInjector::disturb(std::size_t uav, QuadSimulator& vehicle) {
  Vector3 wind = Vector3::Zero();
  for (Fault& fault : active_) {
    if (fault.uav != uav) continue;
    if (fault.kind == FaultKind::kWind) wind += fault.magnitude * fault.direction;
    if (fault.done) continue;
    if (fault.kind == FaultKind::kPush) {
      vehicle.push(fault.magnitude * fault.direction);
      fault.done = true;
    } else if (fault.kind == FaultKind::kSetpointsIgnored) {
      vehicle.brake(kBraking);
      fault.done = true;
    }
  }
  if (wind == wind_[uav]) return;
  wind_[uav] = wind;
  vehicle.setDisturbance(drag_over_mass_.cwiseProduct(wind));
}

bool FaultInjector::tracksArrive() const { return !isActive(FaultKind::kTracksLost); }

bool FaultInjector::trackIsSeen() {
  for (const Fault& fault : active_) {
    if (fault.kind == FaultKind::kTracksFlicker && flicker_.nextUniform() < fault.magnitude) return false;
  }
  return true;
}

bool FaultInjector::plannerLives() const { return !isActive(FaultKind::kPlannerDead); }

}  // namespace swarm_planner
