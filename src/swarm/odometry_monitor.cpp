// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/odometry_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "swarm_planner/config/plausible.hpp"

namespace swarm_planner {
namespace {

constexpr double kLeastNoise = 0.05;   // rounding must not look like a motion, nor every step like a jump [m]
constexpr double kFrozenNoises = 2.0;  // odometry_noise that the UAV should have moved by
constexpr double kMotionNoises = 3.0;  // odometry_noise that a UAV may be off where it is to be again after a fault
constexpr double kJumpNoises = 7.0;    // odometry_noise that two measurements may differ by
constexpr double kSpeedSlack = 1.2;    // gusts carry a UAV faster than it is allowed to plan
constexpr double kStanding = 0.3;      // a UAV that is slower stands [m/s]
constexpr double kLongestStep = 0.5;   // between two measurements, for their mean velocity to tell the way [s]
constexpr double kDriftMemory = 5.0;   // time constant in which a difference of way and velocity is forgotten [s]

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

/// Whether two measurements in a row, both doubted, are surely not of the same source: it has begun to lie otherwise,
/// or to tell the truth.
bool isElsewhere(const UavMeasurement& from, const UavMeasurement& to, const Parameters& parameters) {
  const double dt = to.stamp - from.stamp;
  const double acceleration = parameters.limits.max_thrust_ratio * parameters.vehicle.gravity;
  const double most = 0.25 * dt * dt * acceleration + kMotionNoises * noiseOf(parameters.input);
  return dt <= 0.0 || (to.p - from.p - 0.5 * dt * (from.v + to.v)).norm() > most;
}

}  // namespace

Reason OdometryMonitor::judge(const UavMeasurement& measurement, double now, const MotionMemory& motions,
                              const Parameters& parameters) {
  if (!measurement.received) return Reason::kWaitingForOdometry;
  if (!isWithin(measurement.p, kMostCoordinate) || !isWithin(measurement.v, kMostSpeed) ||
      !std::isfinite(measurement.stamp)) {
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
    fault_ = Reason::kOdometryJumps;  // should it go on elsewhere
    if (!doubted_) doubted_since_ = overdue_since_.value_or(measurement.stamp);
    source_changed_ = true;  // as soon as anything else comes
    doubted_ = measurement;
    return Reason::kOdometryFrozen;
  }
  if (doubted_ && isElsewhere(*doubted_, measurement, parameters)) source_changed_ = true;
  const bool fits =
      !trusted_ || (doubted_ ? isBack(measurement, motions, parameters) ||
                                   (source_changed_ && hasStoodOnWay(measurement, motions, parameters.input))
                             : follows(measurement, motions, parameters));
  if (fits) {
    trust(measurement, motions);
    return Reason::kNone;
  }
  // A drift has been there for a while before it showed: so far it is not the UAV that is off its motion.
  if (!doubted_ && fault_ == Reason::kOdometryDrifts) trusted_off_ -= drift_;
  const bool goes_on = doubted_ && isReachable(*doubted_, measurement, parameters);
  if (!goes_on) doubted_since_ = measurement.stamp;
  if (doubted_ && !goes_on) after_gap_ = false;
  doubted_ = measurement;
  if (measurement.stamp - doubted_since_ < parameters.input.relocalisation_time) return fault_;
  trust(measurement, motions);
  return Reason::kNone;
}

bool OdometryMonitor::follows(const UavMeasurement& measurement, const MotionMemory& motions,
                              const Parameters& parameters) {
  const double dt = measurement.stamp - trusted_->stamp;
  fault_ = dt < 0.0 ? Reason::kOdometryBackwards : Reason::kOdometryJumps;
  if (!isReachable(*trusted_, measurement, parameters)) return false;
  // A source that always says zero does not know the velocity.
  const bool is_known = !trusted_->v.isZero(0.0) || !measurement.v.isZero(0.0);
  if (dt > kLongestStep || !is_known || !has_moved_) {
    drift_.setZero();
    after_gap_ = source_changed_ = dt > kLongestStep && isFarOff(measurement, motions, parameters);
    return !after_gap_;
  }
  drift_ *= std::exp(-dt / kDriftMemory);
  drift_ += measurement.p - trusted_->p - 0.5 * dt * (trusted_->v + measurement.v);
  fault_ = Reason::kOdometryDrifts;
  return drift_.norm() <= kJumpNoises * noiseOf(parameters.input);
}

bool OdometryMonitor::isBack(const UavMeasurement& measurement, const MotionMemory& motions,
                             const Parameters& parameters) const {
  if (measurement.stamp <= trusted_->stamp) return false;
  const std::optional<double> off = newDeviation(measurement, motions);
  if (!off) {
    const bool is_recent = measurement.stamp - trusted_->stamp <= parameters.input.odometry_doubt_time;
    return is_recent && isReachable(*trusted_, measurement, parameters);
  }
  return *off <= kMotionNoises * noiseOf(parameters.input);
}

bool OdometryMonitor::isFarOff(const UavMeasurement& measurement, const MotionMemory& motions,
                               const Parameters& parameters) const {
  const double explained = parameters.limits.tracking_error + kMotionNoises * noiseOf(parameters.input);
  const std::optional<double> off = newDeviation(measurement, motions);
  return off && *off > std::max(parameters.input.off_plan_distance, explained);
}

std::optional<double> OdometryMonitor::newDeviation(const UavMeasurement& measurement,
                                                    const MotionMemory& motions) const {
  const auto from = [&](const KinematicState& expected) {
    const Vector3 off = measurement.p - expected.p;
    // Tracking may have brought it nearer to its motion meanwhile.
    const double share = trusted_off_.isZero(0.0) ? 0.0 : off.dot(trusted_off_) / trusted_off_.squaredNorm();
    return (off - std::clamp(share, 0.0, 1.0) * trusted_off_).norm();
  };
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  if (!expected) return {};
  double least = from(*expected);
  // The newest may not have arrived: nobody has seen yet.
  const CommittedMotion* older = motions.older();
  if (older != nullptr && measurement.stamp >= older->epoch()) {
    least = std::min(least, from(older->at(measurement.stamp)));
  }
  return least;
}

bool OdometryMonitor::hasStoodOnWay(const UavMeasurement& measurement, const MotionMemory& motions,
                                    const InputParameters& input) {
  constexpr double kStep = 0.1;  // [s]
  // It may have begun to brake before it was believed last.
  const double begin =
      std::max(trusted_->stamp, measurement.stamp - input.relocalisation_time) - input.odometry_doubt_time;
  bool on_way = false;
  for (double t = measurement.stamp; t >= begin && !on_way; t -= kStep) {
    const std::optional<KinematicState> expected = motions.expectedAt(t);
    on_way = expected && (measurement.p - expected->p).norm() <= kMotionNoises * noiseOf(input);
  }
  if (!on_way || measurement.v.norm() > kStanding) {
    stood_.reset();
  } else if (!stood_ || (measurement.p - stood_->p).norm() > kFrozenNoises * noiseOf(input)) {
    stood_ = measurement;
  }
  return stood_ && measurement.stamp - stood_->stamp >= input.odometry_doubt_time;
}

void OdometryMonitor::trust(const UavMeasurement& measurement, const MotionMemory& motions) {
  if (doubted_ || !trusted_) drift_.setZero();
  doubted_.reset();
  source_changed_ = after_gap_ = false;
  stood_.reset();
  trusted_ = measurement;
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  trusted_off_ = expected ? Vector3(measurement.p - expected->p) : Vector3(Vector3::Zero());
}

bool OdometryMonitor::isFrozen(const UavMeasurement& measurement, const MotionMemory& motions,
                               const InputParameters& input) {
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  const bool same = held_ && measurement.p == held_->p && measurement.stamp > held_->stamp;
  if (!first_) first_ = measurement.p;
  has_moved_ = has_moved_ || (measurement.p - *first_).norm() > kFrozenNoises * noiseOf(input);
  if (!same) {
    held_ = measurement;
    forgetMotion();
  }
  if (expected && !held_expected_) held_expected_ = expected->p;
  if (!same || !has_moved_) return false;
  const double least = kFrozenNoises * noiseOf(input);
  if (measurement.v == held_->v && (measurement.stamp - held_->stamp) * held_->v.norm() > least) return true;
  if (!expected || (expected->p - *held_expected_).norm() <= least) {
    overdue_since_.reset();
    return false;
  }
  if (!overdue_since_) overdue_since_ = measurement.stamp;
  // Without setpoints nobody moves: one that only stands still has to be planned for again some time.
  const double overdue = measurement.stamp - *overdue_since_;
  return overdue >= input.odometry_doubt_time && overdue < input.relocalisation_time;
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
