// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// The linked solver for several UAVs at once, on random problems of its structure. Where every other UAV flies its part
// of the optimum, each one's part is the optimum of a problem of its own, in which the couplings are rows with the same
// multipliers: that is checked by the conditions of a single UAV's problem.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "joint_qp.h"
#include "solver/planner_problem.hpp"
#include "swarm_planner/solver/instruction_set.hpp"

namespace swarm_planner {
namespace {

constexpr int kHorizon = JOINT_QP_HORIZON;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Functions {
  const char* name;
  int (*setup)(joint_qp_tables*, const joint_qp_parameters*, uint64_t);
  void (*init)(joint_qp_solver*, int);
  void (*init_copy)(joint_qp_copy*, const joint_qp_tables*);
  int (*solve)(const joint_qp_tables* const*, joint_qp_solver*);
};

/// Those that this machine runs, the widest one last.
std::vector<Functions> functions() {
  std::vector<Functions> sets{{"baseline", joint_qp_setup_baseline, joint_qp_init_baseline, joint_qp_init_copy_baseline,
                               joint_qp_solve_baseline}};
#if defined(__x86_64__)
  const InstructionSet best = bestInstructionSet();
  if (best != InstructionSet::kBaseline) {
    sets.push_back({"avx2", joint_qp_setup_avx2, joint_qp_init_avx2, joint_qp_init_copy_avx2, joint_qp_solve_avx2});
  }
  if (best == InstructionSet::kAvx512) {
    sets.push_back(
        {"avx512", joint_qp_setup_avx512, joint_qp_init_avx512, joint_qp_init_copy_avx512, joint_qp_solve_avx512});
  }
#endif
  return sets;
}

joint_qp_parameters sameParameters(const planner_qp_parameters& p) {
  return {p.dt,   p.along,        p.across,          p.velocity, p.final_velocity, p.final_acceleration, p.jerk,
          p.drag, p.slack_linear, p.slack_quadratic, p.held};
}

struct Coupling {
  int output = 0, stage = 1, copy[2] = {0, 1};
  Vector3 normal[2];
  double offset = 0.0;
};

struct JointProblem {
  std::vector<PlannerProblem> uavs;
  std::vector<Coupling> couplings;
};

/// UAVs that were made apart; pairs of them are to keep apart along random directions, some of which they violate.
JointProblem randomJointProblem(const std::vector<planner_qp_parameters>& models, int couplings, Random& random) {
  JointProblem problem;
  for (const planner_qp_parameters& model : models) problem.uavs.push_back(randomPlannerProblem(model, random));
  const int count = static_cast<int>(models.size());
  for (int i = 0; i < couplings; ++i) {
    Coupling coupling;
    coupling.output = random.integer(0, 2);
    coupling.stage = random.integer(1, kHorizon);
    coupling.copy[0] = random.integer(0, count - 1);
    coupling.copy[1] = (coupling.copy[0] + random.integer(1, count - 1)) % count;
    coupling.normal[0] = random.direction();
    coupling.normal[1] = random.integer(0, 3) == 0 ? random.direction() : Vector3(-coupling.normal[0]);
    coupling.offset = random.uniform(-3.0, 1.0);
    problem.couplings.push_back(coupling);
  }
  return problem;
}

class JointQp : public ::testing::Test {
 protected:
  JointQp() : solver_(new joint_qp_solver) {}

  void setUp(const Functions& set, const std::vector<planner_qp_parameters>& models) {
    set_ = set;
    tables_.clear();
    pointers_.clear();
    set_.init(solver_.get(), static_cast<int>(models.size()));
    for (std::size_t k = 0; k < models.size(); ++k) {
      tables_.push_back(std::make_unique<joint_qp_tables>());
      const joint_qp_parameters parameters = sameParameters(models[k]);
      ASSERT_EQ(set_.setup(tables_.back().get(), &parameters, JOINT_QP_HASH), JOINT_QP_SOLVED);
      pointers_.push_back(tables_.back().get());
      set_.init_copy(&solver_->copy[k], pointers_.back());
    }
  }

