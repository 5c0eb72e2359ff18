// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/plan_start.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {

KinematicState predictFromMeasurement(const UavMeasurement& measurement, double epoch) {
  return {measurement.p + (epoch - measurement.stamp) * measurement.v, measurement.v, Vector3::Zero()};
}

double carriedShare(const Vector3& dp, const Vector3& dv, double band, double tracking_time) {
  const double size = std::max(dp.norm(), tracking_time * dv.norm());
  if (size <= band) return kLeastCarried;
  return std::max(kLeastCarried, 1.0 - (band / size) * (band / size));
}

KinematicState carryDeviation(const KinematicState& planned, const KinematicState& expected,
                              const UavMeasurement& measurement, double epoch, const InputParameters& parameters) {
  const Vector3 dp = measurement.p - expected.p;
  const Vector3 dv = measurement.v - expected.v;
  const double decay = std::exp(-(epoch - measurement.stamp) / parameters.tracking_time);
  const double share = decay * carriedShare(dp, dv, parameters.odometry_noise, parameters.tracking_time);
  KinematicState start = planned;
  start.p += share * dp;
  start.v += share * dv;
  return start;
}

void shiftPlan(const CommittedMotion& committed, const KinematicState& start, double epoch, double dt,
               Trajectory& plan) {
  plan.epoch = epoch;
  plan.dt = dt;
  // Where the acceleration is held, that of each stage is the one in its middle.
  const double end = plan.holds_acceleration ? 0.5 : 1.0;
  Vector3 acceleration = start.a;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const Vector3 next = committed.at(epoch + (static_cast<double>(k) + end) * dt).a;
    plan.jerks[k] = (next - acceleration) / dt;
    acceleration = next;
  }
  rollOut(start, plan);
}

void coastingPlan(const KinematicState& start, double epoch, double dt, Trajectory& plan) {
  plan.epoch = epoch;
  plan.dt = dt;
  plan.jerks.fill(Vector3::Zero());
  rollOut(start, plan);
}

double shareWithinJerk(const Trajectory& from, const Trajectory& to, double max_jerk) {
  double share = 1.0;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    // The root of |from + share (to - from)|^2 = max_jerk^2.
    const Vector3 change = to.jerks[k] - from.jerks[k];
    const double room = max_jerk * max_jerk - from.jerks[k].squaredNorm();
    if (room < 0.0 || to.jerks[k].squaredNorm() <= max_jerk * max_jerk) continue;
    const double slope = from.jerks[k].dot(change);
    const double squared_length = change.squaredNorm();
    share = std::min(share, (std::sqrt(slope * slope + squared_length * room) - slope) / squared_length);
  }
  return share;
}

}  // namespace swarm_planner
