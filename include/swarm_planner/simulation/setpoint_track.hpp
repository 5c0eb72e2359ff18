// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

#include "swarm_planner/model/setpoints.hpp"

namespace swarm_planner {

/// What a vehicle is asked to do at one instant, planning frame.
struct MotionSetpoint {
  Vector3 p = Vector3::Zero();     ///< [m]
  Vector3 v = Vector3::Zero();     ///< [m/s]
  Vector3 a = Vector3::Zero();     ///< [m/s^2]
  Vector3 jerk = Vector3::Zero();  ///< [m/s^3]
};

/// Greatest number in a trajectory that can be flown [m, m/s, m/s^2, s].
constexpr double kMostSetpoint = 0.999e6;

/// What was asked for is known so long [s].
constexpr double kSetpointMemory = 0.1;

/// True if `trajectory` can be flown: at least one point, every number finite and at most kMostSetpoint in magnitude
/// (its epoch and yaw only finite), times from the start >= 0 and at least 1e-4 s apart.
bool isFlyable(const SetpointTrajectory& trajectory);

/// The trajectories that one vehicle has received, as one motion over time.
///
/// A trajectory takes over at its first point (at its epoch, if that is at time 0); until then the one before it goes
/// on. A trajectory that arrives replaces every waiting one whose beginning is not earlier than its own. Between two
/// points the motion is the quintic that meets position, velocity and acceleration at both (piecewise quintic Hermite):
/// of a plan with constant jerk between samples it is the plan itself, exactly. After the last point the last position
/// is held, at rest.
class SetpointTrack {
 public:
  /// Holds `start` [m] until a trajectory takes over.
  explicit SetpointTrack(const Vector3& start);

  /// False, with nothing changed, if the trajectory is not flyable, or begins more than a minute ahead: trajectories
  /// that never begin would wait for good. `now` [s]: what it may forget. At most 64 wait; the last to begin gives way.
  bool receive(const SetpointTrajectory& trajectory, double now);

  /// The setpoint at `t` [s], not earlier than kSetpointMemory before the newest trajectory came. No heap allocation.
  MotionSetpoint at(double t) const;

  /// Forgets every trajectory and holds `position` [m].
  void hold(const Vector3& position);

 private:
  const SetpointTrajectory* activeAt(double t) const;

  Vector3 rest_;
  std::vector<SetpointTrajectory> received_;  ///< by beginning, strictly increasing
};

}  // namespace swarm_planner
