// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/config/tight_scenarios.hpp"

#include <array>
#include <stdexcept>

#include "portable_numbers.hpp"
#include "scenario_parts.hpp"

namespace swarm_planner {

namespace {

constexpr double kTargetSpeed = 4.0;  ///< [m/s] below max_speed: who gave way can catch up

void requireNumbers(const std::string& name, int uavs, double perturbation) {
  if (uavs >= 1 && perturbation >= 0.0) return;
  throw std::invalid_argument(name + ": expected at least one UAV and a perturbation >= 0");
}

/// A scenario that adds UAVs between places that are exact or, if its seed is not 0, a little off.
class Builder {
 public:
  Builder(const std::string& name, double perturbation, std::uint64_t seed)
      : random_(seed), perturbation_(seed == 0 ? 0.0 : perturbation) {
    scenario.name = seededName(name, seed);
    scenario.end = allAtGoal();
    scenario.overrides = {{"max_speed", 5.0}, {"max_acceleration", 10.0}};
  }

  void addUav(const Vector3& start, const Vector3& goal) {
    const Vector3 from = start + randomOffset(perturbation_, random_);
    const Vector3 to = goal + randomOffset(perturbation_, random_);
    scenario.uavs.push_back(straightUav(scenario.uavs.size() + 1, rounded(from), rounded(to), kTargetSpeed));
  }

  void addBox(const Vector3& center, const Vector3& radii, double exponent) {
    ScenarioObstacle box;
    box.id = static_cast<int>(scenario.obstacles.size()) + 1;
    box.center = rounded(center);
    box.radii = radii;
    box.exponents = Vector3::Constant(exponent);
    scenario.obstacles.push_back(box);
  }

  Scenario scenario;

 private:
  static Vector3 rounded(const Vector3& x) {
    return x.unaryExpr([](double c) { return roundedToMicro(c); });
  }

  UniformRandom random_;
  double perturbation_;
};

/// UAVs about the x axis: `columns` side by side, `layers` on top of each other, and then behind.
struct Block {
  int columns, layers;

  static constexpr double kSpacing = 2.0;  // [m]

  /// Of UAV `i`; that of the foremost has x = 0.
  Vector3 place(int i) const {
    const int column = i % columns;
    const int layer = i / columns % layers;
    const int rank = i / (columns * layers);
    return kSpacing * Vector3(-rank, column - 0.5 * (columns - 1), layer - 0.5 * (layers - 1));
  }
  /// From the foremost to the last of so many UAVs [m].
  double depth(int uavs) const { return -place(uavs - 1).x(); }
};

}  // namespace

Scenario gap(int uavs, double perturbation, std::uint64_t seed) {
  requireNumbers("gap", uavs, perturbation);
  constexpr double kMiddle = 3.5;       // height of the opening's middle [m]
  constexpr double kHalfOpening = 0.7;  // leaves a UAV 0.8 m x 0.8 m, less than two need
  constexpr double kHalfWall = 4.0;     // [m] each of the four slabs reaches beyond the workspace
  constexpr double kExponent = 10.0;
  Builder builder("gap", perturbation, seed);
  const Block block{4, 2};
  const double depth = block.depth(uavs);
  for (int i = 0; i < uavs; ++i) {
    const Vector3 place = block.place(i) + Vector3(0.0, 0.0, kMiddle);
    builder.addUav(place - Vector3(10.0, 0.0, 0.0), place + Vector3(10.0 + depth, 0.0, 0.0));
  }
  const double out = kHalfOpening + kHalfWall;
  for (const double side : {-out, out}) builder.addBox({0.0, side, kMiddle}, {0.5, kHalfWall, 6.0}, kExponent);
  for (const double side : {-out, out}) builder.addBox({0.0, 0.0, kMiddle + side}, {0.5, 8.0, kHalfWall}, kExponent);
  const double most_x = 15.0 + depth;
  builder.scenario.workspace = Workspace{{-most_x, -6.0, 0.5}, {most_x, 6.0, 6.5}};
  builder.scenario.overrides["uav_radius"] = 0.3;
  builder.scenario.overrides["pair_distance"] = 1.2;
  return builder.scenario;
}

Scenario boxHeadOn(int uavs, double perturbation, std::uint64_t seed) {
  requireNumbers("box_head_on", uavs, perturbation);
  struct Box {
    Vector3 radii;
    double exponent;
  };
  const std::array<Box, 4> boxes = {
      Box{{2.0, 2.0, 2.0}, 8.0}, {{1.0, 5.0, 3.0}, 8.0}, {{1.0, 3.0, 5.0}, 12.0}, {{4.0, 4.0, 4.0}, 16.0}};
  constexpr double kBetweenLanes = 16.0, kHalfLength = 20.0, kHeight = 10.0;  // [m]
  Builder builder("box_head_on", perturbation, seed);
  for (int i = 0; i < uavs; ++i) {
    const Vector3 middle(0.0, kBetweenLanes * i, kHeight);
    const Vector3 ahead(kHalfLength, 0.0, 0.0);
    builder.addUav(middle - ahead, middle + ahead);
    const Box& box = boxes[static_cast<std::size_t>(i) % boxes.size()];
    builder.addBox(middle, box.radii, box.exponent);
  }
  return builder.scenario;
}

Scenario uTrap(int uavs, double perturbation, std::uint64_t seed) {
  requireNumbers("u_trap", uavs, perturbation);
  constexpr double kMiddle = 3.0;                                             // height [m]
  constexpr double kHalfDepth = 5.0, kHalfWidth = 6.0, kHalfThickness = 0.5;  // of the U [m]
  constexpr double kHalfHeight = 5.0, kExponent = 10.0;                       // of its walls, beyond the workspace
  Builder builder("u_trap", perturbation, seed);
  const Block block{3, 1};
  const double depth = block.depth(uavs);
  for (int i = 0; i < uavs; ++i) {
    const Vector3 place = block.place(i) + Vector3(0.0, 0.0, kMiddle);
    builder.addUav(place - Vector3(20.0, 0.0, 0.0), place + Vector3(12.0 + depth, 0.0, 0.0));
  }
  builder.addBox({kHalfThickness, 0.0, kMiddle}, {kHalfThickness, kHalfWidth + 2.0 * kHalfThickness, kHalfHeight},
                 kExponent);
  for (const double side : {-kHalfWidth - kHalfThickness, kHalfWidth + kHalfThickness}) {
    builder.addBox({-kHalfDepth + kHalfThickness, side, kMiddle},
                   {kHalfDepth + kHalfThickness, kHalfThickness, kHalfHeight}, kExponent);
  }
  builder.scenario.workspace = Workspace{{-25.0 - depth, -14.0, 0.5}, {17.0 + depth, 14.0, 5.5}};
  builder.scenario.overrides["uav_radius"] = 0.3;
  builder.scenario.overrides["pair_distance"] = 1.2;
  return builder.scenario;
}

Scenario sameGoal(int uavs, double perturbation, std::uint64_t seed) {
  requireNumbers("same_goal", uavs, perturbation);
  constexpr double kRadius = 10.0, kHeight = 10.0;  // [m]
  const Vector3 middle(0.0, 0.0, kHeight);
  Builder builder("same_goal", perturbation, seed);
  builder.scenario.end = allAtGoal(40.0);
  for (int i = 0; i < uavs; ++i) {
    builder.addUav(onCircle(kRadius, 2.0 * kPi * i / uavs, kHeight), middle);
    builder.scenario.uavs.back().reference.back() = middle;
  }
  return builder.scenario;
}

}  // namespace swarm_planner
