// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/model/dynamics.hpp"

#include <cmath>

namespace swarm_planner {

namespace {

/// x + h * rate, component by component; `rate` holds time derivatives.
QuadState advance(const QuadState& x, const QuadState& rate, double h) {
  QuadState next;
  next.p = x.p + h * rate.p;
  next.v = x.v + h * rate.v;
  next.phi = x.phi + h * rate.phi;
  next.theta = x.theta + h * rate.theta;
  next.phi_rate = x.phi_rate + h * rate.phi_rate;
  next.theta_rate = x.theta_rate + h * rate.theta_rate;
  return next;
}

}  // namespace

Wrench rotorWrench(const Vector4& rotor_speeds, const VehicleParameters& vehicle) {
  const Vector4 force = vehicle.force_constant * rotor_speeds.cwiseAbs2();
  Wrench wrench;
  wrench.thrust = force.sum();
  wrench.tau_phi = vehicle.arm_length * (force[0] - force[2]);
  wrench.tau_theta = vehicle.arm_length * (force[1] - force[3]);
  return wrench;
}

QuadState dynamics(const QuadState& x, const Wrench& wrench, const Vector3& disturbance,
                   const VehicleParameters& vehicle) {
  const double cos_phi = std::cos(x.phi);
  const Vector3 thrust_direction(cos_phi * std::sin(x.theta), -std::sin(x.phi), cos_phi * std::cos(x.theta));
  QuadState rate;
  rate.p = x.v;
  rate.v = (wrench.thrust / vehicle.mass) * thrust_direction - vehicle.dragOverMass().cwiseProduct(x.v) -
           vehicle.gravity * upward() + disturbance;
  rate.phi = x.phi_rate;
  rate.theta = x.theta_rate;
  rate.phi_rate = wrench.tau_phi / vehicle.inertia_x;
  rate.theta_rate = wrench.tau_theta / vehicle.inertia_y;
  return rate;
}

QuadState stepRungeKutta4(const QuadState& x, const Vector4& rotor_speeds, const Vector3& disturbance, double dt,
                          const VehicleParameters& vehicle) {
  const Wrench wrench = rotorWrench(rotor_speeds, vehicle);
  const QuadState k1 = dynamics(x, wrench, disturbance, vehicle);
  const QuadState k2 = dynamics(advance(x, k1, 0.5 * dt), wrench, disturbance, vehicle);
  const QuadState k3 = dynamics(advance(x, k2, 0.5 * dt), wrench, disturbance, vehicle);
  const QuadState k4 = dynamics(advance(x, k3, dt), wrench, disturbance, vehicle);
  QuadState next = advance(x, k1, dt / 6.0);
  next = advance(next, k2, dt / 3.0);
  next = advance(next, k3, dt / 3.0);
  return advance(next, k4, dt / 6.0);
}

}  // namespace swarm_planner
