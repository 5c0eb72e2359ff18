// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "swarm_planner/solver/joint_qp.hpp"

namespace swarm_planner {

/// Solves JointQp with the solver generated from config/solver/joint_qp.yaml: a dual active set on one UAV's tables,
/// with the widest vector instructions of this machine. UAVs that no pair row connects are solved apart, which is the
/// same problem and takes less, and single ones by a solver of one UAV. Where UAVs that
/// are connected meet a cap there is no answer.
class GeneratedJointSolver final : public JointQpSolver {
 public:
  /// For QPs of these models, each UAV's any of them. Throws std::invalid_argument if a model's weights do not make a
  /// strictly convex problem.
  /// `single`: for the same models. `most_changes`: of the active set, per UAV of those that rows connect, after which
  /// the answer counts as it is (QpStatus::kIterationLimit); 0: none.
  GeneratedJointSolver(const std::vector<QpModel>& models, std::unique_ptr<QpSolver> single, int most_changes = 0);
  ~GeneratedJointSolver() override;

  QpStatus solve(const JointQp& qp, JointQpSolution& solution) override;

 private:
  struct Memory;

  // The UAVs in memory_->members.
  QpStatus solveAlone(const JointQp& qp, JointQpSolution& solution);
  QpStatus solveTogether(const JointQp& qp, JointQpSolution& solution);
  /// False if a UAV's model is none of the tables'.
  bool load(const JointQp& qp, const JointQpSolution& guess);
  void loadPairRows(const JointQp& qp);
  void store(const JointQp& qp, JointQpSolution& solution) const;
  void storeActiveRows(const JointQp& qp, JointQpSolution& solution) const;

  std::unique_ptr<Memory> memory_;
};

}  // namespace swarm_planner
