// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// A box with rounded edges, id 0.
ScenarioObstacle box(const Vector3& center, const Vector3& radii);

/// UAVs on both sides of a wall that change sides through an opening of 2 m; it fits one of them.
Mission throughTheOpening(int uavs);

/// Two UAVs that meet head on in a lane of 1.6 m width and 24 m length; outside of it there is room.
Mission headOnInALane();

}  // namespace swarm_planner
