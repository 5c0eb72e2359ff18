// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What is shown as the paper's method has to be that method.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/problem/moving_body.hpp"
#include "swarm_planner/problem/tracking_cost.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"

namespace swarm_planner {
namespace {

Mission paperMission(const Scenario& scenario) { return makeMission(scenario, {{"as_paper", true}}, scenario.name); }

/// Takes down how the plans of a flight are made.
class PlanWatch : public RunObserver {
 public:
  explicit PlanWatch(const IterativePlanner& planner) : planner_(planner) {}

  void onSample(double, const std::vector<QuadSimulator>&, const std::vector<Superellipsoid>&) override {}
  void onCycle(double epoch, const CycleReport&) override {
    const CommittedMotion& motion = planner_.committed(0);
    first_epoch = std::min(first_epoch, epoch);
    for (int k = 0; k < kHorizon; ++k) largest_jerk = std::max(largest_jerk, motion.jerk(k).norm());
    largest_change = std::max(largest_change, (motion.after(0.31).a - motion.after(0.29).a).norm());
  }

  double first_epoch = 1e9;
  double largest_jerk = 0.0;
  double largest_change = 0.0;

 private:
  const IterativePlanner& planner_;
};

TEST(AsPaper, PlansHoldTheAccelerationAndBeginAtOnce) {
  Scenario scenario = paperSix();
  scenario.end = {};
  scenario.end.duration = 15.0;
  const Mission mission = paperMission(scenario);
  IterativePlanner planner(mission);
  PlanWatch watch(planner);
  const RunResult result = ClosedLoopRun(mission, planner, 0).fly({&watch});
  EXPECT_LT(watch.largest_jerk, 1e-6);
  EXPECT_GT(watch.largest_change, 0.1);
  EXPECT_EQ(watch.first_epoch, 0.0);
  EXPECT_TRUE(result.as_paper);
  EXPECT_EQ(result.rejected_plans, 0u);
  EXPECT_LT(result.flown.tracking_error.max, mission.parameters.limits.uav_radius) << "vehicles cannot follow";
}

TEST(AsPaper, LeavesOutEveryProtectionButAvoidance) {
  const Parameters parameters = paperMission(paperSix()).parameters;
  const LimitParameters& limits = parameters.limits;
  EXPECT_FALSE(limits.plan_check || limits.segment_constraints || limits.guide || limits.right_of_way ||
               limits.latency_compensation);
  EXPECT_TRUE(limits.avoidance);
  EXPECT_EQ(velocityWeight(parameters, kHorizon), velocityWeight(parameters, 1));
  EXPECT_EQ(accelerationWeight(parameters, kHorizon), 0.0);
}

// The solver's tables are those of another model than ours: no plan near its answer may be better.
TEST(AsPaper, TheGeneratedSolverFindsTheOptimumOfThePapersModel) {
  const Mission mission = paperMission(paperSix());
  const QpModels models = makeQpModels(mission.parameters);
  ASSERT_TRUE(models.straight.holds_acceleration);
  GeneratedSolver solver(std::make_shared<GeneratedTables>(std::vector<QpModel>{models.straight}));
  Qp qp;
  qp.setModel(models.straight);
  qp.clear();
  qp.start = {Vector3(1.0, -2.0, 0.5), Vector3(0.3, 0.1, -0.2), Vector3(-0.4, 0.2, 0.1)};
  for (int k = 1; k <= kHorizon; ++k) {
    qp.stages[static_cast<std::size_t>(k)].position_gradient = Vector3(-0.4, 0.1 * k, 0.3);
    qp.stages[static_cast<std::size_t>(k)].velocity_gradient = Vector3(-0.1, 0.0, 0.05);
  }
  qp.addRow(8, Output::kPosition, Vector3(0.0, -1.0, 0.0), 1.0);
  QpSolution solution;
  ASSERT_EQ(solver.solve(qp, solution), QpStatus::kSolved);
  Trajectory plan;
  plan.dt = models.straight.dt;
  plan.holds_acceleration = true;
  plan.jerks = solution.jerks;
  rollOut(qp.start, plan);
  const double best = qp.objective(plan);
  constexpr double kStep = 1e-3;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-kStep, kStep}) {
        Trajectory other = plan;
        other.jerks[k][axis] += step;
        rollOut(qp.start, other);
        EXPECT_GT(qp.objective(other), best) << k << " " << axis;
      }
    }
  }
}

// (7) is linearised as it stands, and not its gauge, whose half-spaces never cut into the obstacle.
TEST(AsPaper, ObstaclesAreLinearisedAsLogarithms) {
  const Superellipsoid obstacle(1, Vector3::Zero(), Vector3(12.0, 14.0, 10.0), Vector3(2.0, 2.5, 4.0), 0.0,
                                Vector3::Zero());
  const double epsilon = 0.01;
  MovingBody body = MovingBody::fromObstacle(obstacle, 0.3, std::exp(epsilon), 0.0);
  EXPECT_TRUE(body.halfSpacesAreSafe());
  body.setLogarithmic();
  EXPECT_FALSE(body.halfSpacesAreSafe());
  const double scale = logarithmScale(obstacle);
  const Vector3 r(11.0, 9.0, -6.0);
  const HalfSpace plane = body.supportingHalfSpace(r);
  const auto value = [&](const Vector3& u) { return scale * (std::log(obstacle.sum(u)) - epsilon); };
  EXPECT_NEAR(plane.clearance(r), value(r), 1e-12);
  constexpr double kStep = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 step = kStep * Vector3::Unit(axis);
    EXPECT_NEAR(plane.n[axis], (value(r + step) - value(r - step)) / (2.0 * kStep), 1e-6);
  }
  const HalfSpace far = body.supportingHalfSpace(Vector3(40.0, 0.0, 0.0));
  EXPECT_GT(far.clearance(Vector3::Zero()), 0.0) << "the obstacle's centre lies in it";
}

}  // namespace
}  // namespace swarm_planner
