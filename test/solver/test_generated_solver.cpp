// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The solver that flies: wrong answers here are wrong plans.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "known_optimum.hpp"
#include "reference/interior_point.hpp"
#include "swarm_planner/solver/generated_solver.hpp"

namespace swarm_planner {
namespace {

/// Solves with tables made for the QP's own model.
QpStatus solveGenerated(const Qp& qp, QpSolution& solution) {
  GeneratedSolver solver(std::make_shared<GeneratedTables>(std::vector<QpModel>{qp.model}));
  return solver.solve(qp, solution);
}

Vector3 randomVector(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  return {number(random), number(random), number(random)};
}

class GeneratedSolverTest : public ::testing::TestWithParam<RowMix> {};

TEST_P(GeneratedSolverTest, FindsTheKnownOptimum) {
  std::mt19937_64 random(11);
  auto solution = std::make_unique<QpSolution>();
  for (int trial = 0; trial < 100; ++trial) {
    const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum(GetParam(), random));
    ASSERT_EQ(solveGenerated(known->qp, *solution), QpStatus::kSolved) << "trial " << trial;
    const double expected = objective(known->qp, known->solution.jerks);
    EXPECT_NEAR(objective(known->qp, solution->jerks), expected, 1e-8 * (1.0 + std::abs(expected)))
        << "trial " << trial;
  }
}

TEST_P(GeneratedSolverTest, TheObjectiveIsThatOfTheDefinition) {
  std::mt19937_64 random(16);
  for (int trial = 0; trial < 20; ++trial) {
    const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum(GetParam(), random));
    Trajectory plan;
    plan.dt = known->qp.model.dt;
    for (Vector3& jerk : plan.jerks) jerk = 3.0 * randomVector(random);
    rollOut(known->qp.start, plan);
    const double expected = objective(known->qp, plan.jerks);
    EXPECT_NEAR(known->qp.objective(plan), expected, 1e-12 * (1.0 + std::abs(expected)));
  }
}

TEST_P(GeneratedSolverTest, AgreesWithTheReference) {
  std::mt19937_64 random(12);
  InteriorPointSolver reference;
  auto expected = std::make_unique<QpSolution>();
  auto solution = std::make_unique<QpSolution>();
  for (int trial = 0; trial < 30; ++trial) {
    const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum(GetParam(), random));
    // Somewhere else than at the optimum that was constructed.
    known->qp.stages[7].position_gradient += Vector3(3.0, -2.0, 1.0);
    ASSERT_EQ(reference.solve(known->qp, *expected), QpStatus::kSolved);
    ASSERT_EQ(solveGenerated(known->qp, *solution), QpStatus::kSolved);
    const double least = objective(known->qp, expected->jerks);
    EXPECT_NEAR(objective(known->qp, solution->jerks), least, 1e-7 * (1.0 + std::abs(least))) << "trial " << trial;
    EXPECT_NEAR(solution->max_slack, std::max(0.0, expected->max_slack), 1e-4) << "trial " << trial;
  }
}

/// The known problem with rows that can be recognised: numbered within each stage and output.
void numberRows(Qp& qp) {
  for (QpStage& stage : qp.stages) {
    for (int i = 0; i < stage.row_count; ++i)
      stage.rows[static_cast<std::size_t>(i)].source = 10 + static_cast<RowSource>(i);
  }
}

TEST_P(GeneratedSolverTest, AGuessSavesTimeAndChangesNothing) {
  std::mt19937_64 random(14);
  auto cold = std::make_unique<QpSolution>();
  auto warm = std::make_unique<QpSolution>();
  int cold_changes = 0;
  int warm_changes = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum(GetParam(), random));
    numberRows(known->qp);
    ASSERT_EQ(solveGenerated(known->qp, *warm), QpStatus::kSolved);
    known->qp.stages[7].position_gradient += randomVector(random);
    cold->active.count = 0;
    ASSERT_EQ(solveGenerated(known->qp, *cold), QpStatus::kSolved);
    ASSERT_EQ(solveGenerated(known->qp, *warm), QpStatus::kSolved);
    for (std::size_t k = 0; k < kHorizon; ++k) {
      EXPECT_LE((warm->jerks[k] - cold->jerks[k]).norm(), 1e-8) << "trial " << trial << ", stage " << k;
    }
    EXPECT_EQ(warm->active.count, cold->active.count);
    cold_changes += cold->iterations;
    warm_changes += warm->iterations;
  }
  EXPECT_LE(warm_changes, cold_changes);
  if (cold_changes > 500) {
    EXPECT_LT(warm_changes, cold_changes / 2);
  }
}

// A guess comes from another time and, through a fault, from another UAV.
TEST_P(GeneratedSolverTest, AWrongGuessChangesNothing) {
  std::mt19937_64 random(15);
  auto cold = std::make_unique<QpSolution>();
  auto warm = std::make_unique<QpSolution>();
  for (int trial = 0; trial < 50; ++trial) {
    const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum(GetParam(), random));
    numberRows(known->qp);
    cold->active.count = warm->active.count = 0;
    ASSERT_EQ(solveGenerated(known->qp, *cold), QpStatus::kSolved);
    for (std::int8_t stage = 1; stage <= kHorizon; ++stage) {
      for (RowSource source = 10; source < 13; ++source) {
        warm->active.rows[static_cast<std::size_t>(warm->active.count++)] = {
            stage, Output::kPosition, source,
            std::pow(10.0, std::uniform_real_distribution<double>(-6.0, 6.0)(random))};
      }
    }
    ASSERT_EQ(solveGenerated(known->qp, *warm), QpStatus::kSolved);
    for (std::size_t k = 0; k < kHorizon; ++k) {
      EXPECT_LE((warm->jerks[k] - cold->jerks[k]).norm(), 1e-8) << "trial " << trial << ", stage " << k;
    }
  }
}

