// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <random>

#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// A random QP together with its solution.
struct KnownOptimum {
  Qp qp;
  QpSolution solution;
  /// Multiplier of each row, in the layout of Qp::stages[k].rows.
  std::array<std::array<double, kMaxStageRows>, kHorizon + 1> multipliers{};
};

/// How many rows each stage of a random QP gets, by what they are at the optimum.
struct RowMix {
  int active = 2;    ///< multiplier in (0, slack_linear), no slack
  int softened = 1;  ///< multiplier above slack_linear, slack > 0
  int inactive = 4;  ///< multiplier 0, satisfied with room
};

/// Chooses multipliers, costates and row normals at random and then sets gradients and offsets such that they
/// satisfy the Karush-Kuhn-Tucker conditions exactly; the problem is strictly convex, so this is its optimum.
KnownOptimum makeKnownOptimum(const RowMix& mix, std::mt19937_64& random);

/// Objective of a QP at given jerks, slacks at their best.
double objective(const Qp& qp, const std::array<Vector3, kHorizon>& jerks);

}  // namespace swarm_planner