  void load(JointProblem& problem) {
    for (std::size_t k = 0; k < problem.uavs.size(); ++k) {
      PlannerProblem& uav = problem.uavs[k];
      joint_qp_copy& copy = solver_->copy[k];
      joint_qp_clear_rows(&copy);
      std::copy(uav.x0.begin(), uav.x0.end(), copy.x0);
      for (int i = 0; i < kHorizon; ++i) {
        std::copy(uav.state_linear[at(i)].begin(), uav.state_linear[at(i)].end(), copy.state_linear[i]);
      }
      for (PlannerProblem::Row& row : uav.rows) {
        row.id = joint_qp_add_row(&copy, row.output, row.stage, row.n.data(), row.d, row.penalty);
        ASSERT_GE(row.id, 0);
      }
      copy.quadratic_count = 0;
      for (const PlannerProblem::Quadratic& term : uav.quadratics) {
        const int i = copy.quadratic_count++;
        copy.quadratic_output[i] = JOINT_QP_OUTPUT_POSITION;
        copy.quadratic_index[i] = term.stage - JOINT_QP_FIRST_STAGE_POSITION;
        std::copy(term.n.data(), term.n.data() + 3, copy.quadratic_normal[i]);
        copy.quadratic_offset[i] = term.c;
        copy.quadratic_weight[i] = term.weight;
      }
    }
    solver_->coupling_count = 0;
    for (const Coupling& c : problem.couplings) {
      const double* normals[] = {c.normal[0].data(), c.normal[1].data()};
      ASSERT_GE(
          joint_qp_add_coupling(solver_.get(), c.output, c.stage, c.copy, normals, c.offset, JOINT_QP_PENALTY_SLACK),
          0);
    }
  }

  int solve() { return set_.solve(pointers_.data(), solver_.get()); }

  /// The part of one UAV as the answer of a problem of its own, which gets the couplings as rows.
  PlannerAnswer partOf(int uav, PlannerProblem& problem, const JointProblem& joint) const {
    PlannerAnswer answer;
    const joint_qp_copy& copy = solver_->copy[uav];
    for (int k = 0; k < kHorizon; ++k) std::copy(copy.u[k], copy.u[k] + JOINT_QP_INPUTS, answer.u[at(k)].begin());
    const auto put = [&](int id, int i) {
      answer.active_id.push_back(id);
      answer.multiplier.push_back(solver_->multiplier[i]);
      answer.slack.push_back(solver_->slack[i]);
    };
    int next = PLANNER_QP_ENTRIES + PLANNER_QP_MAX_QUADRATIC;  // identities that no row of a single problem has
    std::vector<int> id_of(joint.couplings.size(), -1);
    for (std::size_t i = 0; i < joint.couplings.size(); ++i) {
      const Coupling& c = joint.couplings[i];
      if (c.copy[0] != uav && c.copy[1] != uav) continue;
      const int own = c.copy[0] == uav ? 0 : 1;
      const double others = c.normal[1 - own].dot(
          valueOf(joint.uavs[at(c.copy[1 - own])].model, c.output, solver_->copy[c.copy[1 - own]].x[c.stage]));
      id_of[i] = next++;
      problem.rows.push_back({c.output, c.stage, PLANNER_QP_PENALTY_SLACK, c.normal[own], c.offset - others, id_of[i]});
    }
    for (int i = 0; i < solver_->active_count; ++i) {
      const int id = solver_->active_id[i];
      if (id >= JOINT_QP_COUPLING_ID(0)) {
        const int of_uav = id_of[at(id - JOINT_QP_COUPLING_ID(0))];
        if (of_uav >= 0) put(of_uav, i);
      } else if (id / JOINT_QP_COPY_IDS == uav) {
        put(id % JOINT_QP_COPY_IDS, i);
      }
    }
    return answer;
  }

