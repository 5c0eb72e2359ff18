// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/closed_loop_cost.hpp"

#include <cmath>

#include "swarm_planner/obstacles/robustness.hpp"
#include "swarm_planner/problem/tracking_cost.hpp"

namespace swarm_planner {

double trackingCost(const Vector3& p, const Vector3& v, const Vector3& jerk, const PathPoint& foot,
                    const TargetState& target, const CostParameters& weights) {
  const StageFrame frame = makeStageFrame(foot);
  const double across = frame.horizontal.dot(p - foot.position);
  const double above = frame.vertical.dot(p - foot.position);
  const double velocity_weight = weights.velocity_time * weights.velocity_time;
  return weights.alpha * across * across + weights.beta * above * above +
         weights.eta * ((p - target.p).squaredNorm() + velocity_weight * (v - target.v).squaredNorm()) +
         weights.zeta * jerk.squaredNorm();
}

double robustnessCost(const Vector3& p, const std::vector<Superellipsoid>& obstacles, const CostParameters& weights) {
  if (weights.robustness_gain == 0.0) return 0.0;
  const RobustnessParameters parameters(weights);
  const double reach = std::sqrt(parameters.outer);  // farther out along any axis S exceeds r_b: exponents are >= 2
  double sum = 0.0;
  for (const Superellipsoid& obstacle : obstacles) {
    const Vector3 u = p - obstacle.center();
    if ((u.cwiseAbs().array() > reach * obstacle.halfExtents().array()).any()) continue;
    sum += robustnessValue(obstacle, p, parameters);
  }
  return sum;
}

void ClosedLoopCost::add(double t, double integrand) {
  if (started_) value_ += 0.5 * (t - time_) * (integrand_ + integrand);
  started_ = true;
  time_ = t;
  integrand_ = integrand;
}

}  // namespace swarm_planner
