// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// Most stages that a stop may take.
constexpr int kMaxStopStages = 20;

/// A stop at rest, v = 0 and a = 0, with constant jerk per stage. Takes no heap.
struct StopManoeuvre {
  double dt = 0.0;             ///< length of a stage [s]
  int stages = 0;              ///< 2 .. kMaxStopStages
  bool within_bounds = false;  ///< speed, acceleration and thrust hold on the whole curve
  std::array<KinematicState, kMaxStopStages + 1> knots;
  std::array<Vector3, kMaxStopStages> jerks;

  double duration() const { return stages * dt; }
  const Vector3& restingPlace() const { return knots[static_cast<std::size_t>(stages)].p; }
};

/// The stop from `x` in `stages` stages with the least sum of squared jerks. The two conditions per axis are
///   sum_k j_k = -a / dt,   sum_k w_k j_k = -(v + M dt a / 2) / dt^2,   w_k = (M - 1) / 2 - k,  M = stages,
/// with sum w_k = 0 and sum w_k^2 = M (M^2 - 1) / 12, hence
///   j_k = -a / (M dt) - 12 w_k (v + M dt a / 2) / (M (M^2 - 1) dt^2).
/// within_bounds is left false.
void rollOutStop(const KinematicState& x, int stages, double dt, StopManoeuvre& stop);

/// The shortest such stop that keeps the bounds between the knots too. If none does, the one whose largest ratio to a
/// bound is least, and within_bounds is false. The workspace is not looked at.
void planStop(const KinematicState& x, double dt, const FlightBounds& bounds, StopManoeuvre& stop);

/// The stop from `x` at `place` in `stages` >= 3 stages with the least sum of squared jerks. The place adds one
/// condition per axis to those above: with q_k = w_k^2 - (M^2 - 1) / 12, which is orthogonal to both of them, and
/// sum q_k^2 = M (M^2 - 1) (M^2 - 4) / 180, it is a third term of j_k. within_bounds is left false.
void rollOutStopAt(const KinematicState& x, const Vector3& place, int stages, double dt, StopManoeuvre& stop);

/// The shortest such stop that keeps the bounds between the knots too; within_bounds is false if none does.
void planStopAt(const KinematicState& x, const Vector3& place, double dt, const FlightBounds& bounds,
                StopManoeuvre& stop);

}  // namespace swarm_planner
