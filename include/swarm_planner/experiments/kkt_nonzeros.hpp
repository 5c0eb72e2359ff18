// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// Nonzeros of the KKT matrix of one UAV's QP (solver/qp.hpp) posed sparsely, with both triangles,
///   [ H A' G' ]
///   [ A 0  0  ]   over x_1..x_N, u_0..u_{N-1} and the slacks s,
///   [ G 0  0  ]
/// and with every row that can ever be set: each obstacle and each other UAV on every segment of the horizon. This is
/// the paper's measure of a problem's size; the planner itself sets only the rows of what can be reached.
///
/// Per stage, with R rows in all:
///   H: position 3 x 3, velocity 3, jerk 3, and 1 per slack; at the last stage also acceleration 3;
///   A: x_{k+1} = propagate(x_k, u_k): 9 for x_{k+1}, 9 for u_k and, but for the known x_0, 18 for x_k;
///   G: n . y + s >= d and s >= 0, where y is made of up to three parts of the state: 3 entries per part that it has
///      (1 where n is an axis), 1 for the slack, 1 for its sign.
///
/// With as_paper the variables are the paper's, x = (p, v) and u = a held between the stages: H has 3 per stage for the
/// input and 3 on either side of the diagonal for its change between neighbours; A has 6 for x_{k+1}, 6 for u_k and,
/// but for the known x_0, 9 for x_k.
long long kktNonzeros(const Mission& mission);

/// The same of the QP of all UAVs at once: each with its own dynamics, cost and rows, and a row for each pair of them
/// on every control point, with the entries of both.
long long jointKktNonzeros(const Mission& mission);

}  // namespace swarm_planner
