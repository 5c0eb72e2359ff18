// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/model/trajectory.hpp"

#include <algorithm>

namespace swarm_planner {

KinematicState Trajectory::after(double elapsed) const {
  if (elapsed > duration()) {
    KinematicState coasting = knots.back();
    coasting.p += (elapsed - duration()) * coasting.v;
    coasting.a.setZero();
    return coasting;
  }
  // Compared before the conversion to an integer: a time far from the epoch would overflow it.
  const double scaled = elapsed / dt;
  const int segment = scaled > 0.0 ? std::min(static_cast<int>(scaled), kHorizon - 1) : 0;
  return propagate(knots[static_cast<std::size_t>(segment)], jerks[static_cast<std::size_t>(segment)],
                   elapsed - segment * dt);
}

void rollOut(const KinematicState& start, Trajectory& trajectory) {
  trajectory.knots[0] = start;
  for (std::size_t k = 0; k < trajectory.jerks.size(); ++k) {
    trajectory.knots[k + 1] = propagate(trajectory.knots[k], trajectory.jerks[k], trajectory.dt);
  }
}

}  // namespace swarm_planner
