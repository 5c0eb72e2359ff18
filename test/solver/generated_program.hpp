// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "solver/compiled_program.hpp"
#include "swarm_planner/solver/codegen/description.hpp"

namespace swarm_planner {
namespace codegen {

/// One QP for a generated solver, in terms that any description has.
struct ProblemData {
  struct Row {
    int output = 0, stage = 0, penalty = 0;  ///< penalty 0: hard
    std::vector<double> normal;              ///< padded to the solver's components
    double offset = 0.0;
  };
  struct Quadratic {
    int output = 0, stage = 0;
    std::vector<double> normal;
    double offset = 0.0, weight = 0.0;  ///< 1/2 weight (n . y - offset)^2
  };
  std::vector<double> x0, u_previous, state_linear, input_linear;
  std::vector<Row> rows;
  std::vector<Quadratic> quadratics;
};

struct SolverAnswer {
  int status = -1, method = -1, iterations = -1;
  std::vector<double> u, x;
};

/// A generated solver, compiled as a user would who has only a C compiler.
class GeneratedProgram {
 public:
  /// @param compiler_flags e.g. "-O2" or sanitizers
  /// @throws std::runtime_error if anything fails to compile
  GeneratedProgram(const Description& description, const std::string& compiler_flags);

  /// Solves all problems in one run of the program. Each is solved three times: by the active set cold, then warm
  /// from its own result, then by the interior-point method; the answers come in that order.
  std::vector<std::vector<SolverAnswer>> solve(const std::vector<ProblemData>& problems) const;

  /// Names that the compiled solver needs from elsewhere; empty if it stands alone.
  std::string undefinedSymbols() const { return program_.undefinedSymbols(); }
  /// The same with another compiler, warnings being errors. @throws std::runtime_error if it does not take the source
  std::string undefinedSymbols(const std::string& compiler) const { return program_.undefinedSymbols(compiler); }
  const std::string& folder() const { return program_.folder(); }

 private:
  Description description_;
  CompiledProgram program_;
};

}  // namespace codegen
}  // namespace swarm_planner
