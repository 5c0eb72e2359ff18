// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstdint>

#include "swarm_planner/model/trajectory.hpp"

namespace swarm_planner {

/// What a constraint row of a stage touches: a 3-vector y that is linear in the stage's state (p, v, a).
/// The control points are those of the segment that starts at the stage (Bernstein form, exact for
/// constant jerk); its last control points are the next stage's p and v.
enum class Output : std::uint8_t {
  kPosition,              ///< p
  kControlPoint1,         ///< p + dt/3 v
  kControlPoint2,         ///< p + 2 dt/3 v + dt^2/6 a
  kVelocity,              ///< v
  kVelocityControlPoint,  ///< v + dt/2 a
  kAcceleration,          ///< a
  kThrustAcceleration,    ///< a + k_d / M v, A of (3)
};
constexpr int kOutputCount = 7;

/// y = p_gain p + v_gain v + a_gain a of one output.
struct OutputGains {
  double p = 0.0;
  double v = 0.0;  ///< [s], or [1/s] for the thrust
  double a = 0.0;
};

/// The output's value at a state.
inline Vector3 outputValue(const OutputGains& gains, const KinematicState& x) {
  return gains.p * x.p + gains.v * x.v + gains.a * x.a;
}

/// What stays the same from QP to QP, so that a solver can compute tables from it beforehand.
struct QpModel {
  double dt = 0.0;                         ///< [s]
  double along_weight = 0.0;               ///< of 1/2 (first axis . p)^2, > 0
  double across_weight = 0.0;              ///< of 1/2 (second axis . p)^2 and 1/2 (third axis . p)^2, > 0
  double velocity_weight = 0.0;            ///< of 1/2 |v|^2 at the stages before the last, >= 0
  double final_velocity_weight = 0.0;      ///< of 1/2 |v|^2 at the last stage, >= 0
  double final_acceleration_weight = 0.0;  ///< of 1/2 |a|^2 at the last stage, >= 0; there is none before
  double jerk_weight = 0.0;                ///< of 1/2 |jerk|^2, > 0
  double drag_over_mass = 0.0;             ///< of the thrust output [1/s]
  double slack_linear = 0.0;               ///< > 0
  double slack_quadratic = 0.0;            ///< > 0
  bool holds_acceleration = false;         ///< of the dynamics: Trajectory::holds_acceleration

  /// Weights of 1/2 |v|^2 and 1/2 |a|^2 at stage 1..N.
  double velocityWeight(int stage) const { return stage == kHorizon ? final_velocity_weight : velocity_weight; }
  double accelerationWeight(int stage) const { return stage == kHorizon ? final_acceleration_weight : 0.0; }
  std::array<OutputGains, kOutputCount> outputs() const;
  bool operator==(const QpModel& other) const;
};

}  // namespace swarm_planner
