// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "tight_places.hpp"

#include <cmath>
#include <vector>

#include "perfect_flight.hpp"

namespace swarm_planner {

ScenarioObstacle box(const Vector3& center, const Vector3& radii) {
  ScenarioObstacle obstacle;
  obstacle.center = center;
  obstacle.radii = radii;
  obstacle.exponents = Vector3::Constant(8.0);
  return obstacle;
}

namespace {

/// A wall in the plane x = 0, of boxes, with an opening around y = 0 that fits one UAV; floor and ceiling leave no room
/// to pass above each other.
void addWall(double half_opening, Scenario& scenario) {
  for (int i = 0; i < 5; ++i) {
    for (const double side : {-1.0, 1.0}) {
      scenario.obstacles.push_back(box(Vector3(0.0, side * (half_opening + 2.0 + 4.0 * i), 5.0), Vector3(1, 2, 8)));
      scenario.obstacles.back().id = static_cast<int>(scenario.obstacles.size());
    }
  }
  scenario.workspace = Workspace{Vector3(-16, -20, 4), Vector3(16, 20, 6)};
}

}  // namespace

Mission throughTheOpening(int uavs) {
  std::vector<Vector3> starts;
  std::vector<Vector3> ends;
  for (int i = 0; i < uavs; ++i) {
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    starts.emplace_back(side * 8.0, -1.5 * (uavs / 2 - 1) + 3.0 * (i / 2), 5.0);
    ends.emplace_back(-side * 8.0, -1.5 * (uavs / 2 - 1) + 3.0 * (i / 2), 5.0);
  }
  Mission mission = makeTestMission(starts, ends, 3.0);
  addWall(1.0, mission.scenario);
  for (ScenarioUav& uav : mission.scenario.uavs) {
    const Vector3 before(std::copysign(2.5, uav.start.x()), 0.0, 5.0);
    const Vector3 behind(-before.x(), 0.0, 5.0);
    uav.reference = {uav.start, before, behind, uav.reference.back()};
  }
  return mission;
}

Mission headOnInALane() {
  Mission mission =
      makeTestMission({Vector3(-18, 0, 5), Vector3(18, 0, 5)}, {Vector3(18, 0, 5), Vector3(-18, 0, 5)}, 3.0);
  for (int i = 0; i < 6; ++i) {
    for (const double side : {-1.0, 1.0}) {
      mission.scenario.obstacles.push_back(box(Vector3(-10.0 + 4.0 * i, side * 2.8, 5.0), Vector3(2, 2, 8)));
      mission.scenario.obstacles.back().id = static_cast<int>(mission.scenario.obstacles.size());
    }
  }
  mission.scenario.workspace = Workspace{Vector3(-24, -4.7, 4.2), Vector3(24, 4.7, 5.8)};
  return mission;
}

}  // namespace swarm_planner
