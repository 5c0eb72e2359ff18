// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <vector>

#include "planner_qp.h"
#include "support/random.hpp"
#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// A QP of the structure that config/solver/planner_qp.yaml describes, in the solver's axes.
struct PlannerProblem {
  struct Row {
    int output = 0, stage = 1, penalty = PLANNER_QP_PENALTY_SLACK;
    Vector3 n = Vector3::Zero();
    double d = 0.0;
    int id = -1;  ///< the solver's, once loaded
  };
  struct Quadratic {
    int stage = 1;
    Vector3 n = Vector3::Zero();
    double c = 0.0, weight = 0.0;  ///< 1/2 weight (n . p - c)^2
  };

  planner_qp_parameters model{};
  std::array<double, PLANNER_QP_STATES> x0{};
  std::array<std::array<double, PLANNER_QP_STATES>, PLANNER_QP_HORIZON> state_linear{};  ///< of stages 1..N
  std::vector<Row> rows;
  std::vector<Quadratic> quadratics;
};

/// Weights and time step anywhere within what a scenario may set.
planner_qp_parameters randomPlannerModel(Random& random);

/// Starts from at rest to far off and fast; 0 to 60 rows per stage and output, some of them duplicated, parallel,
/// nearly parallel, opposed with and without room between, or opposed and touching, which pins an output.
PlannerProblem randomPlannerProblem(const planner_qp_parameters& model, Random& random);

void load(PlannerProblem& problem, planner_qp_solver& solver);

/// The value of an output at a state as the solver gives it.
Vector3 valueOf(const planner_qp_parameters& model, int output, const double* state);

/// Inputs, and the rows that are active with their multipliers.
struct PlannerAnswer {
  std::array<std::array<double, PLANNER_QP_INPUTS>, PLANNER_QP_HORIZON> u{};
  std::vector<int> active_id;
  std::vector<double> multiplier, slack;

  PlannerAnswer() = default;
  /// That of a solver. Implicit: it stands for its answer.
  PlannerAnswer(const planner_qp_solver& solver);
};

/// How far an answer is from the optimum, by conditions that are checked on its inputs and multipliers alone.
struct PlannerKkt {
  double stationarity = 0.0;  ///< of the Lagrangian's gradient in the inputs, over the size of its terms
  double rows = 0.0;         ///< violation beyond the slack, and room of rows with a multiplier, over the outputs' size
  double price = 0.0;        ///< what the rows' errors cost: multipliers times room left, and penalties of violations
  double multipliers = 0.0;  ///< outside of their range, over the penalty
};
PlannerKkt kktOf(const PlannerProblem& problem, const PlannerAnswer& answer);

/// Objective of the answer's inputs, states by roll-out and slacks at their best, and the sum of its terms' sizes,
/// which rounding errors go with.
struct PlannerCost {
  double value = 0.0, size = 0.0;
};
PlannerCost costOf(const PlannerProblem& problem, const PlannerAnswer& answer);

}  // namespace swarm_planner
