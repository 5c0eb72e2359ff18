// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// The tables that the generated solver computes beforehand, for every model that the QPs will have. Read-only once
/// made: all threads share them.
class GeneratedTables {
 public:
  /// Throws std::invalid_argument if a model's weights do not make a strictly convex problem.
  explicit GeneratedTables(const std::vector<QpModel>& models);
  ~GeneratedTables();

  struct Entry;
  /// The tables of a model given to the constructor; null for any other.
  const Entry* find(const QpModel& model) const;

 private:
  std::vector<std::unique_ptr<Entry>> entries_;
};

/// Solves Qp with the solver generated from config/solver/planner_qp.yaml: a dual active set on tables and, where that
/// meets its cap, an interior-point method, with the widest vector instructions of this machine.
class GeneratedSolver final : public QpSolver {
 public:
  /// `most_changes`: of the active set, after which the answer counts as it is (QpStatus::kIterationLimit), so that the
  /// time of a solve is bounded closely; 0: none, every QP is solved.
  explicit GeneratedSolver(std::shared_ptr<const GeneratedTables> tables, int most_changes = 0);
  ~GeneratedSolver() override;

  /// The model has to be one of the tables'.
  QpStatus solve(const Qp& qp, QpSolution& solution) override;

 private:
  struct Memory;

  void load(const Qp& qp, const ActiveRows& guess);
  void storeActiveRows(ActiveRows& active) const;

  std::shared_ptr<const GeneratedTables> tables_;
  int most_changes_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace swarm_planner
