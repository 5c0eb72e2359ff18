// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimality/second_order.hpp"
#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// A UavProblem written down a second time, as a smooth nonlinear program with exact derivatives; it shares data with
/// the planner's, no formula. References have to be one straight line.
///
/// Variables: the jerks (with as_paper the changes of the acceleration over dt); a slack for every constraint, with the
/// linear and quadratic penalty of the planner's merit; and for every separating plane the point where it touches the
/// body: a point of an obstacle's surface (7), or a unit vector of the ball that a pair ellipsoid is in shrunk
/// coordinates. With as_paper there are no planes: (7) and (14) hold at the samples as they stand.
class ReferenceProgram {
 public:
  static constexpr int kInputs = 3 * kHorizon;
  /// Of a constraint: the output that it touches, then the plane's point.
  using Local = SecondOrder<6>;
  using Gains = Eigen::Matrix<double, 3, kInputs>;

  /// y = free + gains u, one of the plan's points or rates.
  struct Output {
    Vector3 free;
    Gains gains;
  };

  struct Row {
    enum class Kind { kNorm, kAtLeast, kLogarithm, kBall, kObstaclePlane, kPairPlane, kSurface, kUnitLength };
    Kind kind = Kind::kNorm;
    int output = -1;
    int plane = -1;
    int slack = -1;                    ///< none: an equality
    Vector3 offset = Vector3::Zero();  ///< the body's reference point, or what a norm's centre is off [m, m/s^2]
    double limit = 0.0;
    int body = -1;
  };

  /// `problem` has to outlive this. A body's segment gets constraints if `isNear(body, segment)`.
  template <class IsNear>
  ReferenceProgram(const UavProblem& problem, const IsNear& isNear) : problem_(problem) {
    makeOutputs();
    addBoundRows();
    for (std::size_t body = 0; body < problem.bodies.size(); ++body) {
      for (int segment = 0; segment < kHorizon; ++segment) {
        if (isNear(body, segment)) addBodyRows(static_cast<int>(body), segment);
      }
    }
  }

  int slackCount() const { return slacks_; }
  int planeCount() const { return planes_; }
  int variableCount() const { return kInputs + slacks_ + 3 * planes_; }
  int slackIndex(int slack) const { return kInputs + slack; }
  int planeIndex(int plane) const { return kInputs + slacks_ + 3 * plane; }
  const std::vector<Row>& rows() const { return rows_; }
  const Output& output(const Row& row) const { return outputs_[static_cast<std::size_t>(row.output)]; }

  /// A start for all variables at a plan: planes towards it, slacks that satisfy the rows.
  Eigen::VectorXd startAt(const Trajectory& plan) const;
  /// The plan of these variables.
  Trajectory planOf(const Eigen::VectorXd& z) const;

  /// Cost (17) plus penalties; derivatives where asked for. The Hessian is that of the jerks alone, without penalties.
  double objective(const Eigen::VectorXd& z) const;
  Eigen::VectorXd gradient(const Eigen::VectorXd& z) const;
  Eigen::MatrixXd inputHessian(const Eigen::VectorXd& z) const;
  double slackLinear() const { return problem_.parameters->sqp.slack_linear; }
  double slackQuadratic() const { return problem_.parameters->sqp.slack_quadratic; }

  /// A row without its slack: >= 0, or == 0 of an equality.
  Local value(const Row& row, const Eigen::VectorXd& z) const;

 private:
  using Stage = SecondOrder<9>;  ///< of p, v and a at one stage

  void makeOutputs();
  int addOutput(const Vector3& free, const Gains& gains);
  void addBoundRows();
  void addBodyRows(int body, int segment);
  Row bodyRow(int body, int segment, int point) const;
  void addRow(Row row);
  Vector3 valueOf(int output, const Eigen::VectorXd& z) const;
  Vector3 touchPoint(const Row& row, const Eigen::VectorXd& z) const;
  Vector3 shrinkage() const;
  Stage stageCost(int stage, const Eigen::VectorXd& z) const;
  Stage robustness(int stage, const std::array<Stage, 9>& x) const;

  const UavProblem& problem_;
  std::vector<Output> outputs_;
  std::array<std::array<int, 4>, kHorizon> points_{};      ///< outputs: control points of each segment
  std::array<std::array<int, 3>, kHorizon + 1> states_{};  ///< outputs: p, v, a of each stage
  std::vector<Row> rows_;
  int slacks_ = 0;
  int planes_ = 0;
};

}  // namespace swarm_planner
