// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/place_beside.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kRoom = 0.5;       // beyond the distance to keep: plans end not quite at rest [m]
constexpr double kStanding = 1e-3;  // slower obstacles stand [m/s]
/// No motion flown before has less than is demanded [m].
const Vector3 kNowhere = Vector3::Constant(1e6);

/// Unit vectors to the sides of an obstacle's way: right, left, up, down. Of one that stands: away from it, towards it,
/// up, down.
std::array<Vector3, 4> sidesOf(const Vector3& velocity, const Vector3& from) {
  const Vector3 ahead = velocity.norm() > kStanding ? velocity : from.cross(Vector3::UnitZ());
  Vector3 side = ahead.cross(Vector3::UnitZ());
  side = side.norm() > 1e-6 * ahead.norm() ? Vector3(side.normalized()) : Vector3(Vector3::UnitX());
  const Vector3 up = ahead.norm() > 0.0 ? Vector3(side.cross(ahead).normalized()) : Vector3(Vector3::UnitZ());
  return {side, -side, up, -up};
}

}  // namespace

std::optional<Vector3> placeBeside(const Vector3& place, std::size_t obstacle, double t, const CheckLimits& limits,
                                   const CheckSurroundings& surroundings) {
  const PredictedObstacle& predicted = surroundings.obstacles[obstacle];
  const Superellipsoid& body = *predicted.body;
  const double longest = t - predicted.stamp + limits.look_ahead;
  const double distance =
      predicted.least_distance + predicted.growth_rate * std::clamp(longest, 0.0, predicted.growth_time) + kRoom;
  const Vector3 relative = place - (body.center() + (t - predicted.stamp) * body.velocity());
  std::optional<Vector3> nearest;
  double least = 0.0;
  for (const Vector3& side : sidesOf(body.velocity(), relative)) {
    const double way = distance + body.halfExtents().dot(side.cwiseAbs()) - relative.dot(side);
    if (nearest && way >= least) continue;
    const Vector3 candidate = place + std::max(way, 0.0) * side;
    CommittedMotion rest;
    rest.assignRest(t, candidate);
    if (!checkClearance(rest, kNowhere, limits, surroundings).accepted()) continue;
    nearest = candidate;
    least = way;
  }
  return nearest;
}

}  // namespace swarm_planner
