// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/surroundings.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {

Surroundings::Surroundings(const Parameters& parameters, std::size_t uav_count, std::size_t max_obstacles)
    : parameters_(parameters),
      horizontal_(parameters.limits.pair_distance + parameters.limits.tracking_margin),
      vertical_(parameters.limits.pair_distance_vertical + parameters.limits.tracking_margin),
      motions_(uav_count),
      known_(uav_count, 0),
      areas_(uav_count) {
  obstacles_.reserve(max_obstacles);
  neighbours_.reserve(uav_count);
}

void Surroundings::setObstacles(const std::vector<TrackedObstacle>& tracks, double epoch) {
  obstacles_.clear();
  for (const TrackedObstacle& track : tracks) {
    const double age = epoch - track.stamp;
    const TrackInflation inflation = inflationOf(track, parameters_.input);
    const double at_epoch = inflation.at(age);
    const DistanceGrowth growth{inflation.growth_rate * parameters_.time.sampling_time,
                                inflation.at(inflation.growth_time) - at_epoch};
    obstacles_.push_back({track.shape.movedBy(age), at_epoch, growth});
  }
}

void Surroundings::setUnknown(std::size_t uav) {
  known_[uav] = 0;
  areas_[uav] = Box();
}

void Surroundings::setPlan(std::size_t uav, const Trajectory& plan, double epoch) {
  predict(plan, epoch, parameters_.time.sampling_time, motions_[uav]);
  known_[uav] = 1;
  areas_[uav] = motions_[uav].box;
}

void Surroundings::setLastPlan(std::size_t uav, const Trajectory& plan, double epoch) {
  predictToRest(plan, epoch, parameters_.time.sampling_time, motions_[uav]);
  known_[uav] = 1;
  areas_[uav] = motions_[uav].box;
}

void Surroundings::setResting(std::size_t uav, const Vector3& position) {
  predictResting(position, motions_[uav]);
  known_[uav] = 1;
  areas_[uav] = motions_[uav].box;
}

void Surroundings::setPlanning(std::size_t uav, const KinematicState& start) {
  const Box box = reach(start);
  areas_[uav].include(box.min);
  areas_[uav].include(box.max);
}

void Surroundings::findNeighbours() {
  const Vector3 half = 0.5 * Vector3(horizontal_, horizontal_, vertical_);
  for (Box& area : areas_) {
    area.min -= half;
    area.max += half;
  }
  neighbours_.build(areas_);
}

Box Surroundings::reach(const KinematicState& start) const {
  const double speed = std::max(parameters_.limits.max_speed, start.v.norm());
  const Vector3 extent = Vector3::Constant(speed * kHorizon * parameters_.time.sampling_time);
  return {start.p - extent, start.p + extent};
}

void Surroundings::collect(std::size_t uav, UavProblem& problem) const {
  problem.bodies.clear();
  if (!parameters_.limits.avoidance) return;
  const Box box = reach(problem.start);
  collectObstacles(box, problem);
  collectUavs(uav, box, problem);
}

void Surroundings::collectObstacles(const Box& reach, UavProblem& problem) const {
  const double level = std::exp(parameters_.cost.epsilon_s);
  const double distance = parameters_.limits.uav_radius + parameters_.limits.tracking_margin;
  // The robustness function reaches as far as S = r_b, at most sqrt(r_b) radii.
  const double halo = std::sqrt(parameters_.cost.robustness_outer) - 1.0;
  for (const PredictedTrack& track : obstacles_) {
    const Superellipsoid& obstacle = track.shape;
    MovingBody body = MovingBody::fromObstacle(obstacle, problem.dt, level, distance + track.inflation, track.growth);
    if (!body.box().near(reach, halo * obstacle.halfExtents().maxCoeff())) continue;
    body.relieve(problem.start.p - obstacle.center(), parameters_.limits.tracking_margin);
    body.setIdentity(2 * static_cast<std::uint32_t>(obstacle.id()));
    problem.bodies.push_back(body);
  }
}

void Surroundings::collectUavs(std::size_t uav, const Box& reach, UavProblem& problem) const {
  for (const std::uint32_t other : neighbours_.of(uav)) {
    const PredictedMotion& motion = motions_[other];
    if (!known_[other] || !motion.box.near(reach, std::max(horizontal_, vertical_))) continue;
    MovingBody body = MovingBody::fromUav(motion, horizontal_, vertical_,
                                          uav < other ? Vector3(Vector3::UnitX()) : Vector3(-Vector3::UnitX()));
    body.relieve(problem.start.p - motion.point(0, 0), parameters_.limits.tracking_margin);
    body.setIdentity(2 * other + 1);
    problem.bodies.push_back(body);
  }
}

}  // namespace swarm_planner
