// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Here a plan is made. If these fail, a UAV is given a plan worse than the one it had, or one through an obstacle.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "reference/interior_point.hpp"
#include "support/flight_problem.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"
#include "swarm_planner/problem/tracking_cost.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"

namespace swarm_planner {
namespace {

const std::vector<Vector3> kLine{Vector3(0, 0, 10), Vector3(100, 0, 10)};

double largestDistance(const Trajectory& a, const Trajectory& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k <= kHorizon; ++k) largest = std::max(largest, (a.knots[k].p - b.knots[k].p).norm());
  return largest;
}

/// Least distance of a plan from an obstacle's surface, sampled densely [m].
double leastDistance(const Trajectory& plan, const Superellipsoid& obstacle) {
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0.0; t <= plan.duration(); t += plan.dt / 20.0) {
    least = std::min(least, obstacle.movedBy(t).signedDistance(plan.after(t).p));
  }
  return least;
}

SqpResult solveCold(SqpSolver& solver, const UavProblem& problem, Trajectory& plan) {
  ActiveRows none;
  return solver.solve(problem, plan, none);
}

class SqpSolverTest : public ::testing::Test {
 protected:
  SqpSolver solver_{std::make_unique<InteriorPointSolver>()};
};

TEST_F(SqpSolverTest, StopsWhenTheQpForetoldTheGain) {
  // A straight path and no bodies: the QP is the problem itself.
  const FlightProblem flight(kLine, 3.0, {Vector3(0, 2, 11), Vector3(1, 0, 0), Vector3::Zero()});
  Trajectory plan = flight.coasting();
  const SqpResult result = solveCold(solver_, flight.problem, plan);
  EXPECT_EQ(result.iterations, 1);
  Trajectory again = plan;
  solveCold(solver_, flight.problem, again);
  EXPECT_LT(largestDistance(plan, again), 1e-4);
}

TEST(LeaningPlan, IsNotDoneWhenTheQpForetoldItsGain) {
  // From rest, the first QP has a plane right across the way, and foretells that the plan stops before it.
  FlightProblem flight(kLine, 3.0, {Vector3(0, 0, 10), Vector3::Zero(), Vector3::Zero()});
  const double dt = flight.problem.dt;
  flight.addUav(straightPlan(Vector3(6, 0.5, 10), Vector3::Zero(), 0.0, dt));
  const QpModels models = makeQpModels(flight.parameters);
  const auto tables = std::make_shared<GeneratedTables>(std::vector<QpModel>{models.straight, models.corner});
  SqpSolver solver(std::make_unique<GeneratedSolver>(tables));
  const auto end = [&](int iterations) {
    flight.parameters.sqp.max_iterations = iterations;
    Trajectory plan = flight.coasting();
    const SqpResult result = solveCold(solver, flight.problem, plan);
    EXPECT_LT(result.max_violation, 0.01);
    return plan.knots.back().p.x();
  };
  const double first = end(1);
  EXPECT_LT(first, 6.0) << "the first plan passes already: the test shows nothing";
  EXPECT_GT(end(5), first + 1.0);
}

