// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "portable_numbers.hpp"
#include "scenario_parts.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"

namespace swarm_planner {

namespace {

constexpr const char* kName = "moving_obstacles";
constexpr double kFieldSide = 30.0;                     ///< of the field for up to six UAVs [m]
constexpr double kFloor = 3.0, kCeiling = 13.0;         ///< of the field [m]
constexpr double kTargetSpeed = 3.0;                    ///< [m/s] below max_speed: who gave way can catch up
constexpr double kApart = 3.0;                          ///< of two starts or two goals: pair_distance and some [m]
constexpr double kLeastWay = 15.0;                      ///< from start to goal [m]
constexpr double kQuietDistance = 3.0;                  ///< around a start, at first without obstacles [m]
constexpr double kQuietTime = 4.0;                      ///< for so long [s]
constexpr double kFirstVisit = 4.0, kLastVisit = 14.0;  ///< when an obstacle's centre is inside the field [s]
constexpr double kMostClimb = kPi / 12.0;               ///< of an obstacle's motion [rad]

/// Where UAVs fly and obstacles pass.
class Field {
 public:
  explicit Field(int uavs) : side_(roundedToMicro(kFieldSide * std::sqrt(std::max(1.0, uavs / 6.0)))) {}

  double side() const { return side_; }
  Vector3 point(UniformRandom& random) const {
    const double x = random.real(0.0, side_);
    const double y = random.real(0.0, side_);
    return Vector3(x, y, random.real(kFloor, kCeiling));
  }

 private:
  double side_;
};

bool isApart(const Vector3& point, const std::vector<Vector3>& others) {
  return std::all_of(others.begin(), others.end(),
                     [&point](const Vector3& other) { return (point - other).norm() >= kApart; });
}

/// Least distance of the obstacle's centre from a point during the first kQuietTime [m].
double leastDistance(const ScenarioObstacle& obstacle, const Vector3& point) {
  const Vector3 away = point - obstacle.center;
  const double nearest = std::clamp(away.dot(obstacle.velocity) / obstacle.velocity.squaredNorm(), 0.0, kQuietTime);
  return (away - nearest * obstacle.velocity).norm();
}

bool leavesInPeace(const ScenarioObstacle& obstacle, const std::vector<Vector3>& starts) {
  // Whatever its exponents, it lies within the box of its radii.
  const double least = obstacle.radii.norm() + kQuietDistance;
  return std::all_of(starts.begin(), starts.end(),
                     [&](const Vector3& start) { return leastDistance(obstacle, start) >= least; });
}

ScenarioObstacle passingObstacle(int id, const Field& field, UniformRandom& random) {
  ScenarioObstacle obstacle;
  obstacle.id = id;
  for (int axis = 0; axis < 3; ++axis) obstacle.radii[axis] = random.real(0.5, 2.0);
  for (int axis = 0; axis < 3; ++axis) obstacle.exponents[axis] = random.real(2.0, 8.0);
  obstacle.yaw = random.real(-kPi, kPi);
  const double speed = random.real(0.3, 2.0);
  const double heading = random.real(-kPi, kPi);
  obstacle.velocity = velocityTowards(speed, heading, random.real(-kMostClimb, kMostClimb));
  const Vector3 visited = field.point(random);
  const double visit = random.real(kFirstVisit, kLastVisit);
  obstacle.center = (visited - visit * obstacle.velocity).unaryExpr([](double x) { return roundedToMicro(x); });
  return obstacle;
}

}  // namespace

Scenario movingObstacles(int uavs, int obstacles, std::uint64_t seed) {
  if (uavs < 1 || obstacles < 1)
    throw std::invalid_argument("moving_obstacles needs at least one UAV and one obstacle");
  constexpr double kMargin = 15.0;  // [m] around the field: room to dodge
  UniformRandom random(seed);
  const Field field(uavs);
  Scenario scenario;
  scenario.name = std::string(kName) + "_" + std::to_string(seed);
  scenario.end = allAtGoal();
  const auto point = [&] { return field.point(random); };
  std::vector<Vector3> starts, goals;
  for (int i = 0; i < uavs; ++i) {
    starts.push_back(drawn(kName, point, [&](const Vector3& start) { return isApart(start, starts); }));
    goals.push_back(drawn(kName, point, [&](const Vector3& goal) {
      return isApart(goal, goals) && (goal - starts.back()).norm() >= kLeastWay;
    }));
    scenario.uavs.push_back(straightUav(starts.size(), starts.back(), goals.back(), kTargetSpeed));
  }
  for (int id = 1; id <= obstacles; ++id) {
    scenario.obstacles.push_back(drawn(
        kName, [&] { return passingObstacle(id, field, random); },
        [&](const ScenarioObstacle& one) { return leavesInPeace(one, starts); }));
  }
  scenario.workspace =
      Workspace{{-kMargin, -kMargin, 0.5}, {field.side() + kMargin, field.side() + kMargin, kCeiling + kMargin}};
  scenario.overrides = {{"max_speed", 5.0}, {"max_acceleration", 10.0}};
  return scenario;
}

}  // namespace swarm_planner
