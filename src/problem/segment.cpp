// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {
namespace {

/// Cubic Hermite fit through the states that `at` gives for the time after the horizon's start [s].
template <class StateAt>
void fitThrough(const StateAt& at, double dt, PredictedMotion& motion) {
  motion.box = Box();
  KinematicState begin = at(0.0);
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const KinematicState end = at(static_cast<double>(k + 1) * dt);
    motion.points[3 * k] = begin.p;
    motion.points[3 * k + 1] = begin.p + dt / 3.0 * begin.v;
    motion.points[3 * k + 2] = end.p - dt / 3.0 * end.v;
    begin = end;
  }
  motion.points[3 * kHorizon] = begin.p;
  for (const Vector3& point : motion.points) motion.box.include(point);
}

}  // namespace

void predict(const Trajectory& plan, double epoch, double dt, PredictedMotion& motion) {
  fitThrough([&](double ahead) { return plan.at(epoch + ahead); }, dt, motion);
}

void predictToRest(const Trajectory& plan, double epoch, double dt, PredictedMotion& motion) {
  const double left = plan.epoch + plan.duration() - epoch;
  const KinematicState rest{plan.knots.back().p, Vector3::Zero(), Vector3::Zero()};
  fitThrough([&](double ahead) { return ahead < left ? plan.at(epoch + ahead) : rest; }, dt, motion);
}

void predictResting(const Vector3& position, PredictedMotion& motion) {
  motion.points.fill(position);
  motion.box = Box();
  motion.box.include(position);
}

}  // namespace swarm_planner
