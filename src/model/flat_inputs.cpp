// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/model/flat_inputs.hpp"

#include <cmath>

namespace swarm_planner {

namespace {

/// A quantity with its first two time derivatives.
struct Jet {
  double value;
  double first;
  double second;
};

/// sqrt(x^2 + y^2) > 0.
Jet norm(const Jet& x, const Jet& y) {
  Jet n;
  n.value = std::hypot(x.value, y.value);
  n.first = (x.value * x.first + y.value * y.first) / n.value;
  n.second =
      (x.first * x.first + y.first * y.first + x.value * x.second + y.value * y.second - n.first * n.first) / n.value;
  return n;
}

/// atan2(y, x), (x, y) != 0.
Jet angle(const Jet& y, const Jet& x) {
  const double squared = x.value * x.value + y.value * y.value;
  Jet angle;
  angle.value = std::atan2(y.value, x.value);
  angle.first = (x.value * y.first - y.value * x.first) / squared;
  angle.second =
      (x.value * y.second - y.value * x.second - 2.0 * angle.first * (x.value * x.first + y.value * y.first)) / squared;
  return angle;
}

/// Where the thrust acceleration in the x-z plane is below this [m/s^2], in free fall or with the thrust along y,
/// pitch is undefined and so are the rates: they are set to zero.
constexpr double kFreeFall = 1e-6;

}  // namespace

Vector3 thrustAcceleration(const Vector3& v, const Vector3& a, const VehicleParameters& vehicle) {
  return a + vehicle.dragOverMass().cwiseProduct(v);
}

double thrust(const Vector3& v, const Vector3& a, const VehicleParameters& vehicle) {
  return vehicle.mass * (thrustAcceleration(v, a, vehicle) + vehicle.gravity * upward()).norm();
}

Attitude attitudeFor(const Vector3& v, const Vector3& a, const VehicleParameters& vehicle) {
  const Vector3 lift = thrustAcceleration(v, a, vehicle) + vehicle.gravity * upward();
  Attitude attitude;
  attitude.phi = std::atan2(-lift.y(), std::hypot(lift.x(), lift.z()));
  attitude.theta = std::atan2(lift.x(), lift.z());
  attitude.thrust = vehicle.mass * lift.norm();
  return attitude;
}

Vector4 rotorSpeeds(double thrust, double tau_phi, double tau_theta, const VehicleParameters& vehicle,
                    bool* saturated) {
  const double quarter = 0.25 * thrust;
  const double roll = tau_phi / (2.0 * vehicle.arm_length);
  const double pitch = tau_theta / (2.0 * vehicle.arm_length);
  const Vector4 force(quarter + roll, quarter + pitch, quarter - roll, quarter - pitch);
  const double max_force = vehicle.force_constant * vehicle.max_rotor_speed * vehicle.max_rotor_speed;
  if (saturated != nullptr) *saturated = force.minCoeff() < 0.0 || force.maxCoeff() > max_force;
  return (force.cwiseMax(0.0).cwiseMin(max_force) / vehicle.force_constant).cwiseSqrt();
}

FlatInputs flatInputs(const Vector3& v, const Vector3& a, const Vector3& jerk, const VehicleParameters& vehicle,
                      const Vector3& snap) {
  FlatInputs inputs;
  inputs.attitude = attitudeFor(v, a, vehicle);

  const Vector3 drag = vehicle.dragOverMass();
  const Vector3 lift = thrustAcceleration(v, a, vehicle) + vehicle.gravity * upward();
  const Vector3 lift_first = jerk + drag.cwiseProduct(a);
  const Vector3 lift_second = snap + drag.cwiseProduct(jerk);
  if (std::hypot(lift.x(), lift.z()) > kFreeFall) {
    const Jet x{lift.x(), lift_first.x(), lift_second.x()};
    const Jet z{lift.z(), lift_first.z(), lift_second.z()};
    const Jet minus_y{-lift.y(), -lift_first.y(), -lift_second.y()};
    const Jet theta = angle(x, z);
    const Jet phi = angle(minus_y, norm(x, z));
    inputs.phi_rate = phi.first;
    inputs.theta_rate = theta.first;
    inputs.tau_phi = vehicle.inertia_x * phi.second;
    inputs.tau_theta = vehicle.inertia_y * theta.second;
  }
  inputs.rotor_speeds =
      rotorSpeeds(inputs.attitude.thrust, inputs.tau_phi, inputs.tau_theta, vehicle, &inputs.saturated);
  return inputs;
}

}  // namespace swarm_planner
