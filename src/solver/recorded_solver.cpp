// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/recorded_solver.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "recorded_qp.h"
#include "swarm_planner/solver/instruction_set.hpp"

namespace swarm_planner {
namespace {

constexpr int kHorizon = RECORDED_QP_HORIZON;

struct Functions {
  void (*default_parameters)(recorded_qp_parameters*);
  int (*setup)(recorded_qp_tables*, const recorded_qp_parameters*, uint64_t);
  void (*init)(recorded_qp_solver*, const recorded_qp_tables*);
  void (*set_rows)(recorded_qp_solver*, int, int, int, const float*, const float*);
  int (*solve)(const recorded_qp_tables*, recorded_qp_solver*);
};

Functions selectFunctions() {
#if defined(__x86_64__)
  switch (bestInstructionSet()) {
    case InstructionSet::kAvx512:
      return {recorded_qp_default_parameters_avx512, recorded_qp_setup_avx512, recorded_qp_init_avx512,
              recorded_qp_set_rows_avx512, recorded_qp_solve_avx512};
    case InstructionSet::kAvx2:
      return {recorded_qp_default_parameters_avx2, recorded_qp_setup_avx2, recorded_qp_init_avx2,
              recorded_qp_set_rows_avx2, recorded_qp_solve_avx2};
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return {recorded_qp_default_parameters_baseline, recorded_qp_setup_baseline, recorded_qp_init_baseline,
          recorded_qp_set_rows_baseline, recorded_qp_solve_baseline};
}

double stateWeight(int index, int state) {
  const bool last = index == kHorizon - 1;
  if (state < 3) return last ? recorded::kFinalPositionWeight : recorded::kPositionWeight;
  return last ? recorded::kFinalVelocityWeight : recorded::kVelocityWeight;
}

/// The recorded multipliers come from a method that leaves none at zero: what is smaller counts as zero.
constexpr float kLeastMultiplier = 1e-6f;

constexpr int kStride = 8;  ///< multipliers looked at together; most are zero

bool anyAbove(const float* multipliers, int count) {
  bool any = false;
  for (int i = 0; i < count; ++i) any |= multipliers[i] > kLeastMultiplier;
  return any;
}

void guess(recorded_qp_solver& s, int id, float multiplier) {
  if (!(multiplier > kLeastMultiplier) || s.warm_count == RECORDED_QP_MAX_ACTIVE) return;
  s.warm_id[s.warm_count] = id;
  s.warm_multiplier[s.warm_count++] = static_cast<double>(multiplier);
}

void loadThrust(recorded_qp_solver& s, const RecordedProblem& problem) {
  for (int k = 0; k < kHorizon; ++k) {
    const int slot = RECORDED_QP_SLOT_ACCELERATION(k, 0);
    for (int c = 0; c < 3; ++c) {
      s.row_normal[c][slot] = -static_cast<double>(problem.thrust_normal[static_cast<std::size_t>(3 * k + c)]);
    }
    s.row_offset[slot] = -static_cast<double>(problem.thrust_offset[static_cast<std::size_t>(k)]);
  }
}

void loadGuess(recorded_qp_solver& s, const RecordedProblem& problem, int rows) {
  const float* half_space = problem.warm_half_space.data();
  const float* velocity = problem.warm_velocity.data();
  const float* acceleration = problem.warm_acceleration.data();
  const float* thrust = problem.warm_thrust.data();
  for (int k = 0; k < kHorizon; ++k) {
    for (int i = 0; i < rows; i += kStride) {
      const int end = std::min(i + kStride, rows);
      if (!anyAbove(half_space + k * rows + i, end - i)) continue;
      for (int j = i; j < end; ++j) guess(s, RECORDED_QP_SLOT_POSITION(k, j), half_space[k * rows + j]);
    }
    guess(s, RECORDED_QP_SLOT_ACCELERATION(k, 0), thrust[k]);
    for (int i = 0; i < 6 && anyAbove(velocity + 6 * k, 6); ++i) {
      guess(s, recorded_qp_bound_id(RECORDED_QP_OUTPUT_VELOCITY, i % 3, k, i / 3), velocity[6 * k + i]);
    }
    for (int i = 0; i < 6 && anyAbove(acceleration + 6 * k, 6); ++i) {
      guess(s, recorded_qp_bound_id(RECORDED_QP_OUTPUT_ACCELERATION, i % 3, k, i / 3), acceleration[6 * k + i]);
    }
  }
}

}  // namespace

struct RecordedSolver::Memory {
  recorded_qp_tables tables;
  recorded_qp_solver solver;
  Functions functions;
};

RecordedSolver::RecordedSolver(const RecordedProblems& file, Method method, double tolerance)
    : memory_(new Memory), rows_(file.rows) {
  if (file.horizon != kHorizon) {
    throw std::invalid_argument("horizon " + std::to_string(file.horizon) + ": the solver is generated for " +
                                std::to_string(kHorizon));
  }
  if (file.rows > RECORDED_QP_MAX_ROWS_POSITION) {
    throw std::invalid_argument(std::to_string(file.rows) +
                                " half-spaces per stage: the generated solver has room for " +
                                std::to_string(RECORDED_QP_MAX_ROWS_POSITION));
  }
  memory_->functions = selectFunctions();
  recorded_qp_parameters parameters;
  memory_->functions.default_parameters(&parameters);
  if (memory_->functions.setup(&memory_->tables, &parameters, RECORDED_QP_HASH) != RECORDED_QP_SOLVED) {
    throw std::runtime_error("set-up of the generated solver failed");
  }
  memory_->functions.init(&memory_->solver, &memory_->tables);
  memory_->solver.wanted_method = method == Method::kActiveSet ? RECORDED_QP_ACTIVE_SET : RECORDED_QP_INTERIOR_POINT;
  memory_->solver.tolerance = tolerance;
  for (int k = 0; k < kHorizon; ++k) {
    memory_->solver.row_count[RECORDED_QP_OUTPUT_ACCELERATION][k] = 1;
  }
}

RecordedSolver::~RecordedSolver() = default;

void RecordedSolver::load(const RecordedProblem& problem, bool warm) {
  recorded_qp_solver& s = memory_->solver;
  for (std::size_t i = 0; i < 3; ++i) {
    s.x0[i] = static_cast<double>(problem.p0[i]);
    s.x0[3 + i] = static_cast<double>(problem.v0[i]);
    s.u_previous[i] = static_cast<double>(problem.a_previous[i]);
  }
  for (int k = 0; k < kHorizon; ++k) {
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(3 * k + i);
      s.state_linear[k][i] = -stateWeight(k, i) * static_cast<double>(problem.p_ref[at]);
      s.state_linear[k][3 + i] = -stateWeight(k, 3 + i) * static_cast<double>(problem.v_ref[at]);
    }
  }
  for (int k = 0; k < kHorizon; ++k) {
    memory_->functions.set_rows(&s, RECORDED_QP_OUTPUT_POSITION, k, rows_, problem.normal.data() + 3 * rows_ * k,
                                problem.offset.data() + rows_ * k);
  }
  loadThrust(s, problem);
  s.warm_count = 0;
  if (warm) loadGuess(s, problem, rows_);
}

void RecordedSolver::solve() { memory_->functions.solve(&memory_->tables, &memory_->solver); }

bool RecordedSolver::solved() const { return memory_->solver.status == RECORDED_QP_SOLVED; }

RecordedSolver::Method RecordedSolver::method() const {
  return memory_->solver.method == RECORDED_QP_ACTIVE_SET ? Method::kActiveSet : Method::kInteriorPoint;
}

int RecordedSolver::iterations() const { return memory_->solver.iterations; }

std::vector<double> RecordedSolver::input() const {
  const double* first = &memory_->solver.u[0][0];
  return std::vector<double>(first, first + 3 * kHorizon);
}

RecordedMultipliers RecordedSolver::multipliers() const {
  const recorded_qp_solver& s = memory_->solver;
  std::vector<double> by_id(RECORDED_QP_ROW_SLOTS + 2 * RECORDED_QP_BLOCKS * RECORDED_QP_POINTS_PADDED, 0.0);
  for (int i = 0; i < s.active_count; ++i) by_id[static_cast<std::size_t>(s.active_id[i])] = s.multiplier[i];
  const auto of = [&](int id) { return by_id[static_cast<std::size_t>(id)]; };
  RecordedMultipliers result;
  for (int k = 0; k < kHorizon; ++k) {
    for (int i = 0; i < rows_; ++i) result.half_space.push_back(of(RECORDED_QP_SLOT_POSITION(k, i)));
    result.thrust.push_back(of(RECORDED_QP_SLOT_ACCELERATION(k, 0)));
    for (int i = 0; i < 6; ++i) {
      result.velocity.push_back(of(recorded_qp_bound_id(RECORDED_QP_OUTPUT_VELOCITY, i % 3, k, i / 3)));
      result.acceleration.push_back(of(recorded_qp_bound_id(RECORDED_QP_OUTPUT_ACCELERATION, i % 3, k, i / 3)));
    }
  }
  return result;
}

}  // namespace swarm_planner
