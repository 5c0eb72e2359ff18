// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/swarm/committed_motion.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// The state that a UAV without a plan will have at `epoch`: it drifts on at its measured velocity.
KinematicState predictFromMeasurement(const UavMeasurement& measurement, double epoch);

/// The share of a measured deviation (`dp` [m], `dv` [m/s]) that is taken for one of the vehicle, not of the
/// measurement: 1 for a large one, kLeastCarried up to `band` [m], of position or of the way that the velocity makes in
/// `tracking_time` [s]. What is not carried is measured again: a lasting deviation is carried after some cycles, noise
/// is averaged.
constexpr double kLeastCarried = 0.2;
double carriedShare(const Vector3& dp, const Vector3& dv, double band, double tracking_time);

/// The state that a UAV will have at `epoch`: where its motion puts it (`planned`), plus the carried share of the
/// deviation that was measured from where it was to be then (`expected`), which its tracking lets decay with time
/// constant tracking_time.
KinematicState carryDeviation(const KinematicState& planned, const KinematicState& expected,
                              const UavMeasurement& measurement, double epoch, const InputParameters& parameters);

/// Warm start: the accelerations of `committed` on the stages of a horizon that begins with `start` at `epoch`.
/// plan.holds_acceleration says how they are to be flown.
void shiftPlan(const CommittedMotion& committed, const KinematicState& start, double epoch, double dt,
               Trajectory& plan);

/// The largest share, at most 1, of the way from one plan's jerks to another's at which none is longer than `max_jerk`
/// [m/s^3]. Jerks of the first plan that are too long count for nothing: no share makes them shorter for sure.
double shareWithinJerk(const Trajectory& from, const Trajectory& to, double max_jerk);

/// First guess of a UAV without a plan: zero jerk from a start without acceleration.
void coastingPlan(const KinematicState& start, double epoch, double dt, Trajectory& plan);

}  // namespace swarm_planner
