// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/odometry_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kLargest = 1e8;       // metres or m/s that no UAV is at: an estimator has diverged
constexpr double kLeastNoise = 0.05;   // rounding must not look like a motion, nor every step like a jump [m]
constexpr double kFrozenNoises = 2.0;  // odometry_noise that the UAV should have moved by
constexpr double kMotionNoises = 2.0;  // odometry_noise that a UAV on its motion may be off it
constexpr double kJumpNoises = 7.0;    // odometry_noise that two measurements may differ by
constexpr double kSpeedSlack = 1.2;    // gusts carry a UAV faster than it is allowed to plan

/// False for NaN too.
bool isPlausible(const Vector3& x) { return (x.array().abs() < kLargest).all(); }

double noiseOf(const InputParameters& input) { return std::max(input.odometry_noise, kLeastNoise); }

/// Whether a flight leads from one measurement to a later one.
bool isReachable(const UavMeasurement& from, const UavMeasurement& to, const Parameters& parameters) {
  const double dt = to.stamp - from.stamp;
  if (dt <= 0.0) return false;
  const double noise = kJumpNoises * noiseOf(parameters.input);
  const Vector3 way = to.p - from.p;
  const double speed = kSpeedSlack * std::max({parameters.limits.max_speed, from.v.norm(), to.v.norm()});
  const double acceleration = parameters.limits.max_thrust_ratio * parameters.vehicle.gravity;
  return way.norm() <= speed * dt + noise &&
         (way - 0.5 * dt * (from.v + to.v)).norm() <= 0.25 * dt * dt * acceleration + noise;
}

/// Whether it is where it is to be, but for noise.
bool isOnMotion(const UavMeasurement& measurement, const MotionMemory& motions, const InputParameters& input) {
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  return expected && (measurement.p - expected->p).norm() <= kMotionNoises * noiseOf(input);
}

}  // namespace

Reason OdometryMonitor::judge(const UavMeasurement& measurement, double now, const MotionMemory& motions,
                              const Parameters& parameters) {
  if (!measurement.received) return Reason::kWaitingForOdometry;
  if (!isPlausible(measurement.p) || !isPlausible(measurement.v) || !std::isfinite(measurement.stamp)) {
    return Reason::kOdometryNotFinite;
  }
  if (measurement.stamp > now + kClockTolerance) return Reason::kOdometryFromFuture;
  if (now - measurement.stamp > parameters.input.odometry_timeout) return Reason::kOdometryStale;
  if (!newest_ || measurement.stamp != newest_->stamp) {
    verdict_ = compare(measurement, motions, parameters);
    newest_ = measurement;
  }
  return verdict_;
}

Reason OdometryMonitor::compare(const UavMeasurement& measurement, const MotionMemory& motions,
                                const Parameters& parameters) {
  if (isFrozen(measurement, motions, parameters.input)) {
    // What repeated it was believed until now.
    if (trusted_ && trusted_->p == held_->p) trusted_ = held_;
    return Reason::kOdometryFrozen;
  }
  // Among doubted ones the last that was believed soon explains everything; to be where the motion has the UAV is
  // better.
  const double doubt_time = parameters.input.odometry_doubt_time;
  const bool is_comparable = trusted_ && (!doubted_ || measurement.stamp - trusted_->stamp <= doubt_time);
  if (!trusted_ || (is_comparable && isReachable(*trusted_, measurement, parameters)) ||
      (doubted_ && isOnMotion(measurement, motions, parameters.input))) {
    trusted_ = measurement;
    doubted_.reset();
    return Reason::kNone;
  }
  const Reason fault = measurement.stamp < trusted_->stamp ? Reason::kOdometryBackwards : Reason::kOdometryJumps;
  if (!doubted_ || !isReachable(*doubted_, measurement, parameters)) doubted_since_ = measurement.stamp;
  doubted_ = measurement;
  if (measurement.stamp - doubted_since_ < doubt_time) return fault;
  trusted_ = measurement;
  doubted_.reset();
  return Reason::kNone;
}

bool OdometryMonitor::isFrozen(const UavMeasurement& measurement, const MotionMemory& motions,
                               const InputParameters& input) {
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  const bool same = held_ && measurement.p == held_->p && measurement.stamp > held_->stamp;
  if (!same) {
    held_ = measurement;
    forgetMotion();
  }
  if (expected && !held_expected_) held_expected_ = expected->p;
  if (!same) return false;
  const double least = kFrozenNoises * noiseOf(input);
  if (measurement.v == held_->v && (measurement.stamp - held_->stamp) * held_->v.norm() > least) return true;
  if (!expected || (expected->p - *held_expected_).norm() <= least) {
    overdue_since_.reset();
    return false;
  }
  if (!overdue_since_) overdue_since_ = measurement.stamp;
  return measurement.stamp - *overdue_since_ >= input.odometry_doubt_time;
}

void OdometryMonitor::forgetMotion() {
  held_expected_.reset();
  overdue_since_.reset();
}

bool OdometryMonitor::noteDeviation(double deviation, double stamp, const InputParameters& input) {
  if (deviation <= input.off_plan_distance) {
    off_plan_since_.reset();
    return false;
  }
  if (!off_plan_since_) off_plan_since_ = stamp;
  if (stamp - *off_plan_since_ < input.odometry_doubt_time) return false;
  off_plan_since_.reset();
  return true;
}

}  // namespace swarm_planner
