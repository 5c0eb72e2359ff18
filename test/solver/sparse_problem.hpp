// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "support/random.hpp"
#include "swarm_planner/solver/codegen/sparse_description.hpp"

namespace swarm_planner {
namespace codegen {

/// The run-time data of a generated sparse solver.
struct SparseData {
  std::vector<double> linear, lower, upper, row_lower, row_upper;
  std::vector<int> row_penalty;         ///< 0: hard
  std::vector<double> hessian, matrix;  ///< the entries that vary
};

/// What a generated sparse solver answers.
struct SparseAnswer {
  int status = -1, iterations = -1;
  double objective = 0.0, residual = 0.0;
  std::vector<double> x, row_multiplier, bound_multiplier;
};

struct RandomSparseOptions {
  int most_variables = 60;
  bool varying = false;  ///< all entries of H and A come with every problem
  bool equalities = true;
};

/// The YAML text of a random sparse QP: sizes, patterns, notations of patterns, penalties and what varies differ; H is
/// singular more often than not.
std::string randomSparseDescription(Random& random, int number, const RandomSparseOptions& options = {});

/// A problem with its optimum.
struct KnownSparseProblem {
  SparseData data;
  double objective = 0.0;
  /// The problem solved is a better scaled one in x = variable_scale * scaled x, rows and cost multiplied.
  Eigen::VectorXd variable_scale, row_scale;
  double cost_scale = 1.0;
};

struct KnownSparseOptions {
  double active = 0.3;      ///< share of rows and bounds that are active
  bool independent = true;  ///< gradients of hard active rows are linearly independent
  double scales = 1.0;      ///< variables, hard rows and cost are scaled by factors of 1/scales to scales
};

/// Chooses x and multipliers at random, then bounds that make rows active, soft or inactive and the linear cost that
/// makes x optimal.
KnownSparseProblem makeKnownSparseProblem(const SparseDescription& description, const KnownSparseOptions& options,
                                          Random& random);

/// How far an answer is from optimal, relative to the terms involved: the largest of the error in the cost, the
/// stationarity, the violation of hard rows and bounds, and multipliers of the wrong sign.
double optimalityError(const SparseDescription& description, const KnownSparseProblem& problem,
                       const SparseAnswer& answer);

/// The cost with penalties at x.
double sparseObjective(const SparseDescription& description, const SparseData& data, const Eigen::VectorXd& x);

}  // namespace codegen
}  // namespace swarm_planner
