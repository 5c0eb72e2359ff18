// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/surroundings.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {

Surroundings::Surroundings(const Parameters& parameters, std::size_t uav_count)
    : parameters_(parameters), motions_(uav_count), known_(uav_count, 0) {}

void Surroundings::setObstacles(const std::vector<TrackedObstacle>& tracks, double now, double epoch) {
  obstacles_.clear();
  for (const TrackedObstacle& track : tracks) {
    if (now - track.stamp > parameters_.input.track_timeout) continue;
    obstacles_.push_back(track.shape.movedBy(epoch - track.stamp));
  }
}

void Surroundings::clearUavs() { std::fill(known_.begin(), known_.end(), 0); }

void Surroundings::setPlan(std::size_t uav, const Trajectory& plan, double epoch) {
  predict(plan, epoch, parameters_.time.sampling_time, motions_[uav]);
  known_[uav] = 1;
}

void Surroundings::setResting(std::size_t uav, const Vector3& position) {
  predictResting(position, motions_[uav]);
  known_[uav] = 1;
}

void Surroundings::collect(std::size_t uav, UavProblem& problem) const {
  problem.bodies.clear();
  if (!parameters_.limits.avoidance) return;
  const double speed = std::max(problem.bounds.max_speed, problem.start.v.norm());
  const Vector3 extent = Vector3::Constant(speed * kHorizon * problem.dt);
  const Box reach{problem.start.p - extent, problem.start.p + extent};
  collectObstacles(reach, problem);
  collectUavs(uav, reach, problem);
}

void Surroundings::collectObstacles(const Box& reach, UavProblem& problem) const {
  const double level = std::exp(parameters_.cost.epsilon_s);
  const double distance = parameters_.limits.uav_radius + parameters_.limits.tracking_margin;
  // The robustness function reaches as far as S = r_b, at most sqrt(r_b) radii.
  const double halo = std::sqrt(parameters_.cost.robustness_outer) - 1.0;
  for (const Superellipsoid& obstacle : obstacles_) {
    MovingBody body = MovingBody::fromObstacle(obstacle, problem.dt, level, distance);
    if (!body.box().near(reach, halo * obstacle.halfExtents().maxCoeff())) continue;
    body.relieve(problem.start.p - obstacle.center(), parameters_.limits.tracking_margin);
    problem.bodies.push_back(body);
  }
}

void Surroundings::collectUavs(std::size_t uav, const Box& reach, UavProblem& problem) const {
  const LimitParameters& limits = parameters_.limits;
  for (std::size_t other = 0; other < motions_.size(); ++other) {
    if (other == uav || !known_[other]) continue;
    MovingBody body = MovingBody::fromUav(motions_[other], limits.pair_distance + limits.tracking_margin,
                                          limits.pair_distance_vertical + limits.tracking_margin,
                                          uav < other ? Vector3(Vector3::UnitX()) : Vector3(-Vector3::UnitX()));
    if (!body.box().near(reach, 0.0)) continue;
    body.relieve(problem.start.p - motions_[other].point(0, 0), limits.tracking_margin);
    problem.bodies.push_back(body);
  }
}

}  // namespace swarm_planner
