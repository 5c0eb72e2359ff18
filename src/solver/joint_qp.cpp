// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/joint_qp.hpp"

#include <algorithm>
#include <numeric>

namespace swarm_planner {

void ActivePairRows::shift(int stages) {
  rows.erase(std::remove_if(rows.begin(), rows.end(), [stages](const ActiveRow& row) { return row.stage <= stages; }),
             rows.end());
  for (ActiveRow& row : rows) row.stage = static_cast<std::int8_t>(row.stage - stages);
}

JointQp::JointQp() {
  for (std::size_t i = 0; i < kMostJointUavs; ++i) uavs.push_back(std::make_unique<Qp>());
  pair_rows.reserve(kMostPairRows);
}

void join(std::size_t first, std::size_t second, std::size_t count, JointComponents& components) {
  const std::size_t kept = std::min(components[first], components[second]);
  const std::size_t gone = std::max(components[first], components[second]);
  std::replace(components.begin(), components.begin() + static_cast<std::ptrdiff_t>(count), gone, kept);
}

JointComponents findComponents(const JointQp& qp) {
  JointComponents components{};
  std::iota(components.begin(), components.end(), std::size_t{0});
  for (const PairRow& row : qp.pair_rows) join(row.first, row.second, qp.count, components);
  return components;
}

double objective(const JointQp& qp, const std::vector<Trajectory>& plans, const JointComponents& components,
                 std::size_t component) {
  double sum = 0.0;
  for (std::size_t i = 0; i < qp.count; ++i) {
    if (components[i] == component && !qp.is_left[i]) sum += qp.uavs[i]->objective(plans[i]);
  }
  for (const PairRow& row : qp.pair_rows) {
    if (components[row.first] != component) continue;
    const OutputGains& gains = qp.uavs[row.first]->outputs[static_cast<std::size_t>(row.output)];
    const auto stage = static_cast<std::size_t>(row.stage);
    const Vector3 apart =
        outputValue(gains, plans[row.first].knots[stage]) - outputValue(gains, plans[row.second].knots[stage]);
    const double lacking = std::max(0.0, row.d - row.n.dot(apart));
    const QpModel& model = qp.uavs[row.first]->model;
    sum += model.slack_linear * lacking + 0.5 * model.slack_quadratic * lacking * lacking;
  }
  return sum;
}

}  // namespace swarm_planner