TEST_F(SqpSolverTest, NeverMakesAPlanWorse) {
  Random random(1);
  int improved = 0;
  int violated = 0;
  int blocked = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    // Also beyond the speed limit, outside the workspace and inside of bodies.
    const KinematicState start{random.vector(-3.0, 3.0) + Vector3(0, 0, 10), random.vector(-4.0, 4.0),
                               random.vector(-3.0, 3.0)};
    FlightProblem flight(kLine, random.uniform(0.0, 6.0), start);
    flight.parameters.limits.max_acceleration = trial % 3 == 0 ? 5.0 : std::numeric_limits<double>::infinity();
    flight.parameters.limits.pair_distance_vertical = random.uniform(1.0, 3.0);
    flight.useParameters();
    const Workspace workspace{Vector3(-2, -2, 8), Vector3(20, 2, 12)};
    if (trial % 4 == 0) flight.setWorkspace(&workspace);
    crowd(random, flight);
    const Trajectory guess = wanderingPlan(random, start, random.uniform(0.0, 6.0), 0.0, flight.problem.dt);
    Trajectory plan = guess;
    const SqpResult result = solveCold(solver_, flight.problem, plan);
    ASSERT_TRUE(result.solved);
    EXPECT_GE(result.iterations, 1);
    EXPECT_LE(result.iterations, flight.parameters.sqp.max_iterations);
    const double before = merit(flight.problem, guess).value;
    ASSERT_TRUE(std::isfinite(result.merit));
    EXPECT_LE(result.merit, before) << "trial " << trial;
    // It knows planes that prove more than those that the plan alone suggests, but never more than is true.
    EXPECT_LE(result.max_violation, planViolation(flight.problem, plan).largest);
    for (const MovingBody& body : flight.problem.bodies) {
      if (body.isUav()) continue;
      const double kept = leastDistance(plan, *body.obstacle());
      // Inside of a body, depth depends on the way out; there the whole distance at least is lacking.
      EXPECT_GE(std::max(kept, 0.0), body.distance() - body.relief(0) - result.max_violation - 1e-9)
          << "trial " << trial;
      blocked += kept < body.distance() + 0.01 ? 1 : 0;
    }
    improved += result.merit < 0.9 * before ? 1 : 0;
    violated += planViolation(flight.problem, guess).largest > 0.1 ? 1 : 0;
    // What is flown is the roll-out of its jerks from where the UAV is.
    EXPECT_EQ(plan.knots.front().p, start.p);
    EXPECT_LT(largestDistance(plan, makePlan(start, plan.jerks, 0.0, plan.dt)), 1e-12);
  }
  EXPECT_GT(blocked, 20);
  EXPECT_GT(improved, kTrials / 2);
  EXPECT_GT(violated, kTrials / 4) << "the problems are too easy to mean anything";
}

// The stop behind a plan must fit into what the plan has kept clear; where the UAV flies next is to suffer little.
TEST_F(SqpSolverTest, BehindAMovingTargetCruisesAndEndsNearlyAtRest) {
  FlightProblem flight(kLine, 3.0, {Vector3(0, 0, 10), Vector3(3, 0, 0), Vector3::Zero()});
  // Table 3's: by rule the target draws three times as strongly, and plans end with a little more.
  flight.parameters.cost.eta = 0.1;
  flight.parameters.cost.zeta = 0.2;
  flight.parameters.cost.velocity_time = 1.0;
  Trajectory plan = flight.coasting();
  ASSERT_TRUE(solveCold(solver_, flight.problem, plan).solved);
  EXPECT_LT(plan.knots.back().v.norm(), 0.3);
  for (double t = 0.0; t <= 1.0; t += 0.1) EXPECT_NEAR(plan.after(t).v.x(), 3.0, 0.1) << t << " s";

  flight.parameters.cost.stop_weight = 0.0;
  plan = flight.coasting();
  ASSERT_TRUE(solveCold(solver_, flight.problem, plan).solved);
  EXPECT_NEAR(plan.knots.back().v.x(), 3.0, 0.1) << "it would not have gone on without: the test shows nothing";
}

TEST_F(SqpSolverTest, OneQpSolvesAnUnconstrainedProblem) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const KinematicState start{random.vector(-1.0, 1.0) + Vector3(3, 0, 10),
                               Vector3(3, 0, 0) + random.vector(-0.3, 0.3), Vector3::Zero()};
    FlightProblem flight(kLine, 3.0, start);
    Trajectory plan = flight.coasting();
    const SqpResult result = solveCold(solver_, flight.problem, plan);
    EXPECT_LE(result.iterations, 2) << "the second one finds nothing left to do";
    // At the minimum no direction leads downhill.
    const double least = planCost(flight.problem, plan);
    for (int i = 0; i < 20; ++i) {
      std::array<Vector3, kHorizon> jerks = plan.jerks;
      for (Vector3& jerk : jerks) jerk += random.vector(-0.1, 0.1);
      EXPECT_GT(planCost(flight.problem, makePlan(start, jerks, 0.0, plan.dt)), least - 1e-9);
    }
  }
}

