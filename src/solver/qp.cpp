// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

std::array<OutputGains, kOutputCount> makeOutputGains(double dt, const Vector3& drag_over_mass) {
  const auto equal = [](double gain) { return Vector3(gain, gain, gain); };
  std::array<OutputGains, kOutputCount> gains;
  const auto set = [&gains](Output output, double p, const Vector3& v, double a) {
    gains[static_cast<std::size_t>(output)] = {p, v, a};
  };
  set(Output::kPosition, 1.0, equal(0.0), 0.0);
  set(Output::kControlPoint1, 1.0, equal(dt / 3.0), 0.0);
  set(Output::kControlPoint2, 1.0, equal(2.0 * dt / 3.0), dt * dt / 6.0);
  set(Output::kVelocity, 0.0, equal(1.0), 0.0);
  set(Output::kVelocityControlPoint, 0.0, equal(1.0), dt / 2.0);
  set(Output::kAcceleration, 0.0, equal(0.0), 1.0);
  set(Output::kThrustAcceleration, 0.0, drag_over_mass, 1.0);
  return gains;
}

void Qp::clearRows() {
  for (QpStage& stage : stages) stage.row_count = 0;
}

bool Qp::addRow(int stage, Output output, const Vector3& n, double d) {
  QpStage& target = stages[static_cast<std::size_t>(stage)];
  if (target.row_count == kMaxStageRows) return false;
  QpRow& row = target.rows[static_cast<std::size_t>(target.row_count++)];
  row.n = n;
  row.d = d;
  row.output = output;
  return true;
}

int Qp::rowCount() const {
  int count = 0;
  for (const QpStage& stage : stages) count += stage.row_count;
  return count;
}

}  // namespace swarm_planner
