// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/parameters.hpp"

namespace swarm_planner {

/// State of the reduced dynamic model (1): yaw and its derivatives are zero.
struct QuadState {
  Vector3 p = Vector3::Zero();  ///< [m], planning frame
  Vector3 v = Vector3::Zero();  ///< [m/s], planning frame
  double phi = 0.0;             ///< roll [rad]
  double theta = 0.0;           ///< pitch [rad]
  double phi_rate = 0.0;        ///< [rad/s]
  double theta_rate = 0.0;      ///< [rad/s]
};

/// Total thrust and torques that four rotor speeds [rad/s] produce; rotor order as in section 2.1:
/// 1 left (+y), 2 back (-x, see flat_inputs.hpp), 3 right (-y), 4 front (+x).
struct Wrench {
  double thrust = 0.0;     ///< T [N]
  double tau_phi = 0.0;    ///< [N m]
  double tau_theta = 0.0;  ///< [N m]
};
Wrench rotorWrench(const Vector4& rotor_speeds, const VehicleParameters& vehicle);

/// Time derivative of the state, eq. (1). `disturbance` is an acceleration [m/s^2] added to it (wind).
QuadState dynamics(const QuadState& x, const Wrench& wrench, const Vector3& disturbance,
                   const VehicleParameters& vehicle);

/// One step of the classical Runge-Kutta method of order 4 with constant rotor speeds.
QuadState stepRungeKutta4(const QuadState& x, const Vector4& rotor_speeds, const Vector3& disturbance, double dt,
                          const VehicleParameters& vehicle);

}  // namespace swarm_planner
