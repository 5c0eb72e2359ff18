// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "portable_numbers.hpp"
#include "swarm_planner/config/scenario.hpp"

namespace swarm_planner {

/// A UAV at rest at the start of a straight reference, which its target leaves at t = 0 with `speed` [m/s].
ScenarioUav straightUav(std::size_t number, const Vector3& start, const Vector3& goal, double speed);

/// Ends once all UAVs are within 0.2 m of their references' ends, after `timeout` [s] at most.
EndCondition allAtGoal(double timeout = 60.0);

/// "name", or "name_7" for seed 7: the files shipped are those of seed 0.
std::string seededName(const std::string& name, std::uint64_t seed);

/// On a horizontal circle about the z axis, to 1e-6 [m].
Vector3 onCircle(double radius, double angle, double z);

/// A point whose coordinates are uniform in [-most, most] each [m].
Vector3 randomOffset(double most, UniformRandom& random);

/// Draws until `accept` takes what `draw` gives; std::invalid_argument that names the `scenario` if it never does.
template <class Draw, class Accept>
auto drawn(const std::string& scenario, const Draw& draw, const Accept& accept) {
  constexpr int kMostDraws = 10000;
  for (int i = 0; i < kMostDraws; ++i) {
    const auto candidate = draw();
    if (accept(candidate)) return candidate;
  }
  throw std::invalid_argument(scenario + ": no place found for so many UAVs and obstacles");
}

/// The velocity of (19) [m/s], to 1e-6: `heading` and `climb` angle in rad.
Vector3 velocityTowards(double speed, double heading, double climb);

}  // namespace swarm_planner
