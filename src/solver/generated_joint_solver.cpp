// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/generated_joint_solver.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "generated_qp.hpp"
#include "joint_qp.h"
#include "swarm_planner/solver/instruction_set.hpp"

namespace swarm_planner {
namespace {

static_assert(JOINT_QP_HORIZON == kHorizon && JOINT_QP_OUTPUTS == kOutputCount, "generated for another model");
static_assert(JOINT_QP_OUTPUT_THRUST_ACCELERATION == static_cast<int>(Output::kThrustAcceleration) &&
                  JOINT_QP_OUTPUT_CONTROL_POINT_2 == static_cast<int>(Output::kControlPoint2),
              "the outputs are in another order");
static_assert(JOINT_QP_COPIES == kMostJointUavs && JOINT_QP_MAX_COUPLINGS == kMostPairRows &&
                  JOINT_QP_MAX_ROWS_POSITION == kMaxBodyRows && JOINT_QP_MAX_ROWS_VELOCITY == kMaxLimitRows &&
                  JOINT_QP_MAX_QUADRATIC == kMaxCurvatures && JOINT_QP_FIRST_STAGE_POSITION == 1,
              "the generated solver has other capacities");

struct Functions {
  int (*setup)(joint_qp_tables*, const joint_qp_parameters*, uint64_t);
  void (*init)(joint_qp_solver*, int);
  void (*init_copy)(joint_qp_copy*, const joint_qp_tables*);
  int (*solve)(const joint_qp_tables* const*, joint_qp_solver*);
};

const Functions& functions() {
  static const Functions kFunctions = [] {
#if defined(__x86_64__)
    switch (bestInstructionSet()) {
      case InstructionSet::kAvx512:
        return Functions{joint_qp_setup_avx512, joint_qp_init_avx512, joint_qp_init_copy_avx512, joint_qp_solve_avx512};
      case InstructionSet::kAvx2:
        return Functions{joint_qp_setup_avx2, joint_qp_init_avx2, joint_qp_init_copy_avx2, joint_qp_solve_avx2};
      case InstructionSet::kBaseline:
        break;
    }
#endif
    return Functions{joint_qp_setup_baseline, joint_qp_init_baseline, joint_qp_init_copy_baseline,
                     joint_qp_solve_baseline};
  }();
  return kFunctions;
}

/// Of the answers to two parts of a problem.
QpStatus worse(QpStatus a, QpStatus b) {
  for (const QpStatus status : {QpStatus::kNoAnswer, QpStatus::kIterationLimit}) {
    if (a == status || b == status) return status;
  }
  return QpStatus::kSolved;
}

bool meansTheSame(const ActiveRow& guess, const PairRow& row) {
  return guess.stage == row.stage && guess.output == row.output && guess.source == row.source;
}

}  // namespace

struct GeneratedJointSolver::Memory {
  Memory(std::unique_ptr<QpSolver> of_one, int changes) : most_changes(changes), single(std::move(of_one)) {}

  int most_changes;  ///< per UAV

