// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/model/dynamics.hpp"
#include "swarm_planner/simulation/gaussian_noise.hpp"
#include "swarm_planner/simulation/gusts.hpp"
#include "swarm_planner/simulation/setpoint_track.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// One UAV that flies the reduced dynamics (1) closed loop.
///
/// Controller, once per integration step with the rotor speeds held over it:
///   a_c = a_s + position_gain (p_s - p) + velocity_gain (v_s - v)      commanded acceleration, s: setpoint
///   A   = a_c + (k_d / M) v                                            drag compensated, eq. (3)
///   phi, theta, T from A by (4) and (5), after A is limited to what the rotors and max_tilt allow;
///   angular accelerations: those of the flat inputs plus attitude_gain and attitude_rate_gain on the errors. Jerk and
///   snap of the setpoint are means over a short time before and after: the vehicle turns in time for jumps of jerk.
/// Rotor speeds saturate at [0, max_rotor_speed]. The state stays finite whatever is received.
///
/// Gusts of wind velocity w act through the drag of (1), -(k_d / M) (v - w); the controller does not know of them.
class QuadSimulator {
 public:
  /// Hovers at `start` [m]. `seed` is that of the run; sensor noise, bias and gusts are those of UAV `index` in it.
  QuadSimulator(const Parameters& parameters, const Vector3& start, std::uint64_t seed, std::size_t index = 0);

  /// A trajectory has arrived; it takes over at its epoch (see SetpointTrack). False, and the vehicle flies on as
  /// before, if it holds a non-finite number, no points, or times that do not increase.
  bool receive(const SetpointTrajectory& trajectory);

  /// Flies on until `t` [s] in equal steps of at most SimulationParameters::step. The first call only sets the clock;
  /// a `t` that is not finite or not later than time() does nothing. No heap allocation.
  void advanceTo(double t);

  /// Time has jumped: sets the clock to `t` [s], forgets every trajectory and holds the present position.
  void resetClock(double t);

  /// An acceleration [m/s^2] that acts on the vehicle from now on, beside the gusts. Throws std::invalid_argument if it
  /// is not finite.
  void setDisturbance(const Vector3& acceleration);

  /// A kick: the velocity changes by `dv` [m/s] at once. Throws std::invalid_argument if it is not finite.
  void push(const Vector3& dv);

  /// Forgets every trajectory, brakes along its way at `deceleration` [m/s^2] > 0 and hovers there until a new one
  /// takes over.
  void brake(double deceleration);

  double time() const { return time_; }
  const QuadState& state() const { return state_; }
  /// Acceleration of the vehicle under the present rotor speeds [m/s^2].
  Vector3 acceleration() const;
  /// T of the present rotor speeds [N].
  double thrust() const;
  /// The rotor speeds of the last step [rad/s].
  const Vector4& rotorSpeeds() const { return rotor_speeds_; }
  /// True if a rotor speed was clamped in the last step.
  bool saturated() const { return saturated_; }

  /// What the vehicle is asked to do at time().
  MotionSetpoint setpoint() const { return setpoints_.at(time_); }
  /// Distance of the vehicle from its setpoint at time() [m].
  double trackingError() const { return (setpoint().p - state_.p).norm(); }

  /// Wind velocity in the last step [m/s].
  const Vector3& wind() const { return wind_; }

  /// Position with the UAV's bias, and velocity, both with sensor noise; stamped time(). Each call draws new noise.
  UavMeasurement measure();

 private:
  void setClock(double t);
  void control();
  Vector3 externalAcceleration() const;                                  ///< of gusts and disturbance [m/s^2]
  double attitudeFeedback(double angle_error, double rate_error) const;  ///< angular acceleration [rad/s^2]
  Vector3 limitedThrustAcceleration(const Vector3& wanted) const;

  VehicleParameters vehicle_;
  SimulationParameters simulation_;
  double time_ = 0.0;
  bool clock_set_ = false;
  QuadState state_;
  Vector4 rotor_speeds_ = Vector4::Zero();
  bool saturated_ = false;
  Vector3 disturbance_ = Vector3::Zero();
  Gusts gusts_;
  Vector3 wind_ = Vector3::Zero();
  SetpointTrack setpoints_;
  GaussianNoise position_noise_, velocity_noise_;
  Vector3 position_bias_;  ///< [m]
};

}  // namespace swarm_planner
