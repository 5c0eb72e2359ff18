// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/flight_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "swarm_planner/experiments/shortest_path.hpp"
#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {
namespace {

/// Greatest a for which a * direction + gravity is within the greatest thrust, and within max_acceleration [m/s^2].
double greatestAcceleration(const Vector3& direction, const Parameters& parameters) {
  const double gravity = parameters.vehicle.gravity;
  const double ratio = parameters.limits.max_thrust_ratio;
  const double z = direction.z();
  return std::min(parameters.limits.max_acceleration, gravity * (std::sqrt(z * z + ratio * ratio - 1.0) - z));
}

/// Around everything that matters, with room to fly round it; the workspace if there is one.
Workspace flightBox(const Mission& mission, const std::vector<Superellipsoid>& obstacles) {
  if (mission.scenario.workspace) return *mission.scenario.workspace;
  Workspace box{mission.scenario.uavs.front().start, mission.scenario.uavs.front().start};
  const auto include = [&box](const Vector3& p, const Vector3& half_extents) {
    box.min = box.min.cwiseMin(p - half_extents);
    box.max = box.max.cwiseMax(p + half_extents);
  };
  for (const ScenarioUav& uav : mission.scenario.uavs) {
    include(uav.start, Vector3::Zero());
    for (const Vector3& corner : uav.reference) include(corner, Vector3::Zero());
  }
  for (const Superellipsoid& obstacle : obstacles) include(obstacle.center(), obstacle.halfExtents());
  if (mission.map != nullptr && mission.map->occupiedCount() > 0) {
    include(mission.map->bounds().min, Vector3::Zero());
    include(mission.map->bounds().max, Vector3::Zero());
  }
  const Vector3 room = Vector3::Constant(4.0 * mission.parameters.limits.uav_radius);
  return {box.min - room, box.max + room};
}

std::vector<Superellipsoid> standingObstacles(const Scenario& scenario) {
  std::vector<Superellipsoid> standing;
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    if (obstacle.velocity.isZero(0.0)) standing.push_back(makeObstacle(obstacle));
  }
  return standing;
}

/// Half a UAV's radius, or as wide as makes three million cells.
double cellWidth(const Workspace& box, double radius) {
  constexpr double kMostCells = 3e6;
  return std::max(0.5 * radius, std::cbrt((box.max - box.min).prod() / kMostCells));
}

std::optional<double> shortestPath(const ScenarioUav& uav, const FreeSpace& space, ShortestPath& search) {
  const std::vector<Vector3> corners = ReferencePath(uav.reference).points();
  if (!space.isFree(uav.start) || !space.isFree(corners.back())) return std::nullopt;
  double length = 0.0;
  Vector3 from = uav.start;
  for (const Vector3& corner : corners) {
    if (!space.isFree(corner)) continue;
    const std::vector<Vector3> leg = search.find(from, corner);
    if (leg.empty()) return std::nullopt;
    length += lengthOf(leg);
    from = corner;
  }
  return length;
}

}  // namespace

double leastTime(const Vector3& way, const Parameters& parameters) {
  const double length = way.norm();
  if (length == 0.0) return 0.0;
  const double up = greatestAcceleration(way / length, parameters);
  const double down = greatestAcceleration(-way / length, parameters);
  const double speed = parameters.limits.max_speed;
  const double ramp = 0.5 * (1.0 / up + 1.0 / down);  // speeding up and slowing down take speed^2 ramp of way
  if (length >= speed * speed * ramp) return length / speed + speed * ramp;
  return 2.0 * std::sqrt(length * ramp);
}

std::vector<FlightBound> flightBounds(const Mission& mission, bool with_paths) {
  std::vector<FlightBound> bounds;
  for (const ScenarioUav& uav : mission.scenario.uavs) {
    bounds.push_back({leastTime(uav.reference.back() - uav.start, mission.parameters), std::nullopt});
  }
  if (!with_paths) return bounds;
  std::vector<Superellipsoid> standing = standingObstacles(mission.scenario);
  const double radius = mission.parameters.limits.uav_radius;
  const Workspace box = flightBox(mission, standing);
  const FreeSpace space(std::move(standing), radius, box, mission.map);
  ShortestPath search(space, cellWidth(box, radius));
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    bounds[i].shortest_path = shortestPath(mission.scenario.uavs[i], space, search);
  }
  return bounds;
}

}  // namespace swarm_planner
