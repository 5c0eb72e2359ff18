// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "known_optimum.hpp"
#include "reference/interior_point.hpp"

namespace swarm_planner {
namespace {

double largestJerkError(const QpSolution& a, const QpSolution& b) {
  double error = 0.0;
  for (std::size_t k = 0; k < kHorizon; ++k) error = std::max(error, (a.jerks[k] - b.jerks[k]).norm());
  return error;
}

class KnownOptimumTest : public ::testing::TestWithParam<RowMix> {};

// A wrong answer here is a wrong plan: the optimum is known in closed form.
TEST_P(KnownOptimumTest, IsFound) {
  std::mt19937_64 random(7);
  InteriorPointSolver solver;
  auto solution = std::make_unique<QpSolution>();
  for (int trial = 0; trial < 300; ++trial) {
    const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum(GetParam(), random));
    ASSERT_EQ(solver.solve(known->qp, *solution), QpStatus::kSolved) << "trial " << trial;
    const double expected = objective(known->qp, known->solution.jerks);
    EXPECT_NEAR(objective(known->qp, solution->jerks), expected, 1e-7 * (1.0 + std::abs(expected)));
    EXPECT_LT(largestJerkError(*solution, known->solution), 1e-3) << "trial " << trial;
    EXPECT_LE(solution->iterations, 40);
  }
}

INSTANTIATE_TEST_SUITE_P(RowMixes, KnownOptimumTest,
                         ::testing::Values(RowMix{0, 0, 0}, RowMix{0, 0, 5}, RowMix{1, 0, 5}, RowMix{0, 1, 5},
                                           RowMix{2, 1, 10}, RowMix{1, 1, 60}));

// Without rows the Riccati recursion alone must give the least squares answer in one pass.
TEST(InteriorPoint, NeedsOneRecursionWithoutViolatedRows) {
  std::mt19937_64 random(3);
  const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum({0, 0, 5}, random));
  InteriorPointSolver solver;
  auto solution = std::make_unique<QpSolution>();
  solver.solve(known->qp, *solution);
  EXPECT_EQ(solution->iterations, 1);
  EXPECT_LT(largestJerkError(*solution, known->solution), 1e-9);
}

// Opposing rows that no point satisfies must share the violation instead of ending the flight.
TEST(InteriorPoint, SharesTheViolationOfOpposingRows) {
  std::mt19937_64 random(5);
  const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum({0, 0, 0}, random));
  known->qp.model.slack_linear = known->qp.model.slack_quadratic = 1e5;  // far above what the costs pull with
  known->qp.start.v = known->qp.start.a = Vector3::Zero();
  for (int k = 1; k <= kHorizon; ++k) {
    known->qp.addRow(k, Output::kPosition, Vector3::UnitX(), known->qp.start.p.x() + 1.0);
    known->qp.addRow(k, Output::kPosition, -Vector3::UnitX(), -known->qp.start.p.x() + 1.0);
  }
  InteriorPointSolver solver;
  auto solution = std::make_unique<QpSolution>();
  ASSERT_EQ(solver.solve(known->qp, *solution), QpStatus::kSolved);
  EXPECT_NEAR(solution->max_slack, 1.0, 0.01);
}

TEST(InteriorPoint, ReportsDataThatAreNotFinite) {
  std::mt19937_64 random(9);
  const auto known = std::make_unique<KnownOptimum>(makeKnownOptimum({1, 1, 3}, random));
  InteriorPointSolver solver;
  auto solution = std::make_unique<QpSolution>();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto qp = std::make_unique<Qp>(known->qp);
    qp->stages[4].rows[2].d = bad;
    EXPECT_EQ(solver.solve(*qp, *solution), QpStatus::kNoAnswer);
    *qp = known->qp;
    qp->start.v.y() = bad;
    EXPECT_EQ(solver.solve(*qp, *solution), QpStatus::kNoAnswer);
    *qp = known->qp;
    qp->stages[20].position_gradient.z() = bad;
    EXPECT_EQ(solver.solve(*qp, *solution), QpStatus::kNoAnswer);
  }
}

}  // namespace
}  // namespace swarm_planner
