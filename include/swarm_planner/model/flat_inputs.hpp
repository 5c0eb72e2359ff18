// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/parameters.hpp"

namespace swarm_planner {

/// Attitude and thrust that make the reduced dynamics (1) fly a given acceleration.
struct Attitude {
  double phi = 0.0;     ///< roll [rad]
  double theta = 0.0;   ///< pitch [rad]
  double thrust = 0.0;  ///< T [N], eq. (5)
};

/// Everything that (1) needs to follow a motion with given derivatives.
struct FlatInputs {
  Attitude attitude;
  double phi_rate = 0.0;                   ///< [rad/s]
  double theta_rate = 0.0;                 ///< [rad/s]
  double tau_phi = 0.0;                    ///< [N m]
  double tau_theta = 0.0;                  ///< [N m]
  Vector4 rotor_speeds = Vector4::Zero();  ///< after saturation [rad/s]
  bool saturated = false;                  ///< a rotor speed was clamped
};

/// A of (3): acceleration plus drag over mass [m/s^2].
Vector3 thrustAcceleration(const Vector3& v, const Vector3& a, const VehicleParameters& vehicle);

/// T of (5) [N].
double thrust(const Vector3& v, const Vector3& a, const VehicleParameters& vehicle);

/// Inverts (4): phi = atan2(-A_y, sqrt(A_x^2 + (A_z+g)^2)), theta = atan2(A_x, A_z+g), T by (5).
Attitude attitudeFor(const Vector3& v, const Vector3& a, const VehicleParameters& vehicle);

/// Rotor speeds for a wrench, closed by zero yaw moment:
/// k w^2_{1,3} = T/4 +- tau_phi/(2L), k w^2_{2,4} = T/4 +- tau_theta/(2L). Saturates at [0, max_rotor_speed].
Vector4 rotorSpeeds(double thrust, double tau_phi, double tau_theta, const VehicleParameters& vehicle,
                    bool* saturated = nullptr);

/// The whole inversion; within a segment of constant jerk `snap` [m/s^4] is zero.
FlatInputs flatInputs(const Vector3& v, const Vector3& a, const Vector3& jerk, const VehicleParameters& vehicle,
                      const Vector3& snap = Vector3::Zero());

}  // namespace swarm_planner