// A crowd's QP must not take the time of all others'. What was found so far is worth something: the next solve goes on
// from its active rows.
TEST_P(GeneratedSolverTest, StopsAfterTheChangesAllowedAndGoesOnFromThere) {
  constexpr int kMostChanges = 5;
  std::mt19937_64 random(17);
  auto solution = std::make_unique<QpSolution>();
  int unfinished = 0;
  int needed = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum(GetParam(), random));
    numberRows(known->qp);
    solution->active.count = 0;
    ASSERT_EQ(solveGenerated(known->qp, *solution), QpStatus::kSolved);
    needed = std::max(needed, solution->iterations);
    const double least = objective(known->qp, solution->jerks);
    GeneratedSolver limited(std::make_shared<GeneratedTables>(std::vector<QpModel>{known->qp.model}), kMostChanges);
    solution->active.count = 0;
    QpStatus status = limited.solve(known->qp, *solution);
    for (int solve = 0; status == QpStatus::kIterationLimit && solve < 60; ++solve) {
      ++unfinished;
      ASSERT_FALSE(solution->fell_back);
      ASSERT_GT(solution->active.count, 0);
      for (const Vector3& jerk : solution->jerks) ASSERT_TRUE(jerk.allFinite());
      EXPECT_GE(objective(known->qp, solution->jerks), least - 1e-8 * (1.0 + std::abs(least)));
      status = limited.solve(known->qp, *solution);
    }
    ASSERT_EQ(status, QpStatus::kSolved) << "trial " << trial;
    EXPECT_NEAR(objective(known->qp, solution->jerks), least, 1e-8 * (1.0 + std::abs(least))) << "trial " << trial;
  }
  EXPECT_EQ(unfinished > 0, needed > kMostChanges);
}

INSTANTIATE_TEST_SUITE_P(RowMixes, GeneratedSolverTest,
                         ::testing::Values(RowMix{0, 0, 0}, RowMix{0, 0, 5}, RowMix{1, 0, 5}, RowMix{0, 1, 5},
                                           RowMix{2, 1, 10}, RowMix{1, 1, 25}));

// What one solve leaves behind must not colour the next.
TEST(GeneratedSolver, SolvesOneAfterTheOtherAsIfEachWereTheFirst) {
  std::mt19937_64 random(13);
  const auto first = std::make_unique<KnownOptimum>(makeKnownOptimum({2, 1, 10}, random));
  const auto second = std::make_unique<KnownOptimum>(makeKnownOptimum({1, 0, 3}, random));
  GeneratedSolver solver(std::make_shared<GeneratedTables>(std::vector<QpModel>{first->qp.model, second->qp.model}));
  auto fresh = std::make_unique<QpSolution>();
  auto used = std::make_unique<QpSolution>();
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (const Qp* qp : {&first->qp, &second->qp}) {
      solver.solve(*qp, *used);
      solveGenerated(*qp, *fresh);
      EXPECT_EQ(used->jerks, fresh->jerks);
      EXPECT_EQ(used->iterations, fresh->iterations);
    }
  }
}

TEST(GeneratedSolver, ReportsDataThatAreNotFinite) {
  std::mt19937_64 random(14);
  const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum({1, 1, 3}, random));
  auto solution = std::make_unique<QpSolution>();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto qp = std::make_unique<Qp>(known->qp);
    qp->stages[4].rows[2].n.x() = bad;
    EXPECT_EQ(solveGenerated(*qp, *solution), QpStatus::kNoAnswer);
    *qp = known->qp;
    qp->start.v.y() = bad;
    EXPECT_EQ(solveGenerated(*qp, *solution), QpStatus::kNoAnswer);
    *qp = known->qp;
    qp->stages[20].position_gradient.z() = bad;
    EXPECT_EQ(solveGenerated(*qp, *solution), QpStatus::kNoAnswer);
    for (const Vector3& jerk : solution->jerks) EXPECT_TRUE(jerk.allFinite());
  }
}

TEST(GeneratedSolver, RefusesAModelThatItHasNoTablesOf) {
  std::mt19937_64 random(15);
  const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum({0, 0, 0}, random));
  GeneratedSolver solver(std::make_shared<GeneratedTables>(std::vector<QpModel>{known->qp.model}));
  known->qp.model.dt *= 2.0;
  auto solution = std::make_unique<QpSolution>();
  EXPECT_NE(solver.solve(known->qp, *solution), QpStatus::kSolved);
}

TEST(GeneratedTables, RefuseWeightsWithoutALeastCost) {
  QpModel model;
  model.dt = 0.3;
  model.jerk_weight = -1.0;
  model.slack_linear = model.slack_quadratic = 1.0;
  EXPECT_THROW(GeneratedTables({model}), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
