// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "portable_numbers.hpp"
#include "scenario_parts.hpp"
#include "swarm_planner/config/tight_scenarios.hpp"

namespace swarm_planner {

namespace {

constexpr double kAreaPerUav = 1.6;             ///< [m^2]
constexpr double kFloor = 0.1, kCeiling = 2.2;  ///< of the room [m]
constexpr double kSpeed = 1.5;                  ///< of UAVs and of their targets [m/s]
constexpr double kColumnRadius = 0.13;          ///< [m]
constexpr double kColumnsApart = 0.6;           ///< middle to middle, at least [m]
constexpr double kFromColumn = 0.36;            ///< of a start or goal from a column's middle, at least [m]
constexpr double kUavsApart = 0.4;              ///< of two starts or two goals, at least [m]
constexpr double kUavInset = 0.15;              ///< of starts and goals from the walls [m]
constexpr double kColumnInset = 0.35;           ///< of columns' middles from the walls [m]

/// Rounds to millimetres.
double roundedToMillimetre(double value) { return std::round(value * 1000.0) / 1000.0; }

Scenario emptyRoom(const std::string& family, int uavs, double half_side, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = family + "_" + std::to_string(uavs) + "_" + std::to_string(seed);
  scenario.end = allAtGoal();
  scenario.workspace = Workspace{{-half_side, -half_side, kFloor}, {half_side, half_side, kCeiling}};
  scenario.overrides = {{"max_speed", kSpeed},     {"uav_radius", 0.1},       {"pair_distance", 0.2},
                        {"max_thrust_ratio", 1.5}, {"min_thrust_ratio", 0.3}, {"pair_distance_vertical", 0.4}};
  return scenario;
}

Vector3 randomPlace(double most, double height, UniformRandom& random) {
  const double x = random.real(-most, most);
  return Vector3(x, random.real(-most, most), height);
}

bool isApart(const Vector3& point, const std::vector<Vector3>& others, double least) {
  return std::all_of(others.begin(), others.end(),
                     [&](const Vector3& other) { return (point - other).head<2>().norm() >= least; });
}

ScenarioObstacle column(int id, const Vector3& center) {
  ScenarioObstacle column;
  column.id = id;
  column.center = center;
  column.radii = Vector3(kColumnRadius, kColumnRadius, 5.0);
  column.exponents = Vector3(2.0, 2.0, 8.0);
  return column;
}

}  // namespace

Scenario denseRoom(int uavs, std::uint64_t seed) {
  if (uavs < 1) throw std::invalid_argument("dens: at least one UAV is needed");
  constexpr double kHeight = 0.5, kColumnHeight = 1.0;  // [m]
  const double half_side = roundedToMillimetre(0.5 * std::sqrt(kAreaPerUav * uavs));
  Scenario scenario = emptyRoom("dens", uavs, half_side, seed);
  UniformRandom random(seed);
  const auto columns = static_cast<int>(std::lround(kAreaPerUav * uavs));
  std::vector<Vector3> places, starts, goals;
  for (int id = 1; id <= columns; ++id) {
    places.push_back(drawn(
        scenario.name, [&] { return randomPlace(half_side - kColumnInset, kColumnHeight, random); },
        [&](const Vector3& place) { return isApart(place, places, kColumnsApart); }));
    scenario.obstacles.push_back(column(id, places.back()));
  }
  const auto draw = [&] { return randomPlace(half_side - kUavInset, kHeight, random); };
  for (int i = 0; i < uavs; ++i) {
    for (std::vector<Vector3>* taken : {&starts, &goals}) {
      taken->push_back(drawn(scenario.name, draw, [&](const Vector3& place) {
        return isApart(place, places, kFromColumn) && isApart(place, *taken, kUavsApart);
      }));
    }
    scenario.uavs.push_back(straightUav(starts.size(), starts.back(), goals.back(), kSpeed));
  }
  return scenario;
}

Scenario swapInRoom(int uavs, std::uint64_t seed) {
  if (uavs < 1) throw std::invalid_argument("swapj: at least one UAV is needed");
  constexpr double kFirstAngle = 0.1;                    // [rad]
  constexpr double kJitter = 0.12, kWallDistance = 0.5;  // [m]
  constexpr double kLowest = 0.8, kHighest = 1.2;        // [m]
  const double radius = std::sqrt(kAreaPerUav * uavs / kPi);
  Scenario scenario = emptyRoom("swapj", uavs, roundedToMillimetre(radius + kWallDistance), seed);
  UniformRandom random(seed);
  std::vector<Vector3> starts, goals;
  for (int i = 0; i < uavs; ++i) {
    const Vector3 middle = onCircle(radius, kFirstAngle + 2.0 * kPi * i / uavs, 0.0);
    const auto near = [&](const Vector3& place) {
      const double x = roundedToMicro(place.x() + random.real(-kJitter, kJitter));
      const double y = roundedToMicro(place.y() + random.real(-kJitter, kJitter));
      return Vector3(x, y, random.real(kLowest, kHighest));
    };
    const auto isFree = [&](const std::vector<Vector3>& taken) {
      return [&taken](const Vector3& place) { return isApart(place, taken, 0.3); };
    };
    starts.push_back(drawn(
        scenario.name, [&] { return near(middle); }, isFree(starts)));
    goals.push_back(drawn(
        scenario.name, [&] { return near(-middle); }, isFree(goals)));
    scenario.uavs.push_back(straightUav(starts.size(), starts.back(), goals.back(), kSpeed));
  }
  return scenario;
}

}  // namespace swarm_planner
