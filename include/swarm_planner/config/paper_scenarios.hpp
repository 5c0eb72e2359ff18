// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

/// Scenarios that programs make: those of the paper's section 4 and the ones that planners are compared on.
/// The files of the same names in config/scenarios/ hold exactly what these functions return. Everything is
/// deterministic and the same on every platform; the functions throw std::invalid_argument for counts below 1.

/// Section 4: six UAVs from Table 2, seven stationary and two moving obstacles, weights of Table 3.
Scenario paperSix();

/// Section 4.2: `uavs` UAVs on parallel references along x among the obstacles of paperSix(). 6 as in Table 2;
/// 16 as 4 x 4 (y x z), 30 m apart, the first at (0, 30, 30); 32 as 8 x 4 and 64 as 8 x 8, 20 m apart, the first
/// at (0, 20, 20); any other number as ceil(sqrt(uavs)) columns along y, 20 m apart, likewise.
Scenario paperScaling(int uavs);

/// Section 4.1: random obstacles around the references of paperScaling(uavs), to x = 800 m. One to ten stationary
/// and one to ten moving obstacles, each number with equal chances, and all else uniform in the paper's ranges:
/// centre in [100, 800] x [-300, 300] x [0, 400] m, radii in [20, 50] m, real exponents in [2, 10], speed in
/// [0.5, 5.55] m/s, heading in [-pi, pi], climb angle in [-pi/2, pi/2], eq. (19).
Scenario paperMonteCarlo(int uavs, std::uint64_t seed);

/// Six references, one of them vertical and no two opposite, that cross at one point; all targets are there at
/// the same time.
Scenario crossing();

/// How far the seeds of circleSwap() and its like move starts and goals along each axis, unless told otherwise [m]:
/// enough to break the symmetry.
constexpr double kPerturbation = 0.1;

/// `uavs` UAVs evenly on a horizontal circle of `radius` [m] change places with their antipodes. Seed 0 is exactly
/// symmetric; any other moves each start and goal by up to `perturbation` [m] along each axis.
Scenario circleSwap(int uavs, double radius, std::uint64_t seed, double perturbation = kPerturbation);

/// `uavs` UAVs cross a field of 30 m x 30 m (larger for more than six: the same area for each) between 3 and 13 m of
/// height, from random starts to random goals, 3 m apart or more, among `obstacles` superellipsoids in random motion
/// that never come closer than 3 m to a start within the first 4 s; doc/scenarios.md gives the ranges. Throws
/// std::invalid_argument, too, if no such scenario is found.
Scenario movingObstacles(int uavs, int obstacles, std::uint64_t seed);

}  // namespace swarm_planner
