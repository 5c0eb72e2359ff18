// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/generated_solver.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "generated_qp.hpp"
#include "planner_qp.h"
#include "swarm_planner/solver/instruction_set.hpp"

namespace swarm_planner {
namespace {

static_assert(PLANNER_QP_HORIZON == kHorizon, "the generated solver has another horizon");
static_assert(PLANNER_QP_OUTPUTS == kOutputCount, "the generated solver has other outputs");
static_assert(PLANNER_QP_OUTPUT_THRUST_ACCELERATION == static_cast<int>(Output::kThrustAcceleration) &&
                  PLANNER_QP_OUTPUT_CONTROL_POINT_2 == static_cast<int>(Output::kControlPoint2) &&
                  PLANNER_QP_OUTPUT_VELOCITY_CONTROL_POINT == static_cast<int>(Output::kVelocityControlPoint),
              "the outputs are in another order");
static_assert(PLANNER_QP_MAX_ROWS_POSITION == kMaxBodyRows && PLANNER_QP_MAX_ROWS_VELOCITY == kMaxLimitRows &&
                  PLANNER_QP_MAX_QUADRATIC == kMaxCurvatures && PLANNER_QP_FIRST_STAGE_POSITION == 1,
              "the generated solver has other capacities");

struct Functions {
  int (*setup)(planner_qp_tables*, const planner_qp_parameters*, uint64_t);
  void (*init)(planner_qp_solver*, const planner_qp_tables*);
  int (*solve)(const planner_qp_tables*, planner_qp_solver*);
};

const Functions& functions() {
  static const Functions kFunctions = [] {
#if defined(__x86_64__)
    switch (bestInstructionSet()) {
      case InstructionSet::kAvx512:
        return Functions{planner_qp_setup_avx512, planner_qp_init_avx512, planner_qp_solve_avx512};
      case InstructionSet::kAvx2:
        return Functions{planner_qp_setup_avx2, planner_qp_init_avx2, planner_qp_solve_avx2};
      case InstructionSet::kBaseline:
        break;
    }
#endif
    return Functions{planner_qp_setup_baseline, planner_qp_init_baseline, planner_qp_solve_baseline};
  }();
  return kFunctions;
}

}  // namespace

struct GeneratedTables::Entry {
  QpModel model;
  planner_qp_tables tables;
};

GeneratedTables::GeneratedTables(const std::vector<QpModel>& models) {
  for (const QpModel& model : models) {
    const auto parameters = generatedParameters<planner_qp_parameters>(model);
    auto entry = std::make_unique<Entry>();
    entry->model = model;
    if (functions().setup(&entry->tables, &parameters, PLANNER_QP_HASH) != PLANNER_QP_SOLVED) {
      throw std::invalid_argument("the weights do not make a strictly convex problem");
    }
    entries_.push_back(std::move(entry));
  }
}

GeneratedTables::~GeneratedTables() = default;

const GeneratedTables::Entry* GeneratedTables::find(const QpModel& model) const {
  for (const std::unique_ptr<Entry>& entry : entries_) {
    if (entry->model == model) return entry.get();
  }
  return nullptr;
}

struct GeneratedSolver::Memory {
  planner_qp_solver solver;
  std::vector<ActiveRow> row_of_slot =
      std::vector<ActiveRow>(PLANNER_QP_ROW_SLOTS);  ///< what each of the solver's rows is, without multiplier
  const GeneratedTables::Entry* initialised_for = nullptr;
};

GeneratedSolver::GeneratedSolver(std::shared_ptr<const GeneratedTables> tables, int most_changes)
    : tables_(std::move(tables)), most_changes_(most_changes), memory_(new Memory) {}

GeneratedSolver::~GeneratedSolver() = default;

QpStatus GeneratedSolver::solve(const Qp& qp, QpSolution& solution) {
  const GeneratedTables::Entry* entry = tables_->find(qp.model);
  planner_qp_solver& s = memory_->solver;
  solution.status = QpStatus::kNoAnswer;
  solution.iterations = 0;
  solution.max_slack = 0.0;
  if (entry == nullptr) return solution.status;
  if (memory_->initialised_for != entry) functions().init(&s, &entry->tables);
  memory_->initialised_for = entry;
  load(qp, solution.active);
  s.most_changes = most_changes_;
  const int status = functions().solve(&entry->tables, &s);
  solution.iterations = s.iterations;
  solution.fell_back = s.method != PLANNER_QP_ACTIVE_SET;
  if (status == PLANNER_QP_SOLVED) solution.status = QpStatus::kSolved;
  if (status == PLANNER_QP_UNFINISHED) solution.status = QpStatus::kIterationLimit;
  for (std::size_t k = 0; k < kHorizon; ++k) solution.jerks[k] = qp.axes * Eigen::Map<const Vector3>(s.u[k]);
  for (int i = 0; i < s.active_count; ++i) solution.max_slack = std::max(solution.max_slack, s.slack[i]);
  storeActiveRows(solution.active);
  return solution.status;
}

void GeneratedSolver::storeActiveRows(ActiveRows& active) const {
  const planner_qp_solver& s = memory_->solver;
  active.count = 0;
  for (int i = 0; i < s.active_count; ++i) {
    const int id = s.active_id[i];
    if (id >= PLANNER_QP_ROW_SLOTS || !(s.multiplier[i] > 0.0)) continue;  // a curvature term
    ActiveRow row = memory_->row_of_slot[static_cast<std::size_t>(id)];
    row.multiplier = s.multiplier[i];
    active.insert(row);
  }
}

void GeneratedSolver::load(const Qp& qp, const ActiveRows& guess) {
  planner_qp_solver& s = memory_->solver;
  planner_qp_clear_rows(&s);
  s.warm_count = 0;
  loadQp(
      qp, guess, s, memory_->row_of_slot,
      [&s](int output, int stage, const double* normal, double d) {
        return planner_qp_add_row(&s, output, stage, normal, d, PLANNER_QP_PENALTY_SLACK);
      },
      [&s](int slot, double multiplier) {
        if (s.warm_count == PLANNER_QP_MAX_ACTIVE) return;
        s.warm_id[s.warm_count] = slot;
        s.warm_multiplier[s.warm_count++] = multiplier;
      });
}

}  // namespace swarm_planner
