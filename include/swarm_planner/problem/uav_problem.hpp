// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/problem/map_corridor.hpp"
#include "swarm_planner/problem/moving_body.hpp"
#include "swarm_planner/problem/target_preview.hpp"

namespace swarm_planner {

/// Bounds that every stage of a plan keeps, besides the bodies around it.
struct FlightBounds {
  double max_speed = 0.0;                    ///< |v| [m/s]
  double max_acceleration = 0.0;             ///< |a| [m/s^2], may be infinite
  double max_jerk = 0.0;                     ///< of a plan that passes the check [m/s^3], may be infinite
  double max_thrust_acceleration = 0.0;      ///< |A + g e3|, T_max / M of (6) [m/s^2]
  double min_vertical_thrust = 0.0;          ///< A_z, so that A_z + g >= min_thrust_ratio g [m/s^2]
  Vector3 drag_over_mass = Vector3::Zero();  ///< of A = a + k_d / M v, eq. (3) [1/s]
  Vector3 gravity = Vector3::Zero();         ///< g e3 [m/s^2]
  Workspace workspace;                       ///< infinite where the scenario has none
  bool between_samples = true;               ///< false: constraints hold at the knots alone (negative control)

  FlightBounds() = default;
  FlightBounds(const Parameters& parameters, const Workspace* scenario_workspace);
};

/// The nonlinear program of one UAV, Problem (18): cost (17) over the horizon subject to the jerk-input model (2),
/// obstacles (7), other UAVs (14), thrust (6), speed, acceleration and workspace, the other UAVs' plans held fixed.
struct UavProblem {
  const Parameters* parameters = nullptr;
  const ReferencePath* path = nullptr;
  FlightBounds bounds;
  double progress = 0.0;  ///< arc length near which the start's foot on the path lies [m]
  KinematicState start;   ///< at the epoch
  double epoch = 0.0;     ///< [s]
  double dt = 0.0;        ///< [s]
  StageTargets targets;
  bool is_guided = false;          ///< the path leads round the obstacles
  std::vector<MovingBody> bodies;  ///< whatever can be reached within the horizon
  MapCorridor corridor;            ///< what a map leaves of the space about the plan
};

/// Points at which constraints hold while a plan flies each of its segments: the four control points, or, where they
/// hold at the knots alone, four times the knot at its end.
using PlanPoints = std::array<SegmentPoints, kHorizon>;
void findConstrainedPoints(const UavProblem& problem, const Trajectory& plan, PlanPoints& points);

/// Contains all control points of a plan [m].
Box planBox(const PlanPoints& points);

/// Those of segment k relative to a body's reference point [m].
inline SegmentPoints relativeConstrainedPoints(const UavProblem& problem, const PlanPoints& points, int k,
                                               const MovingBody& body) {
  SegmentPoints relative = relativePoints(body, k, points[static_cast<std::size_t>(k)]);
  if (!problem.bounds.between_samples) relative.fill(Vector3(relative[3]));
  return relative;
}

/// The first of these that counts: 0, or 3 where all four are the same knot.
inline std::size_t firstConstrainedPoint(const FlightBounds& bounds) { return bounds.between_samples ? 0 : 3; }

/// How far a plan violates the constraints.
struct Violation {
  double linear = 0.0;     ///< sum over all constraints [m, m/s, m/s^2]
  double quadratic = 0.0;  ///< sum of squares
  double largest = 0.0;

  void add(double clearance) {
    if (clearance >= 0.0) return;
    linear -= clearance;
    quadratic += clearance * clearance;
    if (-clearance > largest) largest = -clearance;
  }
};

/// A half-space that has all of a body behind it while a plan flies one segment.
struct SegmentPlane {
  std::size_t body = 0;  ///< index in UavProblem::bodies
  int segment = 0;
  HalfSpace half_space;
  double clearance = 0.0;  ///< of the segment that the plane was made for [m]
};
/// Ordered by body, then by segment; at most one for each.
using SegmentPlanes = std::vector<SegmentPlane>;

/// Violation of the bounds and of the distances to all bodies by a plan: states at the knots, positions and
/// velocities at the Bernstein control points between them, so that nothing happens between the samples unseen. A
/// segment is clear of a body if one half-space has the one in front and the other behind: that towards the segment's
/// middle, or one that `planes` knows. With the planes of the QP that a step comes from, a step that keeps them is not
/// refused only because the planes turn as the plan moves along a curved body. Unless bounds.between_samples: at the
/// knots alone.
Violation planViolation(const UavProblem& problem, const Trajectory& plan, const SegmentPlanes& planes = {});

/// Adds what planViolation() counts for one body. `plane`: the first in [plane, end) of those known for `index`, which
/// is what their SegmentPlane::body says, or a later body's, or `end`.
void addBodyViolations(const UavProblem& problem, const MovingBody& body, std::size_t index, const PlanPoints& points,
                       SegmentPlanes::const_iterator plane, SegmentPlanes::const_iterator end, Violation& violation);

/// The L1 and quadratic penalties.
double penaltyOf(const Violation& violation, const SqpParameters& sqp);

/// The exact penalty function that every step has to decrease.
struct Merit {
  double value = 0.0;              ///< cost (17) plus the L1 and quadratic penalties
  double largest_violation = 0.0;  ///< planViolation(...).largest
};
Merit merit(const UavProblem& problem, const Trajectory& plan, const SegmentPlanes& planes = {});

/// Smallest clearances that a plan predicts at its knots: lower bounds that are exact for spheres.
struct PredictedClearance {
  double obstacle = 0.0;  ///< surface distance minus uav_radius [m], infinite without obstacle in reach
  double pair = 0.0;      ///< centre distance [m], infinite without UAV in reach
};
PredictedClearance predictedClearance(const UavProblem& problem, const Trajectory& plan);

}  // namespace swarm_planner
