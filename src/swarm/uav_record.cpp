// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/uav_record.hpp"

#include <algorithm>

#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/stopping.hpp"

namespace swarm_planner {
namespace {

constexpr double kBoundSlack = 0.1;     // of a bound, by which a measured start may exceed it
constexpr double kMoved = 0.5;          // a UAV at rest that is so far from its place has been moved [m]
constexpr double kDeviationGain = 0.2;  // of a new measurement in the mean deviation
constexpr double kBefore = 1e-6;        // an instant before another [s]
constexpr double kLostMargins = 2.0;    // tracking margins by which a lost setpoint shows

/// A UAV measured farther from its motion than this is not on it [m]: neither tracking nor noise explains that.
double leastDistanceOff(const Parameters& parameters) {
  return 2.0 * std::max(parameters.limits.tracking_margin, parameters.input.odometry_noise);
}

}  // namespace

FollowedTarget followedTarget(UavRecord& record) {
  if (record.task.mode != FlightMode::kFlying) {
    return {record.task.target, record.task.on_target_path, record.task.target_progress};
  }
  TrafficState& traffic = record.traffic;
  if (traffic.gives_way) return {traffic.aside, traffic.on_aside_path, traffic.aside_progress};
  return {record.reference, record.on_reference, record.progress};
}

void UavRecord::setReference(const std::vector<Vector3>& path, double arc_length, double speed) {
  reference = MovingTarget();
  reference.path = ReferencePath(path);
  reference.start = arc_length;
  given_start = arc_length;
  reference.speed = speed;
  beginning.on_reference = false;
  reference_pending = true;
  on_reference = false;
  guide.forget();
  traffic.forget(traffic.since);
}

void UavRecord::reset() {
  motions.clear();
  planned = false;
  deviation.setZero();
  task.enter(task.mode);
  beginning.reset();
  reference.start = given_start;
  reference_pending = true;
  on_reference = false;
  traffic = TrafficState();
  active.count = 0;
  guide.forget();
  monitor = OdometryMonitor();
  unseen = evades = false;
  following.reset();
  aside.reset();
}

void UavRecord::predictStart(const UavMeasurement& measurement, double epoch, const Parameters& parameters,
                             const FlightBounds& bounds) {
  motions.compare(measurement.stamp, measurement.p, kLostMargins * parameters.limits.tracking_margin);
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  const Vector3 measured = expected ? Vector3(measurement.p - expected->p) : Vector3(Vector3::Zero());
  deviation += kDeviationGain * (measured - deviation);
  const bool rests = expected && measurement.stamp > motions.flown().epoch() + motions.flown().duration();
  const bool is_back = unseen;
  unseen = evades = false;
  aside.reset();
  if (parameters.limits.latency_compensation) {
    following.note(measurement, monitor.drift(), motions, parameters.input);
  }
  const KinematicState seen = predictFromMeasurement(measurement, epoch);
  if (following.isSuspected()) setAside(seen, epoch, parameters, bounds);
  off_plan = monitor.noteDeviation(measured.norm(), measurement.stamp, parameters.input);
  const bool moved = rests && measured.norm() > kMoved;
  const bool is_elsewhere = is_back && (motions.empty() || measured.norm() > leastDistanceOff(parameters));
  if (!moved && (off_plan || is_elsewhere || following.isOff())) {
    off_plan_distance = measured.norm();
    startAnew(seen, epoch, parameters, bounds);
    return;
  }
  if (!expected || moved) {
    start = seen;
    if (expected || motions.empty()) {
      motions.clear();
      monitor.forgetMotion();
      CommittedMotion rest;
      rest.assignRest(measurement.stamp, measurement.p);
      motions.commit(rest);
      planned = false;
    }
    return;
  }
  if (!parameters.limits.latency_compensation) {
    // Odometry has no acceleration: without that of the motion it would begin at zero in every cycle.
    // As in the paper it jumps at the epoch: what counts is that before.
    const double before = parameters.limits.as_paper ? kBefore : 0.0;
    start = {measurement.p, measurement.v, motions.flown().at(epoch - before).a};
    return;
  }
  // At once if it is far off; if it is off by less, but for long, it may hover while its motions leave.
  const double least_mean = std::max(parameters.limits.tracking_margin, parameters.input.odometry_noise);
  if (measured.norm() > leastDistanceOff(parameters) || deviation.norm() > least_mean) {
    setAside(seen, epoch, parameters, bounds);
  }
  start = carryDeviation(motions.flown().at(epoch), *expected, measurement, epoch, parameters.input);
}

void UavRecord::setAside(const KinematicState& measured, double epoch, const Parameters& parameters,
                         const FlightBounds& bounds) {
  StopManoeuvre stop;
  planStop(measured, parameters.time.sampling_time, relieveBounds(bounds, measured, kBoundSlack), stop);
  aside.emplace().assignStop(epoch, stop);
}

void UavRecord::startAnew(const KinematicState& measured, double epoch, const Parameters& parameters,
                          const FlightBounds& bounds) {
  start = measured;
  setAside(measured, epoch, parameters, bounds);
  motions.startAnew(*aside);
  monitor.forgetMotion();
  planned = true;
  deviation.setZero();
}

void UavRecord::setForeign(bool is_foreign) {
  if (foreign == is_foreign) return;
  foreign = is_foreign;
  unseen = !foreign;  // where it comes from is not what it was to fly
  following.reset();
  aside.reset();
  on_reference = false;
}

bool UavRecord::isOnMotion(const UavMeasurement& measurement, const Parameters& parameters) const {
  const CommittedMotion& flown = motions.flown();
  if (measurement.stamp > flown.epoch() + flown.duration()) return false;
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  return !expected || (measurement.p - expected->p).norm() <= leastDistanceOff(parameters);
}

void UavRecord::forgetMotions() {
  motions.clear();
  planned = false;
  deviation.setZero();
}

void UavRecord::loseSight(const Parameters& parameters, const FlightBounds& bounds) {
  // Who is not seen may have stopped on its own, as autopilots without a position do, and what odometry says may be the
  // truth though it is not believed: others keep clear of there, too.
  const bool loses = !unseen;
  unseen = true;
  if (monitor.stood()) {
    aside.emplace().assignRest(monitor.stood()->stamp, monitor.stood()->p);
  } else if (const UavMeasurement* elsewhere = monitor.seenElsewhere()) {
    setAside(predictFromMeasurement(*elsewhere, elsewhere->stamp), elsewhere->stamp, parameters, bounds);
  } else if (loses && monitor.trusted()) {
    const UavMeasurement& seen = *monitor.trusted();
    setAside(predictFromMeasurement(seen, seen.stamp), seen.stamp, parameters, bounds);
  }
}

Reason UavRecord::reasonOff(const Parameters& parameters) const {
  if (off_plan) return Reason::kOffPlan;
  if (following.isNotFollowing()) return Reason::kNotFollowing;
  if (following.isBeyondNoise()) return Reason::kOffMotion;
  return deviation.norm() > parameters.limits.tracking_margin ? Reason::kStraying : Reason::kNone;
}

MotionDoubt UavRecord::doubt(const InputParameters& input) const {
  if (!unseen || !monitor.trusted()) return {};
  return {monitor.trusted()->stamp, input.lost_growth_rate, input.lost_growth_limit};
}

}  // namespace swarm_planner
