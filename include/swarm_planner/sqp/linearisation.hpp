// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// The constant parts that the QPs of a swarm have. For a reference with one tangent over the horizon the position's
/// weights differ along and across it; for one with corners they are the larger one in every direction.
struct QpModels {
  QpModel straight;
  QpModel corner;
};
QpModels makeQpModels(const Parameters& parameters);

/// Where a row on a segment's control point goes.
struct RowPlace {
  int stage = 1;
  Output output = Output::kPosition;
  RowSource source = 0;  ///< what to add to a body's: a knot belongs to two segments
};
/// Of control point i = 0..3 of segment k; empty for those of the first segment that the start fixes.
std::optional<RowPlace> controlPointPlace(int k, int i);

/// Poses the QP of a problem at an iterate: the cost's gradient is exact there, its curvature that of the model, at
/// least that of cost (16), plus that of the robustness function, projected to be positive; half-spaces for the bodies
/// on all control points of a segment (at the knots alone unless bounds.between_samples), tangent planes for the norm
/// limits. The planes of the last segment also hold for the control points of the stop that its end fixes. Only what
/// lies within `band` [m] of the iterate gets rows, and of many bodies the nearest. `planes` takes down the
/// half-spaces: see findSeparatingPlanes.
void linearise(const UavProblem& problem, const Trajectory& iterate, double band, Qp& qp, SegmentPlanes& planes);

/// Whether rows of bodies are among those that were active in a QP of linearise().
bool leansOnBodies(const ActiveRows& active);

/// Adds tangent planes where an earlier answer of the same problem broke a norm limit: with the tangents at the
/// iterate alone, the next answer may swing sideways past the limit. `number` tells the answers of one problem apart.
void addNormCuts(const UavProblem& problem, const Trajectory& answer, int number, Qp& qp);

}  // namespace swarm_planner
