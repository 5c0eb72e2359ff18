// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Here the plans of a whole swarm are made at once. If these fail, two UAVs are given plans that collide, or plans
// worse than those that each would have found alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <vector>

#include "support/flight_problem.hpp"
#include "swarm_planner/solver/generated_joint_solver.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/joint_sqp_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"

namespace swarm_planner {
namespace {

constexpr double kPairDistance = 2.0;  // [m]

std::vector<QpModel> models() {
  const QpModels both = makeQpModels(Parameters());
  return {both.straight, both.corner};
}

/// UAVs that fly along lines, with the problem of all of them.
class Flight {
 public:
  void add(const Vector3& from, const Vector3& to, double speed) {
    const Vector3 direction = (to - from).normalized();
    flights_.emplace_back(std::vector<Vector3>{from, to}, speed,
                          KinematicState{from, speed * direction, Vector3::Zero()});
    problem.uavs.push_back(&flights_.back().problem);
    plans.plans.push_back(flights_.back().coasting());
    plans.active.emplace_back();
  }
  void addAllPairs() {
    for (std::size_t first = 0; first < flights_.size(); ++first) {
      for (std::size_t second = first + 1; second < flights_.size(); ++second) {
        problem.pairs.push_back({first, second, kPairDistance, kPairDistance, 0.0});
      }
    }
  }
  FlightProblem& uav(std::size_t i) { return flights_[i]; }
  /// Least distance of two plans, sampled densely [m].
  double leastDistance(std::size_t first, std::size_t second) const {
    double least = 1e300;
    const Trajectory &a = plans.plans[first], &b = plans.plans[second];
    for (double t = 0.0; t <= a.duration(); t += a.dt / 20.0) {
      least = std::min(least, (a.after(t).p - b.after(t).p).norm());
    }
    return least;
  }

  JointProblem problem;
  JointPlans plans;

 private:
  std::deque<FlightProblem> flights_;
};

class JointSqp : public ::testing::Test {
 protected:
  JointSqpSolver solver_{std::make_unique<GeneratedJointSolver>(
      models(), std::make_unique<GeneratedSolver>(std::make_shared<GeneratedTables>(models())))};
};

TEST_F(JointSqp, UavsThatDoNotMeetGetThePlansThatEachFindsAlone) {
  Flight flight;
  for (int i = 0; i < 4; ++i) flight.add(Vector3(0, 30.0 * i, 10), Vector3(100, 30.0 * i, 10), 3.0);
  flight.uav(1).addObstacle(
      Superellipsoid(1, Vector3(9, 30.3, 10), Vector3(2, 2, 2), Vector3(2, 2, 2), 0.0, Vector3::Zero()));
  flight.addAllPairs();
  SqpSolver alone(std::make_unique<GeneratedSolver>(std::make_shared<GeneratedTables>(models())));
  std::vector<Trajectory> expected = flight.plans.plans;
  for (std::size_t i = 0; i < 4; ++i) {
    ActiveRows none;
    ASSERT_TRUE(alone.solve(*flight.problem.uavs[i], expected[i], none).solved);
  }
  const std::vector<SqpResult>& results = solver_.solve(flight.problem, flight.plans);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(results[i].solved);
    EXPECT_NEAR(merit(*flight.problem.uavs[i], flight.plans.plans[i]).value,
                merit(*flight.problem.uavs[i], expected[i]).value, 1e-3)
        << "UAV " << i;
  }
}

// Also where a step is refused: a plan that stays is worth what it was.
TEST_F(JointSqp, AUavOfItsOwnGetsThePlanThatItFindsAloneToTheBit) {
  SqpSolver alone(std::make_unique<GeneratedSolver>(std::make_shared<GeneratedTables>(models())));
  Random random(5);
  int refused = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Flight flight;
    flight.add(Vector3(0, 0, 10), Vector3(60, 0, 10), 4.0);
    for (int i = 0; i < 6; ++i) {
      flight.uav(0).addObstacle(Superellipsoid(i, random.vector(-5.0, 5.0) + Vector3(9, 0, 10), random.vector(0.5, 2.5),
                                               Vector3(8, 8, 8), 0.0, Vector3::Zero()));
    }
    const UavProblem& problem = *flight.problem.uavs[0];
    flight.plans.plans[0] = wanderingPlan(random, problem.start, 4.0, problem.epoch, problem.dt);
    Trajectory expected = flight.plans.plans[0];
    ActiveRows none;
    const SqpResult lonely = alone.solve(problem, expected, none);
    const SqpResult joint = solver_.solve(flight.problem, flight.plans)[0];
    EXPECT_TRUE(identical(flight.plans.plans[0], expected)) << "trial " << trial;
    EXPECT_EQ(joint.merit, lonely.merit) << "trial " << trial;
    EXPECT_EQ(joint.iterations, lonely.iterations) << "trial " << trial;
    refused += lonely.iterations > 1 ? 1 : 0;
  }
  EXPECT_GT(refused, 20);
}

