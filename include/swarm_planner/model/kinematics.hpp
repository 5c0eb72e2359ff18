// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// State of the kinematic model (2) with the control as a state: position [m], velocity [m/s] and
/// acceleration [m/s^2] in the planning frame. The input is the jerk [m/s^3], eq. (2) and (16).
struct KinematicState {
  Vector3 p = Vector3::Zero();
  Vector3 v = Vector3::Zero();
  Vector3 a = Vector3::Zero();
};

/// Exact motion under constant jerk over `dt` [s]: the discretisation of (2).
inline KinematicState propagate(const KinematicState& x, const Vector3& jerk, double dt) {
  KinematicState next;
  next.p = x.p + dt * (x.v + dt * (0.5 * x.a + (dt / 6.0) * jerk));
  next.v = x.v + dt * (x.a + (0.5 * dt) * jerk);
  next.a = x.a + dt * jerk;
  return next;
}

/// The same under constant acceleration `a`: (2) as the paper discretises it. The state's own acceleration is that of
/// the interval before.
inline KinematicState propagateHeld(const KinematicState& x, const Vector3& a, double dt) {
  return {x.p + dt * (x.v + 0.5 * dt * a), x.v + dt * a, a};
}

}  // namespace swarm_planner
