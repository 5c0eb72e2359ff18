// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/plan_start.hpp"

#include <cmath>

namespace swarm_planner {

KinematicState predictFromMeasurement(const UavMeasurement& measurement, double epoch) {
  return {measurement.p + (epoch - measurement.stamp) * measurement.v, measurement.v, Vector3::Zero()};
}

KinematicState predictFromPlan(const Trajectory& committed, const Trajectory& flown, const UavMeasurement& measurement,
                               double epoch, double tracking_time) {
  const KinematicState expected = flown.at(measurement.stamp);
  const double decay = std::exp(-(epoch - measurement.stamp) / tracking_time);
  KinematicState start = committed.at(epoch);
  start.p += decay * (measurement.p - expected.p);
  start.v += decay * (measurement.v - expected.v);
  return start;
}

void shiftPlan(const Trajectory& committed, const KinematicState& start, double epoch, double dt, Trajectory& plan) {
  plan.epoch = epoch;
  plan.dt = dt;
  Vector3 acceleration = start.a;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const Vector3 next = committed.at(epoch + static_cast<double>(k + 1) * dt).a;
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

}  // namespace swarm_planner
