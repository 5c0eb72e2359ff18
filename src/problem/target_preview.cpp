// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/target_preview.hpp"

#include <algorithm>

namespace swarm_planner {

StageTargets previewTargets(const MovingTarget& target, double progress, double speed, double epoch, double dt) {
  StageTargets targets;
  const double corner = target.path.nextCorner(progress);
  const double sharp_corner = target.path.nextSharpCorner(progress);
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    const double time = static_cast<double>(k) * dt;
    TargetState& state = targets[k];
    state = target.at(epoch + time);
    const double reached = progress + speed * time;
    const double most = std::min(std::max(corner, reached), sharp_corner);
    if (state.arc_length <= most) continue;
    state.p = target.path.at(most).position;
    state.arc_length = most;
    // It comes to the corner at which it waits as the UAV does.
    state.v = reached < sharp_corner ? Vector3(speed * target.path.at(reached).tangent) : Vector3(Vector3::Zero());
  }
  return targets;
}

}  // namespace swarm_planner
