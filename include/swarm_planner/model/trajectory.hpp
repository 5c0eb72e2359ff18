// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>

#include "swarm_planner/model/kinematics.hpp"

namespace swarm_planner {

/// Number of stages of the horizon, N of Table 3. Fixed when the solver is generated.
constexpr int kHorizon = 20;

/// A plan: cubic position polynomials between kHorizon + 1 equidistant knots.
///
/// With `holds_acceleration` it is the paper's: the acceleration is constant between the knots and jumps at each by dt
/// times the "jerk", whose square is then the change of the control in (16). A knot's acceleration is that before it.
struct Trajectory {
  double epoch = 0.0;               ///< time of the first knot [s]
  double dt = 0.0;                  ///< between knots [s]
  bool holds_acceleration = false;  ///< as_paper
  std::array<KinematicState, kHorizon + 1> knots;
  std::array<Vector3, kHorizon> jerks;

  double duration() const { return kHorizon * dt; }
  /// The state at absolute time `t` [s]. Before the epoch: the first knot's position, velocity and
  /// acceleration moved back along the first segment; after the end: constant velocity of the last knot.
  KinematicState at(double t) const { return after(t - epoch); }
  /// The same `elapsed` seconds after the epoch: exact where an absolute time of 1e9 s rounds to 2e-7 s.
  KinematicState after(double elapsed) const;
};

/// Fills the knots by rolling `jerks` out from `start`.
void rollOut(const KinematicState& start, Trajectory& trajectory);

}  // namespace swarm_planner
