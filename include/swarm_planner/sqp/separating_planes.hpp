// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// Most bodies that one segment is kept clear of in one QP: the nearest ones. Of equal balls no more than 12 touch one
/// of them, so that the others are behind these; should a step meet one of them after all, its penalty tells, and it is
/// among the nearest of the next QP.
constexpr std::size_t kMostSegmentPlanes = 24;
/// Room that findSeparatingPlanes needs in its result, for any number of bodies.
constexpr std::size_t kSegmentPlaneRoom = 2 * kMostSegmentPlanes * kHorizon;

/// The planes between the segments of an iterate and the bodies that lie within `band` [m] of them, of each segment the
/// kMostSegmentPlanes nearest, in the order that SegmentPlanes asks for. Where the iterate leads through a body the
/// plane is the one of a way past it (PassingSide). `planes` has to have kSegmentPlaneRoom; takes no heap then.
void findSeparatingPlanes(const UavProblem& problem, const Trajectory& iterate, double band, SegmentPlanes& planes);

/// Appends those of one body, at most kHorizon; `index` is what their SegmentPlane::body says.
void addSeparatingPlanes(const UavProblem& problem, const MovingBody& body, std::size_t index, const PlanPoints& points,
                         double band, SegmentPlanes& planes);

/// The first control point of its segment that planes[i] has to be a row for: a knot belongs to two segments, and where
/// the plane of the segment before asks as much of it, one row does.
int firstRowPoint(const FlightBounds& bounds, const SegmentPlanes& planes, std::size_t i);

}  // namespace swarm_planner
