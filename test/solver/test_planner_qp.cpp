// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// The linked solver that every plan comes from, on random problems of its structure: it has to answer each of them,
// whatever a scenario sets and however rows lie to each other. PLANNER_QP_PROBLEMS sets how many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "solver/planner_problem.hpp"
#include "swarm_planner/solver/instruction_set.hpp"

namespace swarm_planner {
namespace {

constexpr int kUsualProblems = 20000;
constexpr int kProblemsPerModel = 50;
constexpr double kRecursionRounding = 1e-9;

int problemCount() {
  const char* text = std::getenv("PLANNER_QP_PROBLEMS");
  return text == nullptr ? kUsualProblems : std::atoi(text);
}

struct Functions {
  const char* name;
  int (*setup)(planner_qp_tables*, const planner_qp_parameters*, uint64_t);
  void (*init)(planner_qp_solver*, const planner_qp_tables*);
  int (*solve)(const planner_qp_tables*, planner_qp_solver*);
};

/// Those that this machine runs, the widest one last.
std::vector<Functions> functions() {
  std::vector<Functions> sets{
      {"baseline", planner_qp_setup_baseline, planner_qp_init_baseline, planner_qp_solve_baseline}};
#if defined(__x86_64__)
  const InstructionSet best = bestInstructionSet();
  if (best != InstructionSet::kBaseline) {
    sets.push_back({"avx2", planner_qp_setup_avx2, planner_qp_init_avx2, planner_qp_solve_avx2});
  }
  if (best == InstructionSet::kAvx512) {
    sets.push_back({"avx512", planner_qp_setup_avx512, planner_qp_init_avx512, planner_qp_solve_avx512});
  }
#endif
  return sets;
}

/// Largest difference of the inputs, relative to the largest input.
double difference(const planner_qp_solver& a, const planner_qp_solver& b) {
  double largest = 0.0, size = 1.0;
  for (int k = 0; k < PLANNER_QP_HORIZON; ++k) {
    for (int i = 0; i < PLANNER_QP_INPUTS; ++i) {
      largest = std::max(largest, std::abs(a.u[k][i] - b.u[k][i]));
      size = std::max(size, std::abs(a.u[k][i]));
    }
  }
  return largest / size;
}

class PlannerQp : public ::testing::Test {
 protected:
  PlannerQp() : tables_(new planner_qp_tables), solver_(new planner_qp_solver), cold_(new planner_qp_solver) {}

  void setUp(const Functions& set, const planner_qp_parameters& model) {
    set_ = set;
    ASSERT_EQ(set.setup(tables_.get(), &model, PLANNER_QP_HASH), PLANNER_QP_SOLVED);
    set.init(solver_.get(), tables_.get());
  }

  void solve() { set_.solve(tables_.get(), solver_.get()); }

  /// Cold: optimal by conditions that are checked independently.
  void checkCold(PlannerProblem& problem) {
    load(problem, *solver_);
    solver_->warm_count = 0;
    solver_->wanted_method = PLANNER_QP_ACTIVE_SET;
    solver_->tolerance = 1e-8;
    solve();
    *cold_ = *solver_;
    ASSERT_EQ(cold_->status, PLANNER_QP_SOLVED);
    kkt_ = kktOf(problem, *cold_);
    fell_back_ = cold_->method != PLANNER_QP_ACTIVE_SET;
    if (fell_back_) return;
    EXPECT_LE(kkt_.stationarity, 1e-9);
    EXPECT_LE(kkt_.rows, 1e-8);
    EXPECT_LE(kkt_.multipliers, 1e-12);
  }

  /// From its own result, and from a guess that has nothing to do with the problem.
  void checkWarm(const PlannerProblem& problem, Random& random) {
    if (fell_back_) return;
    solver_->warm_count = cold_->active_count;
    std::copy(cold_->active_id, cold_->active_id + cold_->active_count, solver_->warm_id);
    std::copy(cold_->multiplier, cold_->multiplier + cold_->active_count, solver_->warm_multiplier);
    expectSame(problem);
    solver_->warm_count = problem.rows.empty() ? 0 : 40;
    for (int i = 0; i < solver_->warm_count; ++i) {
      const int row = random.integer(0, static_cast<int>(problem.rows.size()) - 1);
      solver_->warm_id[i] = problem.rows[static_cast<std::size_t>(row)].id;
      solver_->warm_multiplier[i] = problem.model.slack_linear * random.logUniform(1e-6, 10.0);
    }
    expectSame(problem);
  }

  /// The inputs of the cold solve; their cost, where the guess led to the cap and so to the second method.
  void expectSame(const PlannerProblem& problem) {
    solve();
    EXPECT_EQ(solver_->status, PLANNER_QP_SOLVED);
    if (solver_->method == PLANNER_QP_ACTIVE_SET) {
      EXPECT_LE(difference(*solver_, *cold_), 1e-6);
      return;
    }
    const PlannerCost cost = costOf(problem, *cold_);
    const double rounding = 1e-11 * cost.size + 2.0 * kkt_.price;
    EXPECT_NEAR(costOf(problem, *solver_).value, cost.value, solver_->gap + rounding);
  }

