// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

/// Scenarios in which UAVs have to find a way round obstacles or past each other; doc/scenarios.md describes them.
/// Those shipped in config/scenarios/ are what these functions make with the default numbers and seed 0. The same
/// arguments give the same scenario on every platform. All throw std::invalid_argument for numbers that make no
/// scenario. They end once all UAVs are at their goals, after 60 s at most unless said otherwise. `perturbation`:
/// starts and goals are exact with seed 0, and with any other up to so much off along each axis [m].

/// Least gap between two trees of a forest() [m]: a UAV fits through every one, with what the planner keeps for
/// tracking errors (0.72 m).
constexpr double kForestGap = 0.8;

/// `uavs` UAVs of radius 0.3 m on a circle of 22 m radius change places with their opposites through 90 cylinders of
/// 0.2 to 0.5 m radius, higher than the workspace, in a square of 30 m x 30 m: 0.1 per m^2. Two stand in each other or
/// leave a gap of `gap` [m] or more: with kForestGap a way exists from everywhere outside to everywhere outside,
/// through every gap. With 0 they stand anywhere, and the way may lead round the forest.
Scenario forest(int uavs, double gap, std::uint64_t seed);

/// `uavs` UAVs of radius 0.15 m on a circle of 4 m radius change places with their opposites, at most 1 m/s and 2
/// m/s^2, among 10 cylinders of 0.15 to 0.3 m radius within 3 m of the middle; two stand in each other or leave a gap
/// of 0.5 m or more.
Scenario smallForest(int uavs, std::uint64_t seed);

/// `uavs` UAVs in a block fly straight ahead to a wall that closes the workspace but for one opening, which has room
/// for one UAV at a time, and to their places in the same block behind it.
Scenario gap(int uavs, double perturbation, std::uint64_t seed);

/// Each UAV meets the middle of the face of a box of its own (exponents 8 to 16): a cube, a broad one, a high one, a
/// large cube, and so on.
Scenario boxHeadOn(int uavs, double perturbation, std::uint64_t seed);

/// Straight references lead into a U of three walls, as high as the workspace, and through its bottom.
Scenario uTrap(int uavs, double perturbation, std::uint64_t seed);

/// `uavs` UAVs from a circle of 10 m radius are sent to its middle. One can get there: the run ends after 40 s.
Scenario sameGoal(int uavs, double perturbation, std::uint64_t seed);

/// A room of 1.6 m^2 and 1.6 columns per UAV: `uavs` UAVs of radius 0.1 m fly at 0.5 m height from random starts to
/// random goals.
Scenario denseRoom(int uavs, std::uint64_t seed);

/// `uavs` UAVs of radius 0.1 m on a circle with 1.6 m^2 per UAV, at 0.8 to 1.2 m height, change places with their
/// opposites, starts and goals up to 0.12 m off.
Scenario swapInRoom(int uavs, std::uint64_t seed);

}  // namespace swarm_planner