  std::vector<QpModel> models;
  std::vector<std::unique_ptr<joint_qp_tables>> tables_of_model;
  std::vector<std::size_t> members;           ///< UAVs of the component at hand, in the order of the copies
  std::array<int, kMostJointUavs> copy_of{};  ///< of each UAV of it
  std::vector<std::size_t> pair_row_of;       ///< of each coupling
  std::vector<ActiveRow> guessed_pairs;
  std::array<const joint_qp_tables*, kMostJointUavs> tables{};  ///< of each copy
  joint_qp_solver solver;
  std::unique_ptr<QpSolver> single;  ///< of UAVs that no row couples
  QpSolution alone;
  std::array<std::vector<ActiveRow>, kMostJointUavs> row_of_slot;  ///< what each row is, without multiplier
};

GeneratedJointSolver::GeneratedJointSolver(const std::vector<QpModel>& models, std::unique_ptr<QpSolver> single,
                                           int most_changes)
    : memory_(new Memory(std::move(single), most_changes)) {
  memory_->models = models;
  for (const QpModel& model : models) {
    const auto parameters = generatedParameters<joint_qp_parameters>(model);
    auto tables = std::make_unique<joint_qp_tables>();
    if (functions().setup(tables.get(), &parameters, JOINT_QP_HASH) != JOINT_QP_SOLVED) {
      throw std::invalid_argument("the weights do not make a strictly convex problem");
    }
    memory_->tables_of_model.push_back(std::move(tables));
  }
  memory_->members.reserve(kMostJointUavs);
  memory_->pair_row_of.reserve(kMostPairRows);
  memory_->guessed_pairs.reserve(kMostPairRows);
  functions().init(&memory_->solver, 1);
  for (std::vector<ActiveRow>& rows : memory_->row_of_slot) rows.resize(JOINT_QP_ROW_SLOTS);
}

GeneratedJointSolver::~GeneratedJointSolver() = default;

QpStatus GeneratedJointSolver::solve(const JointQp& qp, JointQpSolution& solution) {
  Memory& m = *memory_;
  solution.status = QpStatus::kSolved;
  solution.iterations = 0;
  solution.max_slack = 0.0;
  if (qp.count > kMostJointUavs) return solution.status = QpStatus::kNoAnswer;
  m.guessed_pairs.assign(solution.active_pairs.rows.begin(), solution.active_pairs.rows.end());
  solution.active_pairs.rows.clear();
  const JointComponents components = findComponents(qp);
  for (std::size_t component = 0; component < qp.count; ++component) {
    m.members.clear();
    for (std::size_t i = 0; i < qp.count; ++i) {
      if (components[i] != component || qp.is_left[i]) continue;
      m.copy_of[i] = static_cast<int>(m.members.size());
      m.members.push_back(i);
    }
    if (m.members.empty()) continue;
    solution.status =
        worse(solution.status, m.members.size() == 1 ? solveAlone(qp, solution) : solveTogether(qp, solution));
  }
  return solution.status;
}

QpStatus GeneratedJointSolver::solveAlone(const JointQp& qp, JointQpSolution& solution) {
  const std::size_t i = memory_->members.front();
  QpSolution& alone = memory_->alone;
  alone.active = solution.active[i];
  const QpStatus status = memory_->single->solve(*qp.uavs[i], alone);
  solution.iterations += alone.iterations;
  solution.max_slack = std::max(solution.max_slack, alone.max_slack);
  solution.jerks[i] = alone.jerks;
  solution.active[i] = alone.active;
  return status;
}

QpStatus GeneratedJointSolver::solveTogether(const JointQp& qp, JointQpSolution& solution) {
  if (!load(qp, solution)) return QpStatus::kNoAnswer;
  memory_->solver.most_changes = memory_->most_changes * static_cast<int>(memory_->members.size());
  const int status = functions().solve(memory_->tables.data(), &memory_->solver);
  store(qp, solution);
  if (status == JOINT_QP_UNFINISHED) return QpStatus::kIterationLimit;
  return status == JOINT_QP_SOLVED ? QpStatus::kSolved : QpStatus::kNoAnswer;
}

void GeneratedJointSolver::store(const JointQp& qp, JointQpSolution& solution) const {
  const joint_qp_solver& s = memory_->solver;
  solution.iterations += s.iterations;
  for (std::size_t c = 0; c < memory_->members.size(); ++c) {
    const std::size_t i = memory_->members[c];
    for (std::size_t k = 0; k < kHorizon; ++k) {
      solution.jerks[i][k] = qp.uavs[i]->axes * Eigen::Map<const Vector3>(s.copy[c].u[k]);
    }
  }
  for (int i = 0; i < s.active_count; ++i) solution.max_slack = std::max(solution.max_slack, s.slack[i]);
  storeActiveRows(qp, solution);
}

bool GeneratedJointSolver::load(const JointQp& qp, const JointQpSolution& guess) {
  joint_qp_solver& s = memory_->solver;
  s.copy_count = static_cast<int>(memory_->members.size());
  s.warm_count = 0;
  for (std::size_t c = 0; c < memory_->members.size(); ++c) {
    const std::size_t i = memory_->members[c];
    const auto model = std::find(memory_->models.begin(), memory_->models.end(), qp.uavs[i]->model);
    if (model == memory_->models.end()) return false;
    const auto index = static_cast<std::size_t>(model - memory_->models.begin());
    const joint_qp_tables* tables = memory_->tables_of_model[index].get();
    joint_qp_copy& copy = s.copy[c];
    if (memory_->tables[c] != tables) functions().init_copy(&copy, tables);
    memory_->tables[c] = tables;
    joint_qp_clear_rows(&copy);
    loadQp(
        *qp.uavs[i], guess.active[i], copy, memory_->row_of_slot[c],
        [&copy](int output, int stage, const double* normal, double d) {
          return joint_qp_add_row(&copy, output, stage, normal, d, JOINT_QP_PENALTY_SLACK);
        },
        [&s, c](int slot, double multiplier) {
          if (s.warm_count == JOINT_QP_MAX_ACTIVE) return;
          s.warm_id[s.warm_count] = JOINT_QP_ID(static_cast<int>(c), slot);
          s.warm_multiplier[s.warm_count++] = multiplier;
        });
  }
  loadPairRows(qp);
  return true;
}

void GeneratedJointSolver::loadPairRows(const JointQp& qp) {
  joint_qp_solver& s = memory_->solver;
  s.coupling_count = 0;
  memory_->pair_row_of.clear();
  for (std::size_t number = 0; number < qp.pair_rows.size(); ++number) {
    const PairRow& row = qp.pair_rows[number];
    if (std::find(memory_->members.begin(), memory_->members.end(), row.first) == memory_->members.end()) continue;
    const int copies[] = {memory_->copy_of[row.first], memory_->copy_of[row.second]};
    const Vector3 first = qp.uavs[row.first]->axes.transpose() * row.n;
    const Vector3 second = -(qp.uavs[row.second]->axes.transpose() * row.n);
    const double* normals[] = {first.data(), second.data()};
    const int coupling = joint_qp_add_coupling(&s, static_cast<int>(row.output), row.stage, copies, normals, row.d,
                                               JOINT_QP_PENALTY_SLACK);
    memory_->pair_row_of.push_back(number);
    const std::vector<ActiveRow>& guess = memory_->guessed_pairs;
    const auto known = std::find_if(guess.begin(), guess.end(),
                                    [&row](const ActiveRow& guessed) { return meansTheSame(guessed, row); });
    if (known == guess.end() || s.warm_count == JOINT_QP_MAX_ACTIVE) continue;
    s.warm_id[s.warm_count] = JOINT_QP_COUPLING_ID(coupling);
    s.warm_multiplier[s.warm_count++] = known->multiplier;
  }
}

void GeneratedJointSolver::storeActiveRows(const JointQp& qp, JointQpSolution& solution) const {
  const joint_qp_solver& s = memory_->solver;
  for (const std::size_t i : memory_->members) solution.active[i].count = 0;
  for (int i = 0; i < s.active_count; ++i) {
    const int id = s.active_id[i];
    if (!(s.multiplier[i] > 0.0)) continue;
    if (id >= JOINT_QP_COUPLING_ID(0)) {
      const PairRow& row = qp.pair_rows[memory_->pair_row_of[static_cast<std::size_t>(id - JOINT_QP_COUPLING_ID(0))]];
      solution.active_pairs.rows.push_back(
          {static_cast<std::int8_t>(row.stage), row.output, row.source, s.multiplier[i]});
    } else if (id % JOINT_QP_COPY_IDS < JOINT_QP_ROW_SLOTS) {  // otherwise a curvature term
      const auto copy = static_cast<std::size_t>(id / JOINT_QP_COPY_IDS);
      ActiveRow row = memory_->row_of_slot[copy][static_cast<std::size_t>(id % JOINT_QP_COPY_IDS)];
      row.multiplier = s.multiplier[i];
      solution.active[memory_->members[copy]].insert(row);
    }
  }
}

}  // namespace swarm_planner
