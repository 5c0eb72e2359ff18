// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "check_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obstacles/random_bodies.hpp"

namespace swarm_planner {
namespace {

constexpr double kSample = 1e-3;  // [s]
constexpr double kEpoch = 1e6;    // [s]
constexpr double kDeep = -0.3;    // how much worse it gets after that does not matter [m]

Trajectory randomPlan(Random& random, double speed, double epoch) {
  const KinematicState start{random.vector(-3.0, 3.0), random.uniform(0.0, speed) * random.direction(),
                             random.uniform(0.0, 1.0) * random.direction()};
  return wanderingPlan(random, start, 2.0, epoch, random.integer(0, 1) == 0 ? 0.15 : 0.3);
}

StopManoeuvre stopOf(const Trajectory& plan, const FlightBounds& bounds) {
  StopManoeuvre stop;
  planStop(plan.knots.back(), plan.dt, bounds, stop);
  return stop;
}

/// Exponents of 2 to 10: equal, small integers or real.
Vector3 exponents(Random& random) {
  if (random.integer(0, 3) == 0) return Vector3::Constant(random.integer(2, 10));
  if (random.integer(0, 2) == 0) return Vector3(random.integer(2, 10), random.integer(2, 10), random.integer(2, 10));
  return random.vector(2.0, 10.0);
}

}  // namespace

CheckLimits defaultCheckLimits() {
  CheckLimits limits;
  limits.bounds = FlightBounds(Parameters(), nullptr);
  limits.pair_horizontal = 2.2;
  limits.pair_vertical = 2.2;
  return limits;
}

void CheckScene::plan(const Trajectory& given) {
  trajectory = given;
  start = given.knots[0];
  motion.assign(given, stopOf(given, limits.bounds));
}

void CheckScene::planRandomly(Random& random, double speed) { plan(randomPlan(random, speed, kEpoch)); }

void CheckScene::addObstacle(const Superellipsoid& body) {
  bodies.push_back(body);
  PredictedObstacle obstacle;
  obstacle.body = &bodies.back();
  obstacle.stamp = motion.epoch();
  obstacle.least_distance = 0.5;
  surroundings.obstacles.push_back(obstacle);
}

void CheckScene::addRandomObstacle(Random& random, double clearance) {
  const Vector3 radii(random.logUniform(0.02, 6.0), random.logUniform(0.02, 6.0), random.logUniform(0.02, 6.0));
  const Vector3 velocity = random.integer(0, 1) == 0 ? Vector3(Vector3::Zero()) : random.vector(-1.5, 1.5);
  const Superellipsoid shape(1, Vector3::Zero(), radii, exponents(random), random.uniform(-M_PI, M_PI), velocity);
  const Vector3 foot = randomOffset(random, shape, 1.0);
  const Vector3 relative = foot + clearance * shape.gauge(foot).gradient.normalized();
  // Time is in seconds after the epoch; late ones meet the UAV at rest.
  const double time = random.uniform(0.0, motion.duration() + 3.0);
  const double age = random.uniform(0.0, 1.0);
  const Vector3 center = motion.after(time).p - relative - (time + age) * velocity;
  addObstacle(Superellipsoid(1, center, radii, shape.exponents(), shape.yaw(), velocity));
  PredictedObstacle& obstacle = surroundings.obstacles.back();
  obstacle.stamp -= age;
  obstacle.growth_rate = random.integer(0, 1) == 0 ? 0.0 : random.uniform(0.0, 0.05);
  if (random.integer(0, 1) == 0) obstacle.growth_time = random.uniform(0.0, 5.0);
}

void CheckScene::addUav(const Trajectory& plan) {
  CommittedMotion other;
  other.assign(plan, stopOf(plan, limits.bounds));
  addMotion(other);
}

void CheckScene::addMotion(const CommittedMotion& other, double valid_until) {
  others.push_back(other);
  surroundings.uavs.push_back({&others.back(), valid_until});
}

void CheckScene::addRandomUav(Random& random, double gauge) {
  const double lag = random.integer(0, 2) == 0 ? 0.0 : random.uniform(-0.5, 4.0);
  Trajectory plan = randomPlan(random, 4.0, motion.epoch() - lag);
  CommittedMotion other;
  other.assign(plan, stopOf(plan, limits.bounds));
  const double time = random.uniform(0.0, motion.duration() + 1.0);
  const Vector3 scaled = gauge * random.direction();
  const Vector3 apart(scaled.x() * limits.pair_horizontal, scaled.y() * limits.pair_horizontal,
                      scaled.z() * limits.pair_vertical);
  KinematicState moved = plan.knots[0];
  moved.p += motion.after(time).p + apart - other.after(time + lag).p;
  rollOut(moved, plan);
  addUav(plan);
}

SampledSlack sampledObstacleSlack(const CheckScene& scene, const PredictedObstacle& obstacle) {
  const CommittedMotion& motion = scene.motion;
  const double age = motion.epoch() - obstacle.stamp;
  const auto demanded = [&](double time) {
    return obstacle.least_distance + obstacle.growth_rate * std::min(time + age, obstacle.growth_time);
  };
  // As the obstacle sees it, which then stands still.
  const auto relativePlace = [&](double time) {
    return Vector3(motion.after(time).p - (time + age) * obstacle.body->velocity());
  };
  const double before =
      obstacle.body->signedDistance(scene.committed - age * obstacle.body->velocity()) - demanded(0.0);
  const bool starts_within = obstacle.body->signedDistance(relativePlace(0.0)) < demanded(0.0);
  const double waived = starts_within ? std::min(before, 0.0) : 0.0;
  SampledSlack result{std::numeric_limits<double>::infinity(), 0.0, waived < 0.0};
  const bool stands = obstacle.body->velocity().isZero(0.0) && obstacle.growth_rate == 0.0;
  const double end =
      std::min(motion.duration() + (stands ? kSample : scene.limits.look_ahead), obstacle.valid_until - motion.epoch());
  // Coarse steps first: most of the fine ones then cannot find less. Each stride goes on with what is known.
  for (const int stride : {64, 8, 1}) {
    double known_distance = -std::numeric_limits<double>::infinity();
    Vector3 known_place = Vector3::Zero();
    for (int n = 0; n * kSample <= end && result.slack > kDeep; n += stride) {
      const double time = n * kSample;
      const Vector3 place = relativePlace(time);
      const double reach = result.slack + waived + demanded(time);
      // Far away the box about the body will do; and no distance changes by more than what has been moved.
      if (obstacle.body->distanceLowerBound(place) > reach) continue;
      if (known_distance - (place - known_place).norm() > reach) continue;
      known_distance = obstacle.body->signedDistance(place);
      known_place = place;
      const double slack = known_distance - demanded(time) - waived;
      if (slack < result.slack) {
        result.slack = slack;
        result.time = time;
      }
    }
  }
  return result;
}

SampledSlack sampledPairSlack(const CheckScene& scene, const OtherMotion& entry) {
  const CommittedMotion& other = *entry.motion;
  const double horizontal = scene.limits.pair_horizontal;
  const double vertical = scene.limits.pair_vertical;
  const double lag = scene.motion.epoch() - other.epoch();
  const auto apart = [&](double time) { return Vector3(scene.motion.after(time).p - other.after(time + lag).p); };
  const auto gauge = [&](const Vector3& d, double extra) {
    return std::sqrt(d.head<2>().squaredNorm() / std::pow(horizontal + extra, 2) +
                     d.z() * d.z() / std::pow(vertical + extra, 2));
  };
  // What `d` lacks of the least semi-axes, negative; 0 if nothing.
  const auto lackOf = [&](const Vector3& d) {
    if (gauge(d, 0.0) >= 1.0) return 0.0;
    double too_much = 0.0;
    double has = 1e-3 - std::min(horizontal, vertical);
    while (too_much - has > 1e-9) {
      const double middle = 0.5 * (has + too_much);
      (gauge(d, middle) < 1.0 ? too_much : has) = middle;
    }
    return has;
  };
  const double waived = gauge(apart(0.0), 0.0) < 1.0 ? lackOf(scene.committed - other.after(lag).p) : 0.0;
  SampledSlack result{std::numeric_limits<double>::infinity(), 0.0, waived < 0.0};
  const double end = std::min(std::max(scene.motion.duration(), other.duration() - lag) + kSample,
                              entry.valid_until - scene.motion.epoch());
  for (double time = 0.0; time <= end && result.slack > kDeep; time += kSample) {
    const double extra = waived + entry.doubt.at(scene.motion.epoch() + time);
    const double slack = (gauge(apart(time), extra) - 1.0) * (std::min(horizontal, vertical) + extra);
    if (slack < result.slack) {
      result.slack = slack;
      result.time = time;
    }
  }
  return result;
}

SampledSlack sampledSlack(const CheckScene& scene) {
  SampledSlack least{std::numeric_limits<double>::infinity(), 0.0, false};
  const auto include = [&least](const SampledSlack& slack) {
    const bool waived = least.waived || slack.waived;
    if (slack.slack < least.slack) least = slack;
    least.waived = waived;
  };
  for (const PredictedObstacle& obstacle : scene.surroundings.obstacles) include(sampledObstacleSlack(scene, obstacle));
  for (const OtherMotion& other : scene.surroundings.uavs) include(sampledPairSlack(scene, other));
  return least;
}

}  // namespace swarm_planner
