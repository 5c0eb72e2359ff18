// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// Poses the QP of a problem at an iterate: second-order model of the cost (the robustness Hessian projected),
/// half-spaces for the bodies on all control points of a segment, tangent planes for the norm limits. Only what
/// lies within `band` [m] of the iterate gets rows.
void linearise(const UavProblem& problem, const Trajectory& iterate, double band, Qp& qp);

/// Adds tangent planes where an earlier answer of the same problem broke a norm limit: with the tangents at the
/// iterate alone, the next answer may swing sideways past the limit.
void addNormCuts(const UavProblem& problem, const Trajectory& answer, Qp& qp);

}  // namespace swarm_planner
