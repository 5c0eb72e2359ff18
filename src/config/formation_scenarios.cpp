// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <cmath>
#include <stdexcept>

#include "portable_numbers.hpp"
#include "scenario_parts.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"

namespace swarm_planner {

Scenario crossing() {
  constexpr double kHalfLength = 40.0, kSpeed = 3.0;  // [m], [m/s]
  const Vector3 crossing_point(0.0, 0.0, 60.0);
  // Rational directions: the crossing point is exactly in the middle of each reference.
  const std::vector<Vector3> directions = {{1.0, 0.0, 0.0},   {0.0, 1.0, 0.0},  {-0.8, 0.6, 0.0},
                                           {-0.6, -0.8, 0.0}, {0.6, -0.8, 0.0}, {0.0, 0.0, 1.0}};
  Scenario scenario;
  scenario.name = "crossing";
  scenario.end = allAtGoal();
  for (const Vector3& direction : directions) {
    const Vector3 half = kHalfLength * direction;
    scenario.uavs.push_back(
        straightUav(scenario.uavs.size() + 1, crossing_point - half, crossing_point + half, kSpeed));
  }
  scenario.workspace = Workspace{{-60.0, -60.0, 0.5}, {60.0, 60.0, 120.0}};
  scenario.overrides = {{"max_speed", 5.0}, {"uav_radius", 0.3}, {"pair_distance", 2.0}};
  return scenario;
}

Scenario circleSwap(int uavs, double radius, std::uint64_t seed, double perturbation) {
  if (uavs < 1 || !(radius > 0.0) || !(perturbation >= 0.0)) {
    throw std::invalid_argument("a circle needs at least one UAV, a radius > 0 and a perturbation >= 0");
  }
  constexpr double kHeight = 10.0;  // [m] leaves room to pass above and below
  constexpr double kSpeed = 4.0;    // [m/s] below max_speed: who gave way can catch up
  Scenario scenario;
  scenario.name = seededName("circle_swap", seed);
  scenario.end = allAtGoal();
  UniformRandom random(seed);
  for (int i = 0; i < uavs; ++i) {
    const Vector3 offset = onCircle(radius, 2.0 * kPi * i / uavs, 0.0);
    Vector3 start = Vector3(0.0, 0.0, kHeight) + offset;
    Vector3 goal = Vector3(0.0, 0.0, kHeight) - offset;
    if (seed != 0) {
      start += randomOffset(perturbation, random);
      goal += randomOffset(perturbation, random);
    }
    scenario.uavs.push_back(straightUav(scenario.uavs.size() + 1, start, goal, kSpeed));
  }
  scenario.overrides = {{"max_speed", 5.0}, {"max_acceleration", 10.0}};
  return scenario;
}

}  // namespace swarm_planner
