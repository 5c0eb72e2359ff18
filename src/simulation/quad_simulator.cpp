// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/quad_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "swarm_planner/model/flat_inputs.hpp"

namespace swarm_planner {
namespace {

/// Share of the rotors' full thrust that the position controller may ask for; the rest turns the vehicle.
constexpr double kThrustShare = 0.9;
/// Least share of the weight that is carried upwards, so that the commanded attitude stays upright.
constexpr double kMinLift = 0.2;
/// Commands that differ by less [m/s^2] are not limited.
constexpr double kSameAcceleration = 1e-9;
/// Jerk jumps between the stages of a plan, and with it the angular velocity: the turn is spread over this much time
/// before and after [s].
constexpr double kTurnTime = 0.05;
static_assert(kTurnTime <= kSetpointMemory, "what was asked for at the beginning of the turn is not known");

/// A unit vector, uniform on the sphere.
Vector3 direction(std::uint64_t seed) { return GaussianNoise(seed).vector(1.0).normalized(); }

}  // namespace

QuadSimulator::QuadSimulator(const Parameters& parameters, const Vector3& start, std::uint64_t seed, std::size_t index)
    : vehicle_(parameters.vehicle),
      simulation_(parameters.simulation),
      gusts_(simulation_.wind, simulation_.gust_time, streamSeed(seed, RandomUse::kGusts, index)),
      setpoints_(start),
      position_noise_(streamSeed(seed, RandomUse::kPositionNoise, index)),
      velocity_noise_(streamSeed(seed, RandomUse::kVelocityNoise, index)),
      position_bias_(simulation_.position_bias * direction(streamSeed(seed, RandomUse::kPositionBias, index))) {
  state_.p = start;
  rotor_speeds_ = swarm_planner::rotorSpeeds(vehicle_.mass * vehicle_.gravity, 0.0, 0.0, vehicle_);
}

bool QuadSimulator::receive(const SetpointTrajectory& trajectory) { return setpoints_.receive(trajectory, time_); }

void QuadSimulator::advanceTo(double t) {
  if (!std::isfinite(t)) return;
  if (!clock_set_) setClock(t);
  if (t <= time_) return;
  constexpr double kRounding = 1e-9;  // a whole number of steps must not become one more
  const auto steps = std::max<long long>(1, std::llround(std::ceil((t - time_) / simulation_.step - kRounding)));
  const double begin = time_;
  const double dt = (t - begin) / static_cast<double>(steps);
  for (long long step = 1; step <= steps; ++step) {
    wind_ = gusts_.at(time_);
    control();
    state_ = stepRungeKutta4(state_, rotor_speeds_, externalAcceleration(), dt, vehicle_);
    time_ = step == steps ? t : begin + static_cast<double>(step) * dt;
  }
}

void QuadSimulator::setClock(double t) {
  time_ = t;
  clock_set_ = true;
  gusts_.resetClock(t);
}

void QuadSimulator::resetClock(double t) {
  setClock(t);
  setpoints_.hold(state_.p);
}

void QuadSimulator::setDisturbance(const Vector3& acceleration) {
  if (!acceleration.allFinite()) throw std::invalid_argument("QuadSimulator: the disturbance is not finite");
  disturbance_ = acceleration;
}

void QuadSimulator::push(const Vector3& dv) {
  if (!dv.allFinite()) throw std::invalid_argument("QuadSimulator: the push is not finite");
  state_.v += dv;
}

void QuadSimulator::brake(double deceleration) {
  constexpr int kPoints = 20;
  setpoints_.hold(state_.p);
  const double speed = state_.v.norm();
  const double duration = speed / deceleration;
  if (duration < kPoints * 1e-3) return;
  SetpointTrajectory stop;
  stop.epoch = time_;
  for (int i = 0; i <= kPoints; ++i) {
    const double left = 1.0 - static_cast<double>(i) / kPoints;  // of the speed
    Setpoint point;
    point.time_from_start = duration * (1.0 - left);
    point.p = state_.p + 0.5 * duration * (1.0 - left * left) * state_.v;
    point.v = left * state_.v;
    point.a = -(deceleration / speed) * state_.v;
    stop.points.push_back(point);
  }
  setpoints_.receive(stop, time_);
}

Vector3 QuadSimulator::acceleration() const {
  return dynamics(state_, rotorWrench(rotor_speeds_, vehicle_), externalAcceleration(), vehicle_).v;
}

Vector3 QuadSimulator::externalAcceleration() const {
  return disturbance_ + vehicle_.dragOverMass().cwiseProduct(wind_);
}

double QuadSimulator::thrust() const { return rotorWrench(rotor_speeds_, vehicle_).thrust; }

UavMeasurement QuadSimulator::measure() {
  UavMeasurement measurement;
  measurement.received = true;
  measurement.stamp = time_;
  measurement.p = state_.p + position_bias_;
  measurement.v = state_.v;
  if (simulation_.position_noise > 0.0) measurement.p += position_noise_.vector(simulation_.position_noise);
  if (simulation_.velocity_noise > 0.0) measurement.v += velocity_noise_.vector(simulation_.velocity_noise);
  return measurement;
}

void QuadSimulator::control() {
  const MotionSetpoint wanted = setpoints_.at(time_);
  const Vector3 acceleration_command =
      wanted.a + simulation_.position_gain * (wanted.p - state_.p) + simulation_.velocity_gain * (wanted.v - state_.v);
  const Vector3 drag_acceleration = vehicle_.dragOverMass().cwiseProduct(state_.v);
  const Vector3 limited = limitedThrustAcceleration(acceleration_command + drag_acceleration) - drag_acceleration;
  // The attitude turns with the setpoint's jerk and with the feedback: without the latter's rate it would lag behind
  // every correction. Where the limits cut in the command stands still instead.
  Vector3 jerk_command = Vector3::Zero();
  Vector3 snap_command = Vector3::Zero();
  if ((limited - acceleration_command).norm() < kSameAcceleration) {
    const MotionSetpoint before = setpoints_.at(time_ - kTurnTime);
    const MotionSetpoint after = setpoints_.at(time_ + kTurnTime);
    jerk_command = (after.a - before.a) / (2.0 * kTurnTime) + simulation_.position_gain * (wanted.v - state_.v) +
                   simulation_.velocity_gain * (wanted.a - acceleration());
    snap_command = (after.jerk - before.jerk) / (2.0 * kTurnTime);
  }
  const FlatInputs flat = flatInputs(state_.v, limited, jerk_command, vehicle_, snap_command);

  const double tau_phi = flat.tau_phi + vehicle_.inertia_x * attitudeFeedback(flat.attitude.phi - state_.phi,
                                                                              flat.phi_rate - state_.phi_rate);
  const double tau_theta = flat.tau_theta + vehicle_.inertia_y * attitudeFeedback(flat.attitude.theta - state_.theta,
                                                                                  flat.theta_rate - state_.theta_rate);
  rotor_speeds_ = swarm_planner::rotorSpeeds(flat.attitude.thrust, tau_phi, tau_theta, vehicle_, &saturated_);
}

double QuadSimulator::attitudeFeedback(double angle_error, double rate_error) const {
  return simulation_.attitude_gain * angle_error + simulation_.attitude_rate_gain * rate_error;
}

Vector3 QuadSimulator::limitedThrustAcceleration(const Vector3& wanted) const {
  const double full_thrust = 4.0 * vehicle_.force_constant * vehicle_.max_rotor_speed * vehicle_.max_rotor_speed;
  const double most = kThrustShare * full_thrust / vehicle_.mass;  // of |A + g e3| [m/s^2]
  // Height comes first: it keeps the vehicle off the ground while a large sideways error is worked off.
  const double lift = std::clamp(wanted.z() + vehicle_.gravity, std::min(kMinLift * vehicle_.gravity, most), most);
  const double sideways = std::hypot(wanted.x(), wanted.y());
  const double allowed = std::min(std::sqrt(most * most - lift * lift), lift * std::tan(simulation_.max_tilt));
  const double scale = sideways > allowed ? allowed / sideways : 1.0;
  return Vector3(scale * wanted.x(), scale * wanted.y(), lift - vehicle_.gravity);
}

}  // namespace swarm_planner
