// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/shortfall.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kStep = 0.05;  // [s]

double obstacleShortfall(const Vector3& p, double t, const PredictedObstacle& obstacle) {
  if (t > obstacle.valid_until) return 0.0;
  const double age = t - obstacle.stamp;
  const double least = obstacle.least_distance + obstacle.growth_rate * std::clamp(age, 0.0, obstacle.growth_time);
  const Superellipsoid& body = *obstacle.body;
  const Vector3 relative = p - age * body.velocity() - body.center();
  if (((relative.cwiseAbs() - body.halfExtents()).array() > least).any()) return 0.0;
  return least - body.signedDistance(body.center() + relative);
}

double pairShortfall(const Vector3& p, double t, const OtherMotion& other, const CheckLimits& limits) {
  if (t > other.valid_until) return 0.0;
  const Vector3 d = p - other.motion->at(t).p;
  const double horizontal = limits.pair_horizontal + other.doubt.at(t);
  const double vertical = limits.pair_vertical + other.doubt.at(t);
  const Vector3 scaled(d.x() / horizontal, d.y() / horizontal, d.z() / vertical);
  return (1.0 - scaled.norm()) * std::min(horizontal, vertical);
}

}  // namespace

double shortfall(const CommittedMotion& motion, double from, const CheckLimits& limits,
                 const CheckSurroundings& surroundings) {
  const auto steps = static_cast<int>(std::round(kShortfallTime / kStep));
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = from + (i + 0.5) * kStep;
    const Vector3 p = motion.at(t).p;
    double worst = 0.0;
    if (surroundings.map != nullptr) {
      worst = surroundings.map_distance - surroundings.map->distance(p, surroundings.map_distance);
    }
    for (const PredictedObstacle& obstacle : surroundings.obstacles) {
      worst = std::max(worst, obstacleShortfall(p, t, obstacle));
    }
    for (const OtherMotion& other : surroundings.uavs) worst = std::max(worst, pairShortfall(p, t, other, limits));
    sum += kStep * worst;
  }
  return sum;
}

}  // namespace swarm_planner
