// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

std::array<OutputGains, kOutputCount> QpModel::outputs() const {
  std::array<OutputGains, kOutputCount> gains;
  const auto set = [&gains](Output output, double p, double v, double a) {
    gains[static_cast<std::size_t>(output)] = {p, v, a};
  };
  set(Output::kPosition, 1.0, 0.0, 0.0);
  set(Output::kControlPoint1, 1.0, dt / 3.0, 0.0);
  set(Output::kControlPoint2, 1.0, 2.0 * dt / 3.0, dt * dt / 6.0);
  set(Output::kVelocity, 0.0, 1.0, 0.0);
  set(Output::kVelocityControlPoint, 0.0, 1.0, dt / 2.0);
  set(Output::kAcceleration, 0.0, 0.0, 1.0);
  set(Output::kThrustAcceleration, 0.0, drag_over_mass, 1.0);
  return gains;
}

bool QpModel::operator==(const QpModel& other) const {
  return dt == other.dt && along_weight == other.along_weight && across_weight == other.across_weight &&
         velocity_weight == other.velocity_weight && final_velocity_weight == other.final_velocity_weight &&
         final_acceleration_weight == other.final_acceleration_weight && jerk_weight == other.jerk_weight &&
         drag_over_mass == other.drag_over_mass && slack_linear == other.slack_linear &&
         slack_quadratic == other.slack_quadratic && holds_acceleration == other.holds_acceleration;
}

void Qp::setModel(const QpModel& new_model) {
  model = new_model;
  outputs = new_model.outputs();
}

void Qp::clear() {
  curvature_count = 0;
  for (QpStage& stage : stages) {
    stage.row_count = 0;
    stage.output_rows.fill(0);
  }
}

void ActiveRows::insert(const ActiveRow& row) {
  if (count == kCapacity) return;
  auto place = static_cast<std::size_t>(count++);
  for (; place > 0 && rows[place - 1].stage > row.stage; --place) rows[place] = rows[place - 1];
  rows[place] = row;
}

void ActiveRows::shift(int stages) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    ActiveRow row = rows[static_cast<std::size_t>(i)];
    if (row.stage <= stages) continue;
    row.stage = static_cast<std::int8_t>(row.stage - stages);
    rows[static_cast<std::size_t>(kept++)] = row;
  }
  count = kept;
}

bool Qp::addRow(int stage, Output output, const Vector3& n, double d, RowSource source) {
  QpStage& target = stages[static_cast<std::size_t>(stage)];
  int& count = target.output_rows[static_cast<std::size_t>(output)];
  if (count == (output <= Output::kControlPoint2 ? kMaxBodyRows : kMaxLimitRows)) return false;
  ++count;
  QpRow& row = target.rows[static_cast<std::size_t>(target.row_count++)];
  row.n = n;
  row.d = d;
  row.output = output;
  row.source = source;
  return true;
}

bool Qp::addCurvature(int stage, const Vector3& n, double weight) {
  if (curvature_count == kMaxCurvatures) return false;
  curvatures[static_cast<std::size_t>(curvature_count++)] = {stage, n, weight};
  return true;
}

int Qp::rowCount() const {
  int count = 0;
  for (const QpStage& stage : stages) count += stage.row_count;
  return count;
}

double Qp::objective(const Trajectory& plan) const {
  const Matrix3 to_axes = axes.transpose();
  const Vector3 weights(model.along_weight, model.across_weight, model.across_weight);
  double smooth = 0.0;
  double slack = 0.0;
  double squared_slack = 0.0;
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const QpStage& stage = stages[k];
    const KinematicState& x = plan.knots[k];
    const int number = static_cast<int>(k);
    smooth += 0.5 * weights.dot((to_axes * x.p).cwiseAbs2()) + stage.position_gradient.dot(x.p) +
              0.5 * model.velocityWeight(number) * x.v.squaredNorm() + stage.velocity_gradient.dot(x.v) +
              0.5 * model.accelerationWeight(number) * x.a.squaredNorm() +
              0.5 * model.jerk_weight * plan.jerks[k - 1].squaredNorm();
    for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) {
      const QpRow& row = stage.rows[i];
      const double lacking = row.d - row.n.dot(outputValue(outputs[static_cast<std::size_t>(row.output)], x));
      if (lacking <= 0.0) continue;
      slack += lacking;
      squared_slack += lacking * lacking;
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(curvature_count); ++i) {
    const double along = curvatures[i].n.dot(plan.knots[static_cast<std::size_t>(curvatures[i].stage)].p);
    smooth += 0.5 * curvatures[i].weight * along * along;
  }
  return smooth + model.slack_linear * slack + 0.5 * model.slack_quadratic * squared_slack;
}

Matrix3 Qp::positionHessian(int stage) const {
  const Vector3 weights(model.along_weight, model.across_weight, model.across_weight);
  Matrix3 hessian = axes * weights.asDiagonal() * axes.transpose();
  for (std::size_t i = 0; i < static_cast<std::size_t>(curvature_count); ++i) {
    const QpCurvature& term = curvatures[i];
    if (term.stage == stage) hessian += term.weight * term.n * term.n.transpose();
  }
  return hessian;
}

}  // namespace swarm_planner
