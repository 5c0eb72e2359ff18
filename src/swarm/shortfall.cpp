// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/shortfall.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kStep = 0.05;  // [s]
constexpr double kHit = 0.5;    // of the distance to keep from a map: who comes nearer has hit it

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

/// By how much a motion falls short of the distance to keep from a map, moment by moment. Walls let nobody through: a
/// motion that hits one stays in it, whatever it would do beyond. One that begins there may leave.
class MapShortfall {
 public:
  explicit MapShortfall(const CheckSurroundings& surroundings) : surroundings_(surroundings) {}

  double at(const Vector3& p) {
    const double demanded = surroundings_.map_distance;
    if (surroundings_.map == nullptr) return 0.0;
    if (has_hit_) return demanded;
    const double found = surroundings_.map->distance(p, demanded);
    has_hit_ = was_free_ && found < kHit * demanded;
    was_free_ = was_free_ || found >= kHit * demanded;
    return has_hit_ ? demanded : demanded - found;
  }

 private:
  const CheckSurroundings& surroundings_;
  bool was_free_ = false;
  bool has_hit_ = false;
};

}  // namespace

double shortfall(const CommittedMotion& motion, double from, const CheckLimits& limits,
                 const CheckSurroundings& surroundings) {
  const auto steps = static_cast<int>(std::round(kShortfallTime / kStep));
  double sum = 0.0;
  MapShortfall map(surroundings);
  for (int i = 0; i < steps; ++i) {
    const double t = from + (i + 0.5) * kStep;
    const Vector3 p = motion.at(t).p;
    double worst = map.at(p);
    for (const PredictedObstacle& obstacle : surroundings.obstacles) {
      worst = std::max(worst, obstacleShortfall(p, t, obstacle));
    }
    for (const OtherMotion& other : surroundings.uavs) worst = std::max(worst, pairShortfall(p, t, other, limits));
    sum += kStep * worst;
  }
  return sum;
}

}  // namespace swarm_planner
