// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// The state that a UAV without a plan will have at `epoch`: it drifts on at its measured velocity.
KinematicState predictFromMeasurement(const UavMeasurement& measurement, double epoch);

/// The state that a UAV will have at `epoch`: where its newest plan `committed` puts it, plus the deviation that was
/// measured from the plan it flew then (`flown`), which its tracking lets decay with time constant `tracking_time` [s].
KinematicState predictFromPlan(const Trajectory& committed, const Trajectory& flown, const UavMeasurement& measurement,
                               double epoch, double tracking_time);

/// Warm start: the accelerations of `committed` on the stages of a horizon that begins with `start` at `epoch`; past
/// the end of `committed` the acceleration returns to zero.
void shiftPlan(const Trajectory& committed, const KinematicState& start, double epoch, double dt, Trajectory& plan);

/// First guess of a UAV without a plan: zero jerk from a start without acceleration.
void coastingPlan(const KinematicState& start, double epoch, double dt, Trajectory& plan);

}  // namespace swarm_planner
