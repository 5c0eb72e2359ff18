// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/random_missions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {
namespace {

constexpr double kReached = 1.0;     // from the goal [m]
constexpr double kPatience = 30.0;   // before a goal is given up [s]
constexpr double kLeastWay = 10.0;   // to a new goal [m]
constexpr double kSpeedShare = 0.7;  // of max_speed, so that who gave way can catch up
constexpr int kMostDraws = 100;      // then the last goal drawn has to do

/// Until the obstacle is as far behind the middle of the field as it began before it [s].
double periodOf(const Superellipsoid& obstacle, const Workspace& field) {
  const double speed_squared = obstacle.velocity().squaredNorm();
  const Vector3 way = 0.5 * (field.min + field.max) - obstacle.center();
  const double to_middle = speed_squared > 0.0 ? way.dot(obstacle.velocity()) / speed_squared : 0.0;
  return to_middle > 0.0 ? 2.0 * to_middle : std::numeric_limits<double>::infinity();
}

/// The obstacle where, on its way, it is nearest to `point`.
Superellipsoid abreast(const Superellipsoid& obstacle, const Vector3& point) {
  const double speed_squared = obstacle.velocity().squaredNorm();
  if (speed_squared == 0.0) return obstacle;
  return obstacle.movedBy((point - obstacle.center()).dot(obstacle.velocity()) / speed_squared);
}

}  // namespace

RandomMissions::RandomMissions(const Mission& mission, const Workspace& field, SwarmCyclePlanner& planner,
                               std::uint64_t seed)
    : field_(field),
      planner_(planner),
      random_(streamSeed(seed, RandomUse::kMissions)),
      speed_(kSpeedShare * mission.parameters.limits.max_speed),
      apart_(mission.parameters.limits.pair_distance + 2.0 * mission.parameters.limits.pair_margin),
      clearance_(mission.parameters.limits.uav_radius + 2.0 * mission.parameters.limits.tracking_margin),
      legs_(mission.scenario.uavs.size()) {
  for (const ScenarioObstacle& obstacle : mission.scenario.obstacles) {
    const Superellipsoid shape = makeObstacle(obstacle);
    obstacles_.push_back(shape);
    periods_.push_back(periodOf(shape, field));
  }
  for (std::size_t i = 0; i < legs_.size(); ++i) legs_[i].goal = mission.scenario.uavs[i].start;
}

void RandomMissions::beforeCycle(double now, const std::vector<QuadSimulator>& vehicles, bool restarted) {
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    Leg& leg = legs_[i];
    const Vector3& position = vehicles[i].state().p;
    const bool reached = leg.given && (position - leg.goal).norm() < kReached;
    const bool is_over = !leg.given || reached || now - leg.begin > kPatience;
    if (is_over) {
      if (leg.given) ++(reached ? leg.flown : leg.abandoned);
      leg.goal = drawGoal(i, position);
      leg.begin = now;
      leg.given = true;
    }
    if (is_over || restarted) planner_.setReference(i, {position, leg.goal}, 0.0, speed_);
  }
}

Vector3 RandomMissions::drawGoal(std::size_t uav, const Vector3& position) {
  Vector3 goal;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    for (int axis = 0; axis < 3; ++axis) {
      goal[axis] = field_.min[axis] + (field_.max[axis] - field_.min[axis]) * random_.nextUniform();
    }
    if ((goal - position).norm() >= kLeastWay && isFree(goal, uav)) break;
  }
  return goal;
}

bool RandomMissions::isFree(const Vector3& goal, std::size_t uav) const {
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    if (i != uav && (legs_[i].goal - goal).norm() < apart_) return false;
  }
  return std::all_of(obstacles_.begin(), obstacles_.end(), [&](const Superellipsoid& obstacle) {
    return abreast(obstacle, goal).signedDistance(goal) >= clearance_;
  });
}

double RandomMissions::obstacleTime(std::size_t index, double t) const {
  return t > periods_[index] ? std::fmod(t, periods_[index]) : t;
}

std::size_t RandomMissions::flown() const {
  std::size_t count = 0;
  for (const Leg& leg : legs_) count += leg.flown;
  return count;
}

std::size_t RandomMissions::fewestFlown() const {
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const Leg& leg : legs_) fewest = std::min(fewest, leg.flown);
  return fewest;
}

std::size_t RandomMissions::abandoned() const {
  std::size_t count = 0;
  for (const Leg& leg : legs_) count += leg.abandoned;
  return count;
}

}  // namespace swarm_planner
