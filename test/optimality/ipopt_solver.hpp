// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "optimality/reference_program.hpp"

namespace swarm_planner {

/// A local optimum of a ReferenceProgram.
struct ReferenceOptimum {
  bool found = false;  ///< Ipopt's own tolerances are met
  double cost = 0.0;   ///< with penalties
  double slack = 0.0;  ///< the largest
  Eigen::VectorXd variables;
};

/// Solves a program with Ipopt, exact Hessians, from ReferenceProgram::startAt(start).
ReferenceOptimum solveByIpopt(const ReferenceProgram& program, const Trajectory& start);

}  // namespace swarm_planner