  void expectOptimal(const JointProblem& joint) {
    for (int uav = 0; uav < static_cast<int>(joint.uavs.size()); ++uav) {
      PlannerProblem problem = joint.uavs[at(uav)];
      const PlannerAnswer answer = partOf(uav, problem, joint);
      const PlannerKkt kkt = kktOf(problem, answer);
      EXPECT_LE(kkt.stationarity, 1e-9) << "UAV " << uav;
      EXPECT_LE(kkt.rows, 1e-8) << "UAV " << uav;
      EXPECT_LE(kkt.multipliers, 1e-12) << "UAV " << uav;
    }
  }

  std::vector<double> inputs() const {
    std::vector<double> all;
    for (int k = 0; k < solver_->copy_count; ++k) {
      const double* first = &solver_->copy[k].u[0][0];
      all.insert(all.end(), first, first + kHorizon * JOINT_QP_INPUTS);
    }
    return all;
  }

  Functions set_{};
  std::unique_ptr<joint_qp_solver> solver_;
  std::vector<std::unique_ptr<joint_qp_tables>> tables_;
  std::vector<const joint_qp_tables*> pointers_;
};

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0, size = 1.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(a[i]));
  }
  return largest / size;
}

TEST_F(JointQp, RandomProblemsAreSolvedToTheOptimumOrRefused) {
  int refused = 0, coupled = 0, active = 0;
  constexpr int kProblems = 40;
  for (int number = 0; number < kProblems; ++number) {
    SCOPED_TRACE("problem " + std::to_string(number));
    Random random(static_cast<std::uint64_t>(number));
    const int count = random.integer(2, JOINT_QP_COPIES);
    std::vector<planner_qp_parameters> models(at(count), randomPlannerModel(random));
    for (planner_qp_parameters& model : models) {
      if (random.integer(0, 1) == 1) model.along = model.across;  // a corner ahead
    }
    ASSERT_NO_FATAL_FAILURE(setUp(functions().back(), models));
    JointProblem problem = randomJointProblem(models, random.integer(1, 300), random);
    ASSERT_NO_FATAL_FAILURE(load(problem));
    solver_->warm_count = 0;
    if (solve() != JOINT_QP_SOLVED) {
      EXPECT_EQ(solver_->status, JOINT_QP_CAP);
      EXPECT_EQ(solver_->copy[0].u[0][0], 0.0);
      ++refused;
      continue;
    }
    expectOptimal(problem);
    active += solver_->active_count;
    for (int i = 0; i < solver_->active_count; ++i) coupled += solver_->active_id[i] >= JOINT_QP_COUPLING_ID(0);

    const std::vector<double> cold = inputs();
    solver_->warm_count = solver_->active_count;
    std::copy(solver_->active_id, solver_->active_id + solver_->active_count, solver_->warm_id);
    std::copy(solver_->multiplier, solver_->multiplier + solver_->active_count, solver_->warm_multiplier);
    if (solve() == JOINT_QP_SOLVED) {
      EXPECT_LE(difference(inputs(), cold), 1e-6);
    }
  }
  std::cout << refused << " of " << kProblems << " refused, " << active / kProblems << " rows active in the mean, "
            << coupled / kProblems << " of them couplings\n";
  EXPECT_LE(refused, kProblems / 5);
  EXPECT_GT(coupled, 5 * kProblems);
}

// A vehicle's computer may have any of the instruction sets: none may fly other plans.
TEST_F(JointQp, EveryInstructionSetGivesTheSameAnswer) {
  for (int number = 0; number < 5; ++number) {
    Random random(static_cast<std::uint64_t>(2000 + number));
    const std::vector<planner_qp_parameters> models(3, randomPlannerModel(random));
    JointProblem problem = randomJointProblem(models, 60, random);
    std::vector<double> first;
    for (const Functions& set : functions()) {
      ASSERT_NO_FATAL_FAILURE(setUp(set, models));
      ASSERT_NO_FATAL_FAILURE(load(problem));
      ASSERT_EQ(solve(), JOINT_QP_SOLVED) << set.name;
      if (first.empty()) first = inputs();
      EXPECT_LE(difference(inputs(), first), 1e-6) << set.name;
    }
  }
}

