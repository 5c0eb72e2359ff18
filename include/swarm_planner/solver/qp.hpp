// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstdint>

#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/solver/qp_model.hpp"

namespace swarm_planner {

/// Says what a row belongs to. Rows of one stage and output that mean the same thing in two QPs have the same one, so
/// that the rows that were active in the first can be recognised in the second.
using RowSource = std::uint32_t;

/// Soft half-space n . y + s >= d, s >= 0 with penalty slack_linear s + 1/2 slack_quadratic s^2.
struct QpRow {
  Vector3 n = Vector3::Zero();
  double d = 0.0;
  Output output = Output::kPosition;
  RowSource source = 0;
};

/// A row of stage 1..N that is active at an optimum.
struct ActiveRow {
  std::int8_t stage = 0;
  Output output = Output::kPosition;
  RowSource source = 0;
  double multiplier = 0.0;  ///< > 0
};

/// The active rows of a QP, sorted by stage; a guess of those of the next.
struct ActiveRows {
  static constexpr int kCapacity = 128;
  int count = 0;
  std::array<ActiveRow, kCapacity> rows;

  /// Puts a row where it belongs; drops it if there is no more room.
  void insert(const ActiveRow& row);
  /// Moves all `stages` stages towards the horizon's start; what passes it is dropped.
  void shift(int stages);
};

/// Curvature along one direction of a stage's position: 1/2 weight (n . p)^2.
struct QpCurvature {
  int stage = 1;
  Vector3 n = Vector3::Zero();  ///< unit
  double weight = 0.0;          ///< > 0
};

/// Most rows that one output of one stage can hold: obstacles and UAVs for the first three, limits for the others.
constexpr int kMaxBodyRows = 64;
constexpr int kMaxLimitRows = 32;
constexpr int kMaxStageRows = 3 * kMaxBodyRows + 4 * kMaxLimitRows;
/// Most curvature terms of a QP: every direction of every stage.
constexpr int kMaxCurvatures = 3 * kHorizon;

/// One stage k = 1..N: gp . p + gv . v and its rows.
struct QpStage {
  Vector3 position_gradient = Vector3::Zero();
  Vector3 velocity_gradient = Vector3::Zero();
  int row_count = 0;
  std::array<int, kOutputCount> output_rows{};  ///< how many rows touch each output
  std::array<QpRow, kMaxStageRows> rows;
};

/// The quadratic program of one UAV: minimise the stages' costs with the model's constant weights over the jerks
/// j_0..j_{N-1}, x_{k+1} = propagate(x_k, j_k, dt), or propagateHeld(x_k, x_k.a + dt j_k, dt) with the model's
/// holds_acceleration, x_0 given. Always feasible since every row is soft.
struct Qp {
  QpModel model;
  std::array<OutputGains, kOutputCount> outputs;  ///< the model's
  Matrix3 axes = Matrix3::Identity();             ///< orthonormal columns, in which the position weights hold
  KinematicState start;
  int curvature_count = 0;
  std::array<QpCurvature, kMaxCurvatures> curvatures;
  std::array<QpStage, kHorizon + 1> stages;  ///< stage 0 is not used: x_0 is fixed

  void setModel(const QpModel& new_model);
  void clear();  ///< no rows, no curvatures
  /// Appends a row to stage 1..N; false if there is no room for it.
  bool addRow(int stage, Output output, const Vector3& n, double d, RowSource source = 0);
  /// Appends a curvature term; false if there is no room for it.
  bool addCurvature(int stage, const Vector3& n, double weight);
  int rowCount() const;
  /// Objective of a plan, a roll-out of its jerks from `start`, with every row's slack at its best.
  double objective(const Trajectory& plan) const;
  /// Hessian in the position of stage 1..N: weights along the axes plus curvature terms.
  Matrix3 positionHessian(int stage) const;
};

/// How a solve ended.
enum class QpStatus : std::uint8_t {
  kSolved,
  kIterationLimit,  ///< the answer is the best found, its residuals above tolerance
  kNoAnswer,        ///< the data hold a NaN or infinity, or no method got anywhere
};

struct QpSolution {
  QpStatus status = QpStatus::kNoAnswer;
  int iterations = 0;      ///< changes of the active set, or Newton steps
  bool fell_back = false;  ///< the second method answered, since the first met its cap
  double max_slack = 0.0;
  std::array<Vector3, kHorizon> jerks;
  ActiveRows active;
};

/// A solver of Qp. One object per thread; keeps its memory; never allocates while solving.
class QpSolver {
 public:
  virtual ~QpSolver() = default;
  /// `solution.active` as it comes in is taken for a guess of the active rows, which changes the time, not the answer.
  virtual QpStatus solve(const Qp& qp, QpSolution& solution) = 0;
};

}  // namespace swarm_planner
