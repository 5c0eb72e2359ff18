// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {

/// Prediction of a UAV that rests at `position`.
inline void predictResting(const Vector3& position, PredictedMotion& motion) {
  motion.points.fill(position);
  motion.box = Box();
  motion.box.include(position);
}

}  // namespace swarm_planner