// Speed, thrust and the line itself: five QPs must get to where many get.
TEST_F(SqpSolverTest, ConvergesWithinItsIterationsToTheMinimum) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const KinematicState start{random.vector(-3.0, 3.0) + Vector3(3, 0, 10), random.vector(-3.0, 3.0), Vector3::Zero()};
    FlightProblem flight(kLine, 6.0, start);
    flight.parameters.sqp.max_iterations = 50;
    flight.parameters.sqp.step_tolerance = 1e-9;
    Trajectory converged = flight.coasting();
    solveCold(solver_, flight.problem, converged);
    flight.parameters.sqp = SqpParameters();
    Trajectory plan = flight.coasting();
    solveCold(solver_, flight.problem, plan);
    const double least = merit(flight.problem, converged).value;
    EXPECT_LT(merit(flight.problem, plan).value, least + 0.01 * (1.0 + least)) << "trial " << trial;
  }
}

TEST_F(SqpSolverTest, AWarmStartAtTheAnswerStaysThere) {
  const KinematicState start{Vector3(0, 1, 10), Vector3(3, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 3.0, start);
  Trajectory plan = flight.coasting();
  solveCold(solver_, flight.problem, plan);
  const Trajectory answer = plan;
  const SqpResult again = solveCold(solver_, flight.problem, plan);
  EXPECT_EQ(again.iterations, 1);
  EXPECT_LT(largestDistance(plan, answer), 1e-6);
}

/// Flies along x at 3 m/s with `obstacle` ahead, a few replanned horizons to settle.
class ObstacleAhead : public SqpSolverTest, public ::testing::WithParamInterface<Vector3> {
 protected:
  Trajectory planWith(bool avoid, const Superellipsoid& obstacle) {
    const KinematicState start{Vector3(0, 0, 10), Vector3(3, 0, 0), Vector3::Zero()};
    FlightProblem flight(kLine, 3.0, start);
    if (avoid) flight.addObstacle(obstacle);
    Trajectory plan = flight.coasting();
    for (int i = 0; i < 3; ++i) result_ = solveCold(solver_, flight.problem, plan);
    return plan;
  }

  SqpResult result_;
};

TEST_P(ObstacleAhead, IsAvoidedAndOnlyBecauseItIsThere) {
  const Superellipsoid obstacle(1, Vector3(12, 0, 10), Vector3(1.5, 1.5, 1.5), GetParam(), 0.0, Vector3::Zero());
  const Trajectory avoiding = planWith(true, obstacle);
  const LimitParameters limits;
  EXPECT_LT(result_.max_violation, 0.01);
  EXPECT_GT(leastDistance(avoiding, obstacle), limits.uav_radius + limits.tracking_margin - 0.01);
  EXPECT_GT(avoiding.knots.back().p.x(), 14.0) << "it stopped before the obstacle instead of flying round it";

  const Trajectory ignoring = planWith(false, obstacle);
  EXPECT_LT(leastDistance(ignoring, obstacle), -1.0) << "it keeps clear without knowing: the test sees nothing";
}

INSTANTIATE_TEST_SUITE_P(Exponents, ObstacleAhead,
                         ::testing::Values(Vector3::Constant(2.0), Vector3(2.0, 3.5, 4.0), Vector3::Constant(10.0)));

TEST_F(SqpSolverTest, CrossesTheWayOfAnotherUav) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(3, 0, 0), Vector3::Zero()};
  const double dt = TimeParameters().sampling_time;
  const Trajectory other = straightPlan(Vector3(9, -9, 10), Vector3(0, 3, 0), 0.0, dt);
  const auto leastPair = [&](bool avoid) {
    FlightProblem flight(kLine, 3.0, start);
    if (avoid) flight.addUav(other);
    Trajectory plan = flight.coasting();
    for (int i = 0; i < 3; ++i) solveCold(solver_, flight.problem, plan);
    double least = std::numeric_limits<double>::infinity();
    for (double t = 0.0; t <= plan.duration(); t += dt / 20.0) {
      least = std::min(least, pairGauge(plan.after(t).p - other.after(t).p, flight.parameters.limits));
    }
    return least;
  };
  EXPECT_GT(leastPair(true), 1.0);
  EXPECT_LT(leastPair(false), 0.5);
}

