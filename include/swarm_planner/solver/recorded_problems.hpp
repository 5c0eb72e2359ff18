// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

namespace swarm_planner {

/// One QP of a "QMPCQP01" file, as recorded (single precision), with its optimum. Index order: stage, row, component.
struct RecordedProblem {
  std::vector<float> p0, v0, a_previous;  ///< 3 each
  std::vector<float> p_ref, v_ref;        ///< [N][3], stages 1..N
  std::vector<float> normal;              ///< c [N][m][3], stages 1..N
  std::vector<float> offset;              ///< d [N][m]
  std::vector<float> thrust_normal;       ///< n [N][3], stages 0..N-1
  std::vector<float> thrust_offset;       ///< t [N]
  std::vector<float> warm_input;          ///< [N][3]
  std::vector<float> warm_half_space;     ///< multipliers [N][m]
  std::vector<float> warm_velocity;       ///< [N][6]: lower xyz, upper xyz
  std::vector<float> warm_acceleration;   ///< [N][6]
  std::vector<float> warm_thrust;         ///< [N]
  double optimal_cost = 0.0;
  std::vector<double> optimal_input;  ///< [N][3]
};

struct RecordedProblems {
  int horizon = 0;  ///< N
  int rows = 0;     ///< m, half-spaces per stage
  std::vector<RecordedProblem> problems;
};

/// @throws std::runtime_error if the file cannot be read, is of another kind, or too short
RecordedProblems readRecordedProblems(const std::string& path);

/// Constants of the recorded problems.
namespace recorded {
constexpr double kTimeStep = 0.3;  ///< [s]
constexpr double kPositionWeight = 1.0, kFinalPositionWeight = 5.0;
constexpr double kVelocityWeight = 0.3, kFinalVelocityWeight = 1.0;
constexpr double kInputWeight = 0.1, kRateWeight = 0.4;
constexpr double kLinearPenalty = 50.0, kQuadraticPenalty = 100.0;
constexpr double kMaxVelocity[3] = {4.0, 4.0, 2.0};
constexpr double kMaxAcceleration[3] = {5.0, 5.0, 4.0};
}  // namespace recorded

/// Multipliers of every row, laid out as RecordedProblem's warm start.
struct RecordedMultipliers {
  std::vector<double> half_space, velocity, acceleration, thrust;
};

/// The objective of the controls `input` [N][3]: states by roll-out, slack = max(0, d - c . p).
double recordedCost(const RecordedProblems& file, const RecordedProblem& problem, const std::vector<double>& input);

/// Largest violation of the optimality conditions: gradient of the Lagrangian in the controls, rows, signs and
/// ranges of multipliers, and complementarity.
double recordedKktResidual(const RecordedProblems& file, const RecordedProblem& problem,
                           const std::vector<double>& input, const RecordedMultipliers& multipliers);

}  // namespace swarm_planner
