// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>
#include <deque>
#include <vector>

#include "support/random.hpp"
#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// A plan from `start` with the given jerks.
inline Trajectory makePlan(const KinematicState& start, const std::array<Vector3, kHorizon>& jerks, double epoch,
                           double dt) {
  Trajectory plan;
  plan.epoch = epoch;
  plan.dt = dt;
  plan.jerks = jerks;
  rollOut(start, plan);
  return plan;
}

inline std::array<Vector3, kHorizon> noJerks() {
  std::array<Vector3, kHorizon> jerks;
  jerks.fill(Vector3::Zero());
  return jerks;
}

/// A plan of constant velocity.
inline Trajectory straightPlan(const Vector3& p, const Vector3& v, double epoch, double dt) {
  return makePlan({p, v, Vector3::Zero()}, noJerks(), epoch, dt);
}

/// A plan that wanders: jerks up to `jerk` [m/s^3] along each axis, accelerations held down to about a metre per s^2.
inline Trajectory wanderingPlan(Random& random, const KinematicState& start, double jerk, double epoch, double dt) {
  std::array<Vector3, kHorizon> jerks;
  Vector3 acceleration = start.a;
  for (Vector3& j : jerks) {
    j = random.vector(-jerk, jerk) - acceleration;
    acceleration += dt * j;
  }
  return makePlan(start, jerks, epoch, dt);
}

/// Whether two plans are the same, bit by bit.
inline bool identical(const Trajectory& a, const Trajectory& b) {
  bool same = a.epoch == b.epoch && a.dt == b.dt;
  for (std::size_t k = 0; k < kHorizon; ++k) same = same && a.jerks[k] == b.jerks[k];
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    same = same && a.knots[k].p == b.knots[k].p && a.knots[k].v == b.knots[k].v && a.knots[k].a == b.knots[k].a;
  }
  return same;
}

/// The problem of one UAV together with all that it points to.
class FlightProblem {
 public:
  /// The target moves at `speed` [m/s] from the path's beginning; the UAV starts in the state `start`.
  FlightProblem(const std::vector<Vector3>& path, double speed, const KinematicState& start)
      : target_{ReferencePath(path), 0.0, speed, 0.0} {
    problem.parameters = &parameters;
    problem.path = &target_.path;
    problem.start = start;
    problem.dt = parameters.time.sampling_time;
    problem.progress = target_.path.nearest(start.p, 0.0, target_.path.length()).arc_length;
    placeTargets();
    setWorkspace(nullptr);
  }
  FlightProblem(const FlightProblem&) = delete;
  FlightProblem& operator=(const FlightProblem&) = delete;

  /// Takes over parameters that have changed; before bodies are added.
  void useParameters() {
    problem.dt = parameters.time.sampling_time;
    placeTargets();
    setWorkspace(nullptr);
  }
  void setWorkspace(const Workspace* workspace) { problem.bounds = FlightBounds(parameters, workspace); }

  void addObstacle(const Superellipsoid& obstacle, const DistanceGrowth& growth = {}) {
    obstacles_.push_back(obstacle);
    const LimitParameters& limits = parameters.limits;
    problem.bodies.push_back(MovingBody::fromObstacle(obstacles_.back(), problem.dt,
                                                      std::exp(parameters.cost.epsilon_s),
                                                      limits.uav_radius + limits.tracking_margin, growth));
  }
  void addUav(const Trajectory& plan, const Vector3& apart = Vector3::UnitX()) {
    motions_.emplace_back();
    predict(plan, problem.epoch, problem.dt, motions_.back());
    const LimitParameters& limits = parameters.limits;
    problem.bodies.push_back(MovingBody::fromUav(motions_.back(), limits.pair_distance + limits.pair_margin,
                                                 limits.pair_distance_vertical + limits.pair_margin, apart));
  }

  /// The plan without jerk from the start.
  Trajectory coasting() const { return makePlan(problem.start, noJerks(), problem.epoch, problem.dt); }

  Parameters parameters;
  UavProblem problem;

 private:
  void placeTargets() {
    for (int k = 0; k <= kHorizon; ++k) problem.targets[static_cast<std::size_t>(k)] = target_.at(k * problem.dt);
  }

  MovingTarget target_;
  std::deque<Superellipsoid> obstacles_;
  std::deque<PredictedMotion> motions_;
};

/// Adds up to six obstacles and four UAVs, all moving, to a flight along x from about (0, 0, 10); it may start too
/// close to some of them, or inside.
inline void crowd(Random& random, FlightProblem& flight) {
  for (int i = random.integer(0, 6); i > 0; --i) {
    const Vector3 radii(random.logUniform(0.3, 6.0), random.logUniform(0.3, 6.0), random.logUniform(0.3, 6.0));
    const Vector3 center(random.uniform(-2.0, 25.0), random.uniform(-6.0, 6.0), random.uniform(5.0, 15.0));
    flight.addObstacle(Superellipsoid(i, center, radii, random.vector(2.0, 10.0), random.uniform(-3.0, 3.0),
                                      random.vector(-1.5, 1.5)));
  }
  for (int i = random.integer(0, 4); i > 0; --i) {
    const Vector3 p(random.uniform(-3.0, 20.0), random.uniform(-5.0, 5.0), random.uniform(7.0, 13.0));
    const KinematicState start{p, random.vector(-3.0, 3.0), Vector3::Zero()};
    flight.addUav(wanderingPlan(random, start, 2.0, flight.problem.epoch, flight.problem.dt));
  }
}

}  // namespace swarm_planner
