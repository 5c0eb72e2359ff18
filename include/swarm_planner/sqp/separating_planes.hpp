// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// Most bodies that one segment is kept clear of in one QP: the nearest ones. Of equal balls no more than 12 touch one
/// of them, in a plane 6, and the others are behind these; should a step meet one of them after all, its penalty tells,
/// and it is among the nearest of the next QP.
constexpr std::size_t kMostSegmentPlanes = 8;
/// Room that findSeparatingPlanes needs in its result, for any number of bodies.
constexpr std::size_t kSegmentPlaneRoom = 2 * kMostSegmentPlanes * kHorizon;

/// The planes between the segments of an iterate and the bodies that lie within `band` [m] of them, of each segment the
/// kMostSegmentPlanes nearest, in the order that SegmentPlanes asks for. Where the iterate leads through a body the
/// plane is the one of a way past it (PassingSide). `planes` has to have kSegmentPlaneRoom; takes no heap then.
void findSeparatingPlanes(const UavProblem& problem, const Trajectory& iterate, double band, SegmentPlanes& planes);

}  // namespace swarm_planner
