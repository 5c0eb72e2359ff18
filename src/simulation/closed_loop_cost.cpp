// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/closed_loop_cost.hpp"

#include <Eigen/Geometry>

namespace swarm_planner {

double trackingCost(const Vector3& p, const Vector3& v, const Vector3& jerk, const PathPoint& foot,
                    const TargetState& target, const CostParameters& weights) {
  constexpr double kVertical = 1e-9;
  const Vector3& t = foot.tangent;
  const Vector3 level = upward().cross(t);
  const Vector3 h = level.norm() > kVertical ? Vector3(level.normalized()) : Vector3(Vector3::UnitY());
  const Vector3 b = t.cross(h);
  const Vector3 off = p - foot.position;
  const double across = h.dot(off);
  const double above = b.dot(off);
  const double velocity_weight = weights.velocity_time * weights.velocity_time;
  return weights.alpha * across * across + weights.beta * above * above +
         weights.eta * ((p - target.p).squaredNorm() + velocity_weight * (v - target.v).squaredNorm()) +
         weights.zeta * jerk.squaredNorm();
}

void ClosedLoopCost::add(double t, double integrand) {
  if (started_) value_ += 0.5 * (t - time_) * (integrand_ + integrand);
  started_ = true;
  time_ = t;
  integrand_ = integrand;
}

}  // namespace swarm_planner
