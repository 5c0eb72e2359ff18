// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>

#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {

/// The targets X_m of eq. (16) for the stages of a horizon.
using StageTargets = std::array<TargetState, kHorizon + 1>;

/// Where the moving target will be at each stage of a horizon that begins at `epoch`, with step `dt` [s]. A target that
/// is past a corner would draw the UAV, which has come to `progress` [m], across the corner, or hold it fast where the
/// legs part: the point of the first leg that is nearest to the target is where both terms of the cost balance. So
/// beyond a corner a target is no farther along the path than a UAV with `speed` [m/s] can have come by then, and waits
/// at a sharp corner (ReferencePath::nextSharpCorner) until the UAV has passed it. On the leg that the UAV is on
/// nothing changes.
StageTargets previewTargets(const MovingTarget& target, double progress, double speed, double epoch, double dt);

}  // namespace swarm_planner
