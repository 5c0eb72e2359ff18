// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// A bound on a UAV's own motion.
enum class FlightBound { kNone, kSpeed, kAcceleration, kJerk, kThrust };

/// The first bound that a segment exceeds.
struct EnvelopeBreach {
  FlightBound bound = FlightBound::kNone;
  double time = 0.0;  ///< a time in the segment at which it is exceeded, or cannot be shown to hold [s]
};

/// Bounds count as kept up to this fraction: it covers rounding.
constexpr double kBoundTolerance = 1e-9;

/// Whether a segment of constant jerk keeps speed, acceleration and thrust (6) everywhere, by the Bernstein
/// coefficients of |v|^2, |a|^2, |A + g e3|^2 and A_z; subdivided where these do not decide. What stays undecided
/// counts as exceeded, and so does what is not finite. The workspace is not looked at.
EnvelopeBreach findBreach(const FlightBounds& bounds, const KinematicState& begin, const Vector3& jerk, double dt);

/// Upper bound of the largest ratio of speed, acceleration or thrust to its bound along a segment.
double envelopeRatio(const FlightBounds& bounds, const KinematicState& begin, const Vector3& jerk, double dt);

/// The bounds for a motion that starts in `start`: where the start itself exceeds one, what the start has is allowed
/// all along, but no more than the fraction `slack` above the bound.
FlightBounds relieveBounds(const FlightBounds& bounds, const KinematicState& start, double slack);

}  // namespace swarm_planner
