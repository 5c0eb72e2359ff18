// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"
#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {

/// The integrand F of (16) for one UAV on a polyline, without the robustness function: with the foot f of the UAV on
/// its reference and the directions h, b across the path there (problem/tracking_cost.hpp),
///   alpha (h . (p - f))^2 + beta (b . (p - f))^2 + eta (|p - p_m|^2 + velocity_time^2 |v - v_m|^2) + zeta |jerk|^2.
double trackingCost(const Vector3& p, const Vector3& v, const Vector3& jerk, const PathPoint& foot,
                    const TargetState& target, const CostParameters& weights);

/// The robustness function (8) at `p`, without its constant -1.
double robustnessCost(const Vector3& p, const std::vector<Superellipsoid>& obstacles, const CostParameters& weights);

/// Integrates (15), the swarm's cost along the motion that was flown, by the trapezoidal rule.
class ClosedLoopCost {
 public:
  explicit ClosedLoopCost(const CostParameters& weights) : weights_(weights) {}

  const CostParameters& weights() const { return weights_; }

  /// F of (16) summed over all UAVs at `t` [s], not earlier than the last.
  void add(double t, double integrand);

  /// The integral so far.
  double value() const { return value_; }

 private:
  CostParameters weights_;
  bool started_ = false;
  double time_ = 0.0;
  double integrand_ = 0.0;
  double value_ = 0.0;
};

}  // namespace swarm_planner
