// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/solver/codegen/generator.hpp"

namespace swarm_planner {
namespace codegen {

/// Compiler flags for programs that are run a few times: compiling takes longer than all they do, and the arithmetic is
/// the same for every level of optimisation.
constexpr char kQuickBuild[] = "-O0";

/// Generated code and a small driver around it, compiled as a user would who has only a C compiler, in a folder of
/// their own.
class CompiledProgram {
 public:
  /// @param driver C text; NAME and PREFIX are put in its place
  /// @param compiler_flags e.g. "-O2" or sanitizers
  /// @throws std::runtime_error if anything fails to compile
  CompiledProgram(const GeneratedCode& code, const std::string& driver, const std::string& compiler_flags);
  ~CompiledProgram();
  CompiledProgram(const CompiledProgram&) = delete;
  CompiledProgram& operator=(const CompiledProgram&) = delete;

  /// Runs the program on numbers and returns those that it writes. @throws std::runtime_error if it fails
  std::vector<double> run(const std::vector<double>& in) const;

  /// Names that the compiled solver needs from elsewhere; empty if it stands alone.
  std::string undefinedSymbols() const;
  /// The same with another compiler, warnings being errors. @throws std::runtime_error if it does not take the source
  std::string undefinedSymbols(const std::string& compiler) const;
  const std::string& folder() const { return folder_; }

 private:
  std::string name_;
  std::string folder_;
};

}  // namespace codegen
}  // namespace swarm_planner
