// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/swarm/motion_memory.hpp"
#include "swarm_planner/swarm/snapshot.hpp"

namespace swarm_planner {

/// Watches whether a vehicle does what it is told, so that one that hovers or brakes on its own shows before it is far
/// off its motion. With n = odometry_noise and T = tracking_time a measurement is beyond what noise and tracking
/// explain if it is off every motion that the vehicle may be flying by more than 4 n of position or 2 n / T of
/// velocity: four standard deviations of noise that a planner with the shipped parameters is meant for.
///
///  - One such measurement makes it suspected: others are to keep clear of where it would stop, too.
///  - Two in a row that are off to the same side: it does not follow, and has to be planned for from where it is.
///    A push does not last so long. Until it is cleared of that one is enough.
///  - It is cleared once it is measured on its motion again, and more than 4 n from where it was off last: who only
///    stands where it is to stand may hover on its own. Nobody is told of that any more after odometry_doubt_time.
class FollowingWatch {
 public:
  static constexpr double kPositionNoises = 4.0;  ///< odometry_noise by which a vehicle may be off its motion
  /// The same, by which it may be off by the way that its velocity's deviation makes in tracking_time.
  static constexpr double kVelocityNoises = 2.0;
  /// Deviations `dp` [m] and `dv` [m/s] over the most that noise and tracking explain.
  static double excess(const Vector3& dp, const Vector3& dv, const InputParameters& input);

  /// A measurement that can be planned from. `drift`: how far its position is off the way that the velocities tell [m]:
  /// so much is the odometry's doing, not the vehicle's. `motions`: what the UAV is to fly.
  void note(const UavMeasurement& measurement, const Vector3& drift, const MotionMemory& motions,
            const InputParameters& input);
  /// Until `t` [s] the vehicle is on its way from where it really was to what it is told, which began with a guess: it
  /// is suspected at most.
  void settleUntil(double t) { settled_ = t; }
  /// It is known anew what the vehicle flies.
  void reset() { *this = FollowingWatch(); }

  /// Whether others are to keep clear of where it would stop.
  bool isSuspected() const { return finding_ != Finding::kFollows; }
  /// Whether the operator is to know.
  bool isNotFollowing() const { return finding_ == Finding::kDoesNotFollow; }
  /// Whether the newest measurement was beyond what can be explained, and the vehicle is known not to follow.
  bool isOff() const { return is_off_ && isNotFollowing(); }
  /// Whether the newest measurement was beyond what can be explained, be it by a push alone.
  bool isBeyondNoise() const { return is_off_; }

 private:
  enum class Finding { kFollows, kSuspected, kDoesNotFollow };

  Finding finding_ = Finding::kFollows;
  bool is_off_ = false;                   ///< the newest measurement
  Vector3 direction_ = Vector3::Zero();   ///< in which it was off [m]
  Vector3 last_place_ = Vector3::Zero();  ///< of the last one that was [m]
  double last_off_ = 0.0;                 ///< its stamp [s]
  double stamp_ = 0.0;                    ///< of the newest one [s]
  double settled_ = 0.0;                  ///< since when it can be on its motions [s]
};

}  // namespace swarm_planner
