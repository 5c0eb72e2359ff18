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
  kThrustAcceleration,    ///< a + diag(k_d / M) v, A of (3)
};
constexpr int kOutputCount = 7;

/// y = p_gain p + v_gain o v + a_gain a of one output (o: per axis).
struct OutputGains {
  double p = 0.0;
  Vector3 v = Vector3::Zero();  ///< [s] or as the output needs
  double a = 0.0;
};

/// Gains of every output for a sampling time `dt` [s]; `drag_over_mass` [1/s].
std::array<OutputGains, kOutputCount> makeOutputGains(double dt, const Vector3& drag_over_mass);

/// The output's value at a state.
inline Vector3 outputValue(const OutputGains& gains, const KinematicState& x) {
  return gains.p * x.p + gains.v.cwiseProduct(x.v) + gains.a * x.a;
}

/// Soft half-space n . y + s >= d, s >= 0 with penalty slack_linear s + 1/2 slack_quadratic s^2.
struct QpRow {
  Vector3 n = Vector3::Zero();
  double d = 0.0;
  Output output = Output::kPosition;
};

/// Most rows that one stage can hold.
constexpr int kMaxStageRows = 128;

/// One stage k = 1..N: 1/2 p' Hp p + gp . p + 1/2 wv |v|^2 + gv . v, and its rows.
struct QpStage {
  Matrix3 position_hessian = Matrix3::Zero();  ///< positive semi-definite
  Vector3 position_gradient = Vector3::Zero();
  Vector3 velocity_gradient = Vector3::Zero();
  int row_count = 0;
  std::array<QpRow, kMaxStageRows> rows;
};

/// The quadratic program of one UAV: minimise the stages' costs plus 1/2 wj |j_k|^2 over the jerks j_0..j_{N-1},
/// x_{k+1} = propagate(x_k, j_k, dt), x_0 given. Always feasible since every row is soft.
struct Qp {
  KinematicState start;
  double dt = 0.0;               ///< [s]
  double velocity_weight = 0.0;  ///< wv >= 0
  double jerk_weight = 0.0;      ///< wj > 0
  double slack_linear = 0.0;     ///< > 0
  double slack_quadratic = 0.0;  ///< > 0
  std::array<OutputGains, kOutputCount> outputs;
  std::array<QpStage, kHorizon + 1> stages;  ///< stage 0 is not used: x_0 is fixed

  void clearRows();
  /// Appends a row to stage 1..N; false if the stage is full.
  bool addRow(int stage, Output output, const Vector3& n, double d);
  int rowCount() const;
};

/// How a solve ended.
enum class QpStatus : std::uint8_t {
  kSolved,
  kIterationLimit,  ///< the answer is the best found, its residuals above tolerance
  kNotFinite,       ///< the data hold a NaN or infinity; no answer
};

struct QpSolution {
  QpStatus status = QpStatus::kNotFinite;
  int iterations = 0;
  double max_slack = 0.0;
  std::array<Vector3, kHorizon> jerks;
  /// Multiplier of each row, in [0, slack_linear + slack_quadratic s]; same layout as Qp::stages[k].rows.
  std::array<std::array<double, kMaxStageRows>, kHorizon + 1> multipliers;
};

/// A solver of Qp. One object per thread; keeps its memory; never allocates while solving.
class QpSolver {
 public:
  virtual ~QpSolver() = default;
  virtual QpStatus solve(const Qp& qp, QpSolution& solution) = 0;
};

}  // namespace swarm_planner
