// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

/// The box in which a rehearsal's UAVs have their goals [m]; its workspace reaches farther, so that there is room to
/// dodge.
Workspace rehearsalField(int uavs);

/// The track_timeout with which a rehearsal is flown [s]: tracks are lost for shorter.
constexpr double kRehearsalTrackTimeout = 6.0;

/// `uavs` UAVs at random starts among three standing columns, two moving obstacles that cross the field, and faults of
/// every kind at random times on random UAVs, sometimes two at once, for `duration` [s]; the last 20 s are without.
/// Each reference is its start alone: somebody else gives the UAVs goals. Moving obstacles begin 40 m or more before
/// the workspace. The same seed gives the same scenario on every machine. Throws std::invalid_argument if there is no
/// UAV, the duration is not above 0, or no place is found for so many starts.
Scenario rehearsal(int uavs, double duration, std::uint64_t seed);

}  // namespace swarm_planner
