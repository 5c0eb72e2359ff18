// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "portable_numbers.hpp"
#include "scenario_parts.hpp"
#include "swarm_planner/config/tight_scenarios.hpp"

namespace swarm_planner {

namespace {

/// What is on the ground, seen from above.
struct Wood {
  int trees;
  double least_radius, most_radius;  ///< of a tree [m]
  double gap;                        ///< between two trees at least, if they leave one [m]
  double clearing;                   ///< around starts and goals [m]
  double half_side;                  ///< of the square that trees stand in [m]
  double reach;                      ///< from the middle at most [m]
};

/// From below the ground to above every workspace: nobody passes over or under it.
ScenarioObstacle tree(int id, double radius, double x, double y) {
  constexpr double kMiddle = 2.0, kHalfHeight = 6.0;  // [m]
  ScenarioObstacle tree;
  tree.id = id;
  tree.center = Vector3(x, y, kMiddle);
  tree.radii = Vector3(radius, radius, kHalfHeight);
  tree.exponents = Vector3(2.0, 2.0, 8.0);
  return tree;
}

/// Horizontal distance from a tree's surface [m].
double distanceFrom(const ScenarioObstacle& tree, const Vector3& point) {
  return (point - tree.center).head<2>().norm() - tree.radii.x();
}

bool fits(const ScenarioObstacle& tree, const Scenario& scenario, const Wood& wood) {
  if (tree.center.head<2>().norm() > wood.reach) return false;
  const bool leaves_gaps =
      std::all_of(scenario.obstacles.begin(), scenario.obstacles.end(), [&](const ScenarioObstacle& other) {
        const double between = distanceFrom(other, tree.center) - tree.radii.x();
        return between <= 0.0 || between >= wood.gap;
      });
  return leaves_gaps && std::all_of(scenario.uavs.begin(), scenario.uavs.end(), [&](const ScenarioUav& uav) {
           return distanceFrom(tree, uav.start) >= wood.clearing &&
                  distanceFrom(tree, uav.reference.back()) >= wood.clearing;
         });
}

void plant(const Wood& wood, std::uint64_t seed, Scenario& scenario) {
  UniformRandom random(seed);
  const auto draw = [&] {
    const double radius = random.real(wood.least_radius, wood.most_radius);
    const double x = random.real(-wood.half_side, wood.half_side);
    const double y = random.real(-wood.half_side, wood.half_side);
    return tree(static_cast<int>(scenario.obstacles.size()) + 1, radius, x, y);
  };
  for (int i = 0; i < wood.trees; ++i) {
    scenario.obstacles.push_back(
        drawn(scenario.name, draw, [&](const ScenarioObstacle& tree) { return fits(tree, scenario, wood); }));
  }
}

/// `uavs` UAVs on a circle, whose targets go straight to the opposite side.
Scenario antipodes(const std::string& name, int uavs, double radius, double height, double speed) {
  if (uavs < 1) throw std::invalid_argument(name + ": at least one UAV is needed");
  Scenario scenario;
  scenario.name = name;
  scenario.end = allAtGoal();
  for (int i = 0; i < uavs; ++i) {
    const Vector3 start = onCircle(radius, 2.0 * kPi * i / uavs, height);
    scenario.uavs.push_back(
        straightUav(scenario.uavs.size() + 1, start, Vector3(-start.x(), -start.y(), height), speed));
  }
  return scenario;
}

}  // namespace

Scenario forest(int uavs, double gap, std::uint64_t seed) {
  if (!(gap >= 0.0)) throw std::invalid_argument("forest: expected a gap >= 0");
  Scenario scenario = antipodes(seededName("forest", seed), uavs, 22.0, 2.5, 4.0);
  plant({90, 0.2, 0.5, gap, 1.0, 15.0, 30.0}, seed, scenario);
  scenario.workspace = Workspace{{-25.0, -25.0, 0.5}, {25.0, 25.0, 5.0}};
  scenario.overrides = {{"max_speed", 5.0}, {"max_acceleration", 10.0}, {"uav_radius", 0.3}, {"pair_distance", 0.6}};
  return scenario;
}

Scenario smallForest(int uavs, std::uint64_t seed) {
  Scenario scenario = antipodes(seededName("small_forest", seed), uavs, 4.0, 1.0, 0.8);
  plant({10, 0.15, 0.3, 0.5, 0.5, 3.0, 3.0}, seed, scenario);
  scenario.workspace = Workspace{{-5.0, -5.0, 0.2}, {5.0, 5.0, 2.5}};
  scenario.overrides = {{"max_speed", 1.0}, {"max_acceleration", 2.0}, {"uav_radius", 0.15}, {"pair_distance", 0.3}};
  return scenario;
}

}  // namespace swarm_planner