// Without couplings nobody's plan depends on another's: each is what the solver of one UAV answers.
TEST_F(JointQp, UncoupledUavsGetWhatEachGetsAlone) {
  const auto tables = std::make_unique<planner_qp_tables>();
  const auto alone = std::make_unique<planner_qp_solver>();
  for (int number = 0; number < 10; ++number) {
    Random random(static_cast<std::uint64_t>(3000 + number));
    const std::vector<planner_qp_parameters> models(4, randomPlannerModel(random));
    JointProblem problem = randomJointProblem(models, 0, random);
    ASSERT_NO_FATAL_FAILURE(setUp(functions().front(), models));
    ASSERT_NO_FATAL_FAILURE(load(problem));
    ASSERT_EQ(solve(), JOINT_QP_SOLVED);
    ASSERT_EQ(planner_qp_setup_baseline(tables.get(), &models[0], PLANNER_QP_HASH), PLANNER_QP_SOLVED);
    for (int uav = 0; uav < 4; ++uav) {
      planner_qp_init_baseline(alone.get(), tables.get());
      ::swarm_planner::load(problem.uavs[at(uav)], *alone);
      ASSERT_EQ(planner_qp_solve_baseline(tables.get(), alone.get()), PLANNER_QP_SOLVED);
      if (alone->method != PLANNER_QP_ACTIVE_SET) continue;
      for (int k = 0; k < kHorizon; ++k) {
        for (int i = 0; i < JOINT_QP_INPUTS; ++i) {
          EXPECT_NEAR(solver_->copy[uav].u[k][i], alone->u[k][i], 1e-6 * (1.0 + std::abs(alone->u[k][i])));
        }
      }
    }
  }
}

TEST_F(JointQp, BadDataGetAStatusAndNoNumbers) {
  Random random(1);
  const std::vector<planner_qp_parameters> models(2, randomPlannerModel(random));
  JointProblem problem = randomJointProblem(models, 4, random);
  const auto expectRefused = [&](const std::function<void(joint_qp_solver&)>& spoil, const char* what) {
    setUp(functions().back(), models);
    load(problem);
    spoil(*solver_);
    EXPECT_EQ(solve(), JOINT_QP_BAD_DATA) << what;
    for (const double u : inputs()) EXPECT_EQ(u, 0.0) << what;
  };
  expectRefused([](joint_qp_solver& s) { s.coupling_offset[1] = std::nan(""); }, "offset");
  expectRefused([](joint_qp_solver& s) { s.coupling_normal[1][2][3] = HUGE_VAL; }, "normal");
  expectRefused([](joint_qp_solver& s) { s.coupling_copy[1][0] = 2; }, "a copy that is not in use");
  expectRefused([](joint_qp_solver& s) { s.coupling_copy[1][0] = s.coupling_copy[0][0]; }, "one copy twice");
  expectRefused([](joint_qp_solver& s) { s.coupling_index[0] = kHorizon; }, "stage");
  expectRefused([](joint_qp_solver& s) { s.copy[1].x0[4] = std::nan(""); }, "start");
  expectRefused([](joint_qp_solver& s) { s.coupling_penalty[0] = 7; }, "penalty");
  const int copies[] = {0, 1};
  const double n[] = {1.0, 0.0, 0.0};
  const double* normals[] = {n, n};
  EXPECT_EQ(joint_qp_add_coupling(solver_.get(), JOINT_QP_OUTPUT_POSITION, 0, copies, normals, 0.0, 1), -1);
  EXPECT_EQ(joint_qp_add_coupling(solver_.get(), JOINT_QP_OUTPUT_POSITION, kHorizon + 1, copies, normals, 0.0, 1), -1);
}

}  // namespace
}  // namespace swarm_planner
