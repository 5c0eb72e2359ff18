// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If the solver gets worse, plans cost more than they need to, and no other test sees it. Ipopt solves the same
// nonlinear programs, written down a second time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimality/ipopt_solver.hpp"
#include "optimality/optimality_study.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/problem/tracking_cost.hpp"

namespace swarm_planner {
namespace {

constexpr int kStride = 16;
constexpr int kPrograms = 36;

Mission missionOf(bool as_paper) {
  Scenario scenario = paperSix();
  scenario.end = {};
  scenario.end.duration = 36.0;
  return makeMission(scenario, as_paper ? ParameterMap{{"as_paper", true}} : ParameterMap{{"guide", false}}, "paper");
}

ComparedPrograms compared(bool as_paper) {
  ComparedPrograms result;
  compareWithIpopt(missionOf(as_paper), kStride, kPrograms, result);
  return result;
}

void expectNearOptimal(const ComparedPrograms& result) {
  ASSERT_GE(result.programs.size(), 30u);
  EXPECT_LE(result.failed, 1);
  std::vector<double> gaps;
  int constrained = 0;
  for (const ComparedProgram& program : result.programs) {
    gaps.push_back(program.gap());
    constrained += program.is_constrained ? 1 : 0;
    EXPECT_LE(program.cost, program.start_cost + 1e-9) << program.uav << " at " << program.epoch;
  }
  EXPECT_GE(constrained, 5) << "nothing was in anybody's way";
  std::sort(gaps.begin(), gaps.end());
  EXPECT_LT(gaps[gaps.size() / 2], 0.001);
  const auto within = std::count_if(gaps.begin(), gaps.end(), [](double gap) { return gap <= 0.01; });
  EXPECT_GE(static_cast<double>(within), 0.9 * static_cast<double>(gaps.size()));
}

TEST(SolverCost, IsNearIpoptsInFlight) { expectNearOptimal(compared(false)); }

TEST(SolverCost, OfThePapersMethodIsNearIpoptsInFlight) { expectNearOptimal(compared(true)); }

// The comparison means nothing unless both sides have the same program in hand.
TEST(SolverCost, TheReferenceHasTheSameCostAndTrueDerivatives) {
  for (const bool as_paper : {true, false}) {
    int visited = 0;
    visitPrograms(missionOf(as_paper), 40, [&](const MetProgram& met) {
      if (++visited > 6) return;
      const ReferenceProgram program(met.problem, [](std::size_t, int k) { return k % 5 == 2; });
      const Eigen::VectorXd z = program.startAt(met.guess);
      Eigen::VectorXd without_slack = z;
      without_slack.segment(ReferenceProgram::kInputs, program.slackCount()).setZero();
      const double cost = planCost(met.problem, met.guess);
      EXPECT_NEAR(program.objective(without_slack), cost, 1e-9 * std::max(1.0, cost));
      EXPECT_LT((program.planOf(z).knots.back().p - met.guess.knots.back().p).norm(), 1e-9);
      constexpr double kStep = 1e-5;
      const Eigen::VectorXd gradient = program.gradient(z);
      for (Eigen::Index i = 0; i < ReferenceProgram::kInputs; i += 7) {
        const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(z.size(), i);
        const double slope = (program.objective(z + step) - program.objective(z - step)) / (2.0 * kStep);
        EXPECT_NEAR(gradient[i], slope, 1e-4 * std::max(1.0, std::abs(slope)));
      }
    });
    EXPECT_GT(visited, 3);
  }
}

}  // namespace
}  // namespace swarm_planner
