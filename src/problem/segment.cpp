// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {

void predict(const Trajectory& plan, double epoch, double dt, PredictedMotion& motion) {
  motion.box = Box();
  KinematicState begin = plan.at(epoch);
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const KinematicState end = plan.at(epoch + static_cast<double>(k + 1) * dt);
    motion.points[3 * k] = begin.p;
    motion.points[3 * k + 1] = begin.p + dt / 3.0 * begin.v;
    motion.points[3 * k + 2] = end.p - dt / 3.0 * end.v;
    begin = end;
  }
  motion.points[3 * kHorizon] = begin.p;
  for (const Vector3& point : motion.points) motion.box.include(point);
}

void predictResting(const Vector3& position, PredictedMotion& motion) {
  motion.points.fill(position);
  motion.box = Box();
  motion.box.include(position);
}

}  // namespace swarm_planner
