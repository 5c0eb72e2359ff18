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
  const auto i = static_cast<std::size_t>(segment);
  const double since = elapsed - segment * dt;
  if (holds_acceleration) return propagateHeld(knots[i], knots[i + 1].a, since);
  return propagate(knots[i], jerks[i], since);
}

void rollOut(const KinematicState& start, Trajectory& trajectory) {
  trajectory.knots[0] = start;
  for (std::size_t k = 0; k < trajectory.jerks.size(); ++k) {
    const KinematicState& x = trajectory.knots[k];
    const Vector3& jerk = trajectory.jerks[k];
    const double dt = trajectory.dt;
    trajectory.knots[k + 1] =
        trajectory.holds_acceleration ? propagateHeld(x, x.a + dt * jerk, dt) : propagate(x, jerk, dt);
  }
}

}  // namespace swarm_planner
