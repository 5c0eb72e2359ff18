// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "solver/compiled_program.hpp"
#include "solver/sparse_problem.hpp"

namespace swarm_planner {
namespace codegen {

/// A generated sparse solver, compiled as a user would who has only a C compiler.
class SparseProgram {
 public:
  /// @throws std::runtime_error if anything fails to compile
  SparseProgram(const SparseDescription& description, const std::string& compiler_flags);

  struct Answers {
    SparseAnswer cold;
    SparseAnswer warm;          ///< from the cold one's result
    double microseconds = 0.0;  ///< of the cold one
  };
  /// Solves all problems in one run of the program.
  std::vector<Answers> solve(const std::vector<SparseData>& problems) const;

  std::string undefinedSymbols() const { return program_.undefinedSymbols(); }
  const std::string& folder() const { return program_.folder(); }

 private:
  SparseDescription description_;
  CompiledProgram program_;
};

}  // namespace codegen
}  // namespace swarm_planner
