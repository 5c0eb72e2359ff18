// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <vector>

#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

// What the solvers generated from planner_qp.yaml and joint_qp.yaml have in common: the model of one UAV, under names
// of their own.

/// The model's numbers as the parameters of a generated solver.
template <class GeneratedParameters>
GeneratedParameters generatedParameters(const QpModel& model) {
  GeneratedParameters parameters{};
  parameters.dt = model.dt;
  parameters.along = model.along_weight;
  parameters.across = model.across_weight;
  parameters.velocity = model.velocity_weight;
  parameters.final_velocity = model.final_velocity_weight;
  parameters.final_acceleration = model.final_acceleration_weight;
  parameters.jerk = model.jerk_weight;
  parameters.drag = model.drag_over_mass;
  parameters.slack_linear = model.slack_linear;
  parameters.slack_quadratic = model.slack_quadratic;
  parameters.held = model.holds_acceleration ? 1.0 : 0.0;
  return parameters;
}

/// Fills a generated solver's data of one UAV, in the QP's axes. add_row(output, stage, normal, d) appends a row and
/// returns its slot; `row_of_slot` learns what it is; guessed(slot, multiplier) is told of those that the guess knows.
template <class Data, class AddRow, class Guessed>
void loadQp(const Qp& qp, const ActiveRows& guess, Data& data, std::vector<ActiveRow>& row_of_slot, AddRow add_row,
            Guessed guessed) {
  constexpr int kFirstPositionStage = 1;
  const Matrix3 to_axes = qp.axes.transpose();
  const auto put = [&to_axes](const Vector3& from, double* to) { Eigen::Map<Vector3>(to, 3) = to_axes * from; };
  put(qp.start.p, data.x0);
  put(qp.start.v, data.x0 + 3);
  put(qp.start.a, data.x0 + 6);
  int guess_begin = 0;
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const QpStage& stage = qp.stages[k];
    put(stage.position_gradient, data.state_linear[k - 1]);
    put(stage.velocity_gradient, data.state_linear[k - 1] + 3);
    while (guess_begin < guess.count && guess.rows[static_cast<std::size_t>(guess_begin)].stage < static_cast<int>(k)) {
      ++guess_begin;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) {
      const QpRow& row = stage.rows[i];
      const Vector3 normal = to_axes * row.n;
      const int slot = add_row(static_cast<int>(row.output), static_cast<int>(k), normal.data(), row.d);
      row_of_slot[static_cast<std::size_t>(slot)] = {static_cast<std::int8_t>(k), row.output, row.source, 0.0};
      for (int g = guess_begin; g < guess.count && guess.rows[static_cast<std::size_t>(g)].stage == static_cast<int>(k);
           ++g) {
        const ActiveRow& guess_row = guess.rows[static_cast<std::size_t>(g)];
        if (guess_row.source != row.source || guess_row.output != row.output) continue;
        guessed(slot, guess_row.multiplier);
        break;
      }
    }
  }
  data.quadratic_count = qp.curvature_count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(qp.curvature_count); ++i) {
    const QpCurvature& term = qp.curvatures[i];
    data.quadratic_output[i] = static_cast<int>(Output::kPosition);
    data.quadratic_index[i] = term.stage - kFirstPositionStage;
    put(term.n, data.quadratic_normal[i]);
    data.quadratic_offset[i] = 0.0;
    data.quadratic_weight[i] = term.weight;
  }
}

}  // namespace swarm_planner
