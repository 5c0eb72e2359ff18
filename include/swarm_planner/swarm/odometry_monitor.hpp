// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/swarm/cycle_report.hpp"
#include "swarm_planner/swarm/motion_memory.hpp"
#include "swarm_planner/swarm/snapshot.hpp"

namespace swarm_planner {

/// Judges one UAV's odometry: each measurement against the clock, against those before it and against the motion that
/// the UAV is to fly. What is refused counts as odometry that has not come. With n = odometry_noise, 5 cm
/// at least, and T = odometry_doubt_time:
///
///  - frozen: the position stays the same to the last bit while stamps go on, though the velocity in the same message,
///    unchanged too, has carried the UAV by more than 2 n; or for T after its motion has moved by more than 2 n.
///    Whoever is to rest may rest, without noise for ever, and so may who has not yet left the ground. Ends with a new
///    position, which is judged as after a jump; against the motion alone after relocalisation_time, too.
///  - jumps: no flight leads from the last measurement that was believed (p0, v0) to this one (p1, v1), dt later. One
///    that does has |p1 - p0| <= 1.2 dt max(max_speed, |v0|, |v1|) + 7 n and, as accelerations are at most
///    A = max_thrust_ratio g, |p1 - p0 - dt (v0 + v1) / 2| <= A dt^2 / 4 + 7 n. Normal noise of standard deviation n on
///    each axis does not reach 7 n.
///  - stamps go back: the same, told by its own reason.
///  - drifts: the position does not follow the velocity: p1 - p0 - dt (v0 + v1) / 2, summed up over the measurements of
///    some 5 s, exceeds 7 n. A UAV that is pushed or blown off has both.
///  - is back elsewhere: after more than 0.5 s without any, in which almost any place could have been flown to, farther
///    off the motion than off_plan_distance and than tracking_error + 3 n. The same as a jump.
///    After any of these a measurement is believed that lies within 3 n of where the motion, or the motion with the
///    deviation that was there before (without what has drifted), has the UAV (without a motion: that a flight within T
///    leads to); one that has stood for T where the motion has led since, once the source does not go on where it
///    was: the vehicle has stopped on its own; and any, once measurements have fitted each other for
///    relocalisation_time: an estimator that has found its place anew.
///  - off plan: farther than off_plan_distance from its motion in all measurements of a time T.
class OdometryMonitor {
 public:
  /// Why `measurement` cannot be planned from; kNone if it can. `motions`: what the UAV is to fly.
  Reason judge(const UavMeasurement& measurement, double now, const MotionMemory& motions,
               const Parameters& parameters);

  /// Takes note of how far from its motion a measurement that can be planned from is [m], at its `stamp` [s]. True once
  /// the UAV has been off its plan for long enough; counting begins anew then.
  bool noteDeviation(double deviation, double stamp, const InputParameters& input);

  /// The UAV's motion has been replaced by another one: what it was to fly before is no measure of what it does.
  void forgetMotion();

  /// The last measurement that could be planned from; empty if there has been none.
  const std::optional<UavMeasurement>& trusted() const { return trusted_; }
  /// Where a UAV whose odometry is doubted seems to stand, not yet for long enough to be believed.
  const std::optional<UavMeasurement>& stood() const { return stood_; }
  /// Where a UAV seems to be whose odometry came back elsewhere after a gap: nobody knows yet whether it lies. Null:
  /// not so.
  const UavMeasurement* seenElsewhere() const { return after_gap_ && doubted_ ? &*doubted_ : nullptr; }
  /// By how much positions have left the way that the velocities tell, in the last seconds up to that one [m].
  const Vector3& drift() const { return drift_; }

 private:
  Reason compare(const UavMeasurement& measurement, const MotionMemory& motions, const Parameters& parameters);
  /// Whether it follows from the last trusted one; otherwise fault_ says why not.
  bool follows(const UavMeasurement& measurement, const MotionMemory& motions, const Parameters& parameters);
  /// Whether a doubted UAV is again where it is to be.
  bool isBack(const UavMeasurement& measurement, const MotionMemory& motions, const Parameters& parameters) const;
  /// Whether a UAV that has not been measured for a while is elsewhere than tracking explains.
  bool isFarOff(const UavMeasurement& measurement, const MotionMemory& motions, const Parameters& parameters) const;
  /// How far it is off the nearest of the motions that it may be flying, but for what it was off before [m]; empty if
  /// none is known.
  std::optional<double> newDeviation(const UavMeasurement& measurement, const MotionMemory& motions) const;
  /// Whether it has stood for odometry_doubt_time where its motion has led since it was believed last.
  bool hasStoodOnWay(const UavMeasurement& measurement, const MotionMemory& motions, const InputParameters& input);
  void trust(const UavMeasurement& measurement, const MotionMemory& motions);
  bool isFrozen(const UavMeasurement& measurement, const MotionMemory& motions, const InputParameters& input);

  std::optional<UavMeasurement> trusted_;
  Vector3 trusted_off_ = Vector3::Zero();  ///< its deviation from the motion [m]
  Vector3 drift_ = Vector3::Zero();        ///< of positions against velocities up to it [m]
  std::optional<Vector3> first_;           ///< position of the first measurement [m]
  bool has_moved_ = false;                 ///< away from there
  std::optional<UavMeasurement> newest_;   ///< compared last
  Reason verdict_ = Reason::kNone;         ///< on it
  std::optional<UavMeasurement> held_;     ///< the first with the position that the newest has
  std::optional<double> overdue_since_;    ///< when the motion had moved far enough from there [s]
  std::optional<Vector3> held_expected_;   ///< where the motion had the UAV then [m]
  std::optional<UavMeasurement> doubted_;  ///< the newest of those that fit each other but not the trusted one
  double doubted_since_ = 0.0;             ///< stamp of the first of them [s]
  bool source_changed_ = false;            ///< between two doubted ones, once
  bool after_gap_ = false;                 ///< they began after a gap, and go on from there
  std::optional<UavMeasurement> stood_;    ///< the first of those since then that stand in one place on its way
  Reason fault_ = Reason::kNone;           ///< why they are doubted
  std::optional<double> off_plan_since_;   ///< [s]
};

}  // namespace swarm_planner