TEST_F(JointSqp, BothOfACrossingPairGiveWay) {
  Flight flight;
  flight.add(Vector3(-8, 0, 10), Vector3(60, 0, 10), 3.0);
  flight.add(Vector3(0, -8.5, 10), Vector3(0, 60, 10), 3.0);
  // Without the pair they fly on through each other: the negative control.
  solver_.solve(flight.problem, flight.plans);
  EXPECT_LT(flight.leastDistance(0, 1), 0.5 * kPairDistance);
  const std::vector<Trajectory> unaware = flight.plans.plans;

  flight.addAllPairs();
  const std::vector<SqpResult>& results = solver_.solve(flight.problem, flight.plans);
  EXPECT_TRUE(results[0].solved);
  EXPECT_GE(flight.leastDistance(0, 1), kPairDistance - 1e-3);
  for (std::size_t i = 0; i < 2; ++i) {
    double moved = 0.0;
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      moved = std::max(moved, (flight.plans.plans[i].knots[k].p - unaware[i].knots[k].p).norm());
    }
    EXPECT_GT(moved, 0.2) << "UAV " << i;
  }
}

TEST_F(JointSqp, StopsAfterTheQpInWhichTheTimeIsSpent) {
  for (const int allowed : {1, 2, 100}) {
    Flight flight;
    flight.add(Vector3(0, 0, 10), Vector3(100, 0, 10), 3.0);
    flight.add(Vector3(9, -9, 10), Vector3(9, 91, 10), 3.0);
    flight.addAllPairs();
    int asked = 0;
    const SqpResult result = solver_.solve(flight.problem, flight.plans, [&] { return ++asked >= allowed; })[0];
    EXPECT_TRUE(result.solved);
    EXPECT_EQ(result.iterations, asked);
    EXPECT_TRUE(allowed < 100 ? result.iterations == allowed : result.iterations > 2) << result.iterations;
  }
}

TEST_F(JointSqp, NeverMakesPlansWorse) {
  Random random(3);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Flight flight;
    const int count = random.integer(2, static_cast<int>(kMostJointUavs));
    for (int i = 0; i < count; ++i) {
      const Vector3 from = random.vector(-8.0, 8.0) + Vector3(0, 0, 20);
      flight.add(from, random.vector(-8.0, 8.0) + Vector3(0, 0, 20), random.uniform(0.5, 4.0));
    }
    flight.addAllPairs();
    std::vector<PredictedMotion> motions(static_cast<std::size_t>(count));
    const auto valueOf = [&](const std::vector<Trajectory>& plans) {
      for (std::size_t i = 0; i < plans.size(); ++i) predict(plans[i], motions[i]);
      JointPlanes none;
      none.of_uavs.resize(plans.size());
      JointMerit found;
      findJointMerit(flight.problem, plans, motions, none, found);
      return found.value();
    };
    const double before = valueOf(flight.plans.plans);
    const std::vector<SqpResult>& results = solver_.solve(flight.problem, flight.plans);
    EXPECT_LE(results[0].merit, before);
    EXPECT_TRUE(results[0].solved);
  }
}

}  // namespace
}  // namespace swarm_planner
