// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "swarm_planner/solver/recorded_problems.hpp"

namespace swarm_planner {

/// The solver generated from config/solver/recorded_qp.yaml, with the widest instruction set of this machine.
class RecordedSolver {
 public:
  enum class Method { kActiveSet, kInteriorPoint };

  /// @param file has the sizes of the problems to come
  /// @param tolerance relative accuracy asked of the interior-point method; the active set is exact
  /// @throws std::invalid_argument if the solver was generated for another horizon or for fewer rows;
  ///   std::runtime_error if set-up fails
  RecordedSolver(const RecordedProblems& file, Method method, double tolerance);
  ~RecordedSolver();

  /// Puts one problem's data in place, with its warm start or without.
  void load(const RecordedProblem& problem, bool warm);
  void solve();

  bool solved() const;
  /// The method that answered the last solve.
  Method method() const;
  int iterations() const;
  std::vector<double> input() const;  ///< [N][3]
  RecordedMultipliers multipliers() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
  int rows_;
};

}  // namespace swarm_planner
