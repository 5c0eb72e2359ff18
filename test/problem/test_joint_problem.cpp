// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What a step of the whole swarm is judged by. If these fail, a pair counts twice or not at all.
#include <gtest/gtest.h>

#include "support/flight_problem.hpp"
#include "swarm_planner/problem/joint_problem.hpp"

namespace swarm_planner {
namespace {

TEST(JointProblem, PredictsAPlanExactly) {
  Random random(1);
  const KinematicState start{random.vector(-3.0, 3.0), random.vector(-3.0, 3.0), random.vector(-1.0, 1.0)};
  const Trajectory plan = wanderingPlan(random, start, 3.0, 0.0, 0.3);
  PredictedMotion exact, fitted;
  predict(plan, exact);
  predict(plan, 0.0, 0.3, fitted);
  for (std::size_t i = 0; i < exact.points.size(); ++i) {
    EXPECT_LT((exact.points[i] - fitted.points[i]).norm(), 1e-9) << "point " << i;
  }
  EXPECT_LT((exact.box.min - fitted.box.min).norm() + (exact.box.max - fitted.box.max).norm(), 1e-9);
}

TEST(JointProblem, APairsViolationCountsOnce) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(1, 0, 0), Vector3::Zero()};
  const KinematicState beside{Vector3(0, 1, 10), Vector3(1, 0, 0), Vector3::Zero()};
  FlightProblem one({start.p, Vector3(50, 0, 10)}, 1.0, start), two({beside.p, Vector3(50, 1, 10)}, 1.0, beside);
  const std::vector<Trajectory> plans{one.coasting(), two.coasting()};
  std::vector<PredictedMotion> motions(2);
  for (std::size_t i = 0; i < 2; ++i) predict(plans[i], motions[i]);
  JointProblem problem{{&one.problem, &two.problem}, {{0, 1, 2.0, 2.0, 0.0}}};
  JointPlanes planes;
  planes.of_uavs.resize(2);
  JointMerit found;
  findJointMerit(problem, plans, motions, planes, found);
  EXPECT_DOUBLE_EQ(found.of_uavs[0], merit(one.problem, plans[0]).value);
  // All control points are 1 m apart where 2 m are to be kept.
  const double points = 4.0 * kHorizon;
  const SqpParameters& sqp = one.parameters.sqp;
  EXPECT_NEAR(found.of_pairs[0], points * (sqp.slack_linear + 0.5 * sqp.slack_quadratic), 1e-6);
  EXPECT_NEAR(found.largest_violation[0], 1.0, 1e-9);
  EXPECT_NEAR(found.largest_violation[1], 1.0, 1e-9);

  // The start of the first one is too close already: what is waived then does not count.
  problem.pairs[0].margin = 1.0;
  JointMerit relieved;
  findJointMerit(problem, plans, motions, planes, relieved);
  EXPECT_LT(relieved.of_pairs[0], found.of_pairs[0]);
}

}  // namespace
}  // namespace swarm_planner