TEST_F(SqpSolverTest, GoesBackIntoItsLimits) {
  // Faster than allowed and outside of the workspace, as a gust or a bad hand-over leaves it.
  const KinematicState start{Vector3(0, 3.0, 10), Vector3(6, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 3.0, start);
  const Workspace workspace{Vector3(-20, -2, 5), Vector3(100, 2, 15)};
  flight.setWorkspace(&workspace);
  Trajectory plan = flight.coasting();
  for (int i = 0; i < 3; ++i) solveCold(solver_, flight.problem, plan);
  EXPECT_LT(plan.knots.back().v.norm(), 5.0 + 1e-3);
  EXPECT_LT(plan.knots.back().p.y(), 1.8 + 1e-3);
}

TEST_F(SqpSolverTest, ReportsWhatItCannotKeep) {
  // Between two walls closer than the distances to keep.
  const KinematicState start{Vector3(0, 0, 10), Vector3::Zero(), Vector3::Zero()};
  FlightProblem flight(kLine, 0.0, start);
  for (const double y : {-1.2, 1.2}) {
    flight.addObstacle(
        Superellipsoid(1, Vector3(0, y, 10), Vector3(50, 1, 50), Vector3::Constant(10.0), 0.0, Vector3::Zero()));
  }
  Trajectory plan = flight.coasting();
  const SqpResult result = solveCold(solver_, flight.problem, plan);
  EXPECT_TRUE(result.solved);
  EXPECT_GT(result.max_violation, 0.2);
}

// One sensor's nonsense must neither throw nor become somebody's plan.
TEST_F(SqpSolverTest, LeavesThePlanAloneIfTheStartIsNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (int component = 0; component < 9; ++component) {
      const KinematicState start{Vector3(0, 0, 10), Vector3(3, 0, 0), Vector3::Zero()};
      FlightProblem flight(kLine, 3.0, start);
      const Trajectory guess = flight.coasting();
      Trajectory plan = guess;
      KinematicState& broken = flight.problem.start;
      (component < 3 ? broken.p : component < 6 ? broken.v : broken.a)[component % 3] = bad;
      SqpResult result;
      EXPECT_NO_THROW(result = solveCold(solver_, flight.problem, plan));
      EXPECT_FALSE(result.solved) << "component " << component << " " << bad;
      EXPECT_TRUE(identical(plan, guess));
    }
  }
  // And the next problem is solved as if nothing had been.
  FlightProblem flight(kLine, 3.0, {Vector3(0, 1, 10), Vector3(3, 0, 0), Vector3::Zero()});
  Trajectory plan = flight.coasting();
  EXPECT_TRUE(solveCold(solver_, flight.problem, plan).solved);
  SqpSolver fresh(std::make_unique<InteriorPointSolver>());
  Trajectory expected = flight.coasting();
  solveCold(fresh, flight.problem, expected);
  EXPECT_TRUE(identical(plan, expected));
}

TEST_F(SqpSolverTest, GivesTheSamePlanForTheSameProblem) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const KinematicState start{random.vector(-2.0, 2.0) + Vector3(0, 0, 10), random.vector(-3.0, 3.0), Vector3::Zero()};
    FlightProblem flight(kLine, 3.0, start);
    crowd(random, flight);
    Trajectory first = flight.coasting();
    Trajectory second = first;
    solveCold(solver_, flight.problem, first);
    SqpSolver other(std::make_unique<InteriorPointSolver>());
    solveCold(other, flight.problem, second);
    EXPECT_TRUE(identical(first, second)) << "trial " << trial;
  }
}

}  // namespace
}  // namespace swarm_planner