  /// The interior-point method's cost is within its tolerance of the active set's, which in turn can only be better by
  /// what the errors of its rows cost.
  void checkInteriorPoint(const PlannerProblem& problem) {
    const PlannerCost cost = costOf(problem, *cold_);
    const double rounding = 1e-11 * cost.size + 2.0 * kkt_.price;
    solver_->warm_count = 0;
    solver_->wanted_method = PLANNER_QP_INTERIOR_POINT;
    solver_->tolerance = 1e-8 + 1e-10 * cost.size;
    solve();
    ASSERT_EQ(solver_->status, PLANNER_QP_SOLVED);
    const double gap = costOf(problem, *solver_).value - cost.value;
    // Its gap is that of its own variables. What rounding adds in the recursion, whose terms are those of the cost, and
    // in the roll-out of its inputs comes on top, and is known to an order of magnitude.
    EXPECT_LE(gap, 10.0 * (solver_->gap + kktOf(problem, *solver_).price + rounding) + kRecursionRounding * cost.size);
    EXPECT_LE(gap, 1e-6 * (1.0 + cost.size));
    EXPECT_GE(gap, -cold_->gap - rounding);
    for (const planner_qp_solver* answer : {solver_.get(), cold_.get()}) {
      least_digits_ = std::max(least_digits_, answer->gap / (1.0 + cost.size));
    }
    interior_points_ += solver_->method == PLANNER_QP_INTERIOR_POINT ? 1 : 0;
  }

  Functions set_{};
  std::unique_ptr<planner_qp_tables> tables_;
  std::unique_ptr<planner_qp_solver> solver_, cold_;
  PlannerKkt kkt_;
  bool fell_back_ = false;
  double least_digits_ = 0.0;  ///< largest gap over the sizes of the cost's terms
  int interior_points_ = 0;    ///< problems that this method answered itself
};

TEST_F(PlannerQp, EveryRandomProblemIsSolvedToTheOptimum) {
  const int count = problemCount();
  int fallbacks = 0;
  for (int batch = 0; batch * kProblemsPerModel < count; ++batch) {
    Random random(static_cast<std::uint64_t>(batch)), guesses(static_cast<std::uint64_t>(batch + 1));
    const planner_qp_parameters model = randomPlannerModel(random);
    ASSERT_NO_FATAL_FAILURE(setUp(functions().back(), model));
    for (int i = 0; i < kProblemsPerModel; ++i) {
      SCOPED_TRACE("batch " + std::to_string(batch) + ", problem " + std::to_string(i));
      PlannerProblem problem = randomPlannerProblem(model, random);
      ASSERT_NO_FATAL_FAILURE(checkCold(problem));
      checkWarm(problem, guesses);
      ASSERT_NO_FATAL_FAILURE(checkInteriorPoint(problem));
      fallbacks += fell_back_ ? 1 : 0;
    }
  }
  std::cout << count << " problems, " << fallbacks << " answered by the second method, "
            << "gaps up to " << least_digits_ << ", " << interior_points_
            << " by the interior point where that was asked for\n";
  EXPECT_LT(fallbacks, count / 10);
  EXPECT_LE(least_digits_, 1e-5);
  EXPECT_GT(interior_points_, count - count / 1000);
}

// A vehicle's computer may have any of the instruction sets: none may fly another plan.
TEST_F(PlannerQp, EveryInstructionSetGivesTheSameAnswer) {
  for (int batch = 0; batch < 10; ++batch) {
    Random random(static_cast<std::uint64_t>(1000 + batch));
    const planner_qp_parameters model = randomPlannerModel(random);
    for (int i = 0; i < 10; ++i) {
      PlannerProblem problem = randomPlannerProblem(model, random);
      std::unique_ptr<planner_qp_solver> first;
      for (const Functions& set : functions()) {
        SCOPED_TRACE(set.name);
        ASSERT_NO_FATAL_FAILURE(setUp(set, model));
        ASSERT_NO_FATAL_FAILURE(checkCold(problem));
        if (first == nullptr) first = std::make_unique<planner_qp_solver>(*cold_);
        // Rounding, which differs from set to set, decides where the active set gives up.
        const bool exact = !fell_back_ && first->method == PLANNER_QP_ACTIVE_SET;
        EXPECT_LE(difference(*cold_, *first), exact ? 1e-6 : 1e-3) << "problem " << i;
      }
    }
  }
}

// Calling code that was compiled for another description would fill the wrong fields.
TEST_F(PlannerQp, AnotherDescriptionsHashIsRefused) {
  Random random(1);
  const planner_qp_parameters model = randomPlannerModel(random);
  for (const Functions& set : functions()) {
    EXPECT_EQ(set.setup(tables_.get(), &model, PLANNER_QP_HASH ^ 1u), PLANNER_QP_WRONG_VERSION) << set.name;
    EXPECT_EQ(set.setup(tables_.get(), &model, PLANNER_QP_HASH), PLANNER_QP_SOLVED) << set.name;
  }
}

}  // namespace
}  // namespace swarm_planner
