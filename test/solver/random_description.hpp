// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "solver/generated_program.hpp"
#include "support/random.hpp"
#include "swarm_planner/solver/codegen/description.hpp"

namespace swarm_planner {
namespace codegen {

/// The YAML text of a random QP structure: sizes, sparsity (coupled, decoupled or Kronecker), costs, outputs, row
/// kinds and penalties vary; the input's linear term is always run-time data, so that any inputs can be optimal.
/// @param row_scale penalties are those of rows with normals of this length
std::string randomDescription(Random& random, int number, double row_scale = 1.0);

/// A problem with its optimum.
struct KnownProblem {
  ProblemData data;
  std::vector<double> u;  ///< [N][inputs]
};

struct KnownProblemOptions {
  int active = 6;  ///< rows with a multiplier at the optimum, of all kinds
  int inactive = 20;
  int quadratics = 0;       ///< rank-one terms of the cost, 4 at most
  double row_scale = 1.0;   ///< normals and offsets times this
  bool duplicates = false;  ///< every active row comes twice, and once opposed and inactive
  /// Hard active rows of independent gradients, so that there are points where all hold with room, without which no
  /// interior-point method converges. false: they may pin the inputs.
  bool independent = true;
};

/// Chooses inputs and multipliers at random, rows that they make active, soft or inactive, and then the linear terms
/// that make the inputs optimal. Strict convexity makes them the only optimum.
KnownProblem makeKnownProblem(const Description& description, const KnownProblemOptions& options, Random& random);

}  // namespace codegen
}  // namespace swarm_planner
