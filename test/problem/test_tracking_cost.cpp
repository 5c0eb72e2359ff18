// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The solver minimises what these functions say. A wrong gradient makes UAVs drift off their references or stop the
// iterations early; an indefinite Hessian leaves the quadratic program without an answer.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "obstacles/random_bodies.hpp"
#include "support/central_difference.hpp"
#include "support/flight_problem.hpp"
#include "swarm_planner/obstacles/robustness.hpp"
#include "swarm_planner/problem/tracking_cost.hpp"

namespace swarm_planner {
namespace {

using Path = std::vector<Vector3>;

const Path kLineAlongX{Vector3(0, 100, 20), Vector3(1000, 100, 20)};
const Path kCorner{Vector3(0, 0, 10), Vector3(6, 0, 10), Vector3(6, 6, 14)};
const Path kVertical{Vector3(2, 3, 0), Vector3(2, 3, 50)};

KinematicState randomState(Random& random, const Vector3& near) {
  return {near + random.vector(-3.0, 3.0), random.vector(-5.0, 5.0), random.vector(-3.0, 3.0)};
}

/// Every other time the last stage, whose cost differs.
int randomStage(Random& random) { return random.integer(0, 1) == 0 ? kHorizon : random.integer(1, kHorizon - 1); }

void randomiseWeights(Random& random, CostParameters& cost) {
  cost.alpha = random.uniform(0.1, 2.0);
  cost.beta = random.uniform(0.1, 2.0);
  cost.eta = random.uniform(0.01, 1.0);
  cost.zeta = random.uniform(0.01, 1.0);
  cost.velocity_time = random.uniform(0.2, 2.0);
  cost.stop_weight = random.uniform(0.0, 10.0);
}

/// Holds the derivatives of one stage's cost against central differences of its value.
void expectDerivatives(const UavProblem& problem, int stage, const KinematicState& x, double scale) {
  const PathPoint foot = problem.path->nearest(x.p, problem.progress);
  const StageFrame frame = makeStageFrame(foot);
  const StageCost cost = stageCost(problem, stage, frame, x);
  const auto ofPosition = [&](const Vector3& p) { return stageCost(problem, stage, frame, {p, x.v, x.a}).value; };
  const auto ofAcceleration = [&](const Vector3& a) { return stageCost(problem, stage, frame, {x.p, x.v, a}).value; };
  const auto ofVelocity = [&](const Vector3& v) { return stageCost(problem, stage, frame, {x.p, v, x.a}).value; };
  // What rounding leaves of a difference: the value's last digit over the step.
  const double tolerance = 1e-6 * (1.0 + std::abs(cost.value) / scale);
  EXPECT_LT((centralGradient(ofPosition, x.p, scale) - cost.position_gradient).norm(), tolerance);
  EXPECT_LT((centralGradient(ofVelocity, x.v, 1.0) - cost.velocity_gradient).norm(),
            1e-6 * (1.0 + std::abs(cost.value)));
  const Vector3 acceleration_gradient = accelerationWeight(*problem.parameters, stage) * x.a;
  EXPECT_LT((centralGradient(ofAcceleration, x.a, 1.0) - acceleration_gradient).norm(),
            1e-6 * (1.0 + std::abs(cost.value)));
}

class TrackingCostOnPath : public ::testing::TestWithParam<Path> {};

TEST_P(TrackingCostOnPath, HasTheGradientOfItsValue) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    FlightProblem flight(GetParam(), 3.0, {GetParam().front(), Vector3::Zero(), Vector3::Zero()});
    randomiseWeights(random, flight.parameters.cost);
    const int stage = randomStage(random);
    const double s = random.uniform(0.0, 8.0);
    flight.problem.progress = s;
    const KinematicState x = randomState(random, flight.problem.path->at(s).position);
    expectDerivatives(flight.problem, stage, x, 1.0);
  }
}

// Without obstacles the model of the cost at fixed feet is the cost itself, so one QP finds the minimum.
TEST_P(TrackingCostOnPath, HasTheExactHessianWithoutObstacles) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    FlightProblem flight(GetParam(), 3.0, {GetParam().front(), Vector3::Zero(), Vector3::Zero()});
    randomiseWeights(random, flight.parameters.cost);
    const UavProblem& problem = flight.problem;
    const int stage = randomStage(random);
    const KinematicState x = randomState(random, problem.path->at(random.uniform(0.0, 8.0)).position);
    const StageFrame frame = makeStageFrame(problem.path->nearest(x.p, problem.progress));
    const StageCost cost = stageCost(problem, stage, frame, x);
    const KinematicState moved = randomState(random, x.p);
    const Vector3 dp = moved.p - x.p;
    const Vector3 dv = moved.v - x.v;
    const double model =
        cost.value + cost.position_gradient.dot(dp) + 0.5 * dp.dot(cost.position_hessian * dp) +
        cost.velocity_gradient.dot(dv) + 0.5 * velocityWeight(*problem.parameters, stage) * dv.squaredNorm() +
        0.5 * accelerationWeight(*problem.parameters, stage) * (moved.a.squaredNorm() - x.a.squaredNorm());
    EXPECT_NEAR(model, stageCost(problem, stage, frame, moved).value, 1e-11 * (1.0 + cost.value + model));
  }
}

TEST_P(TrackingCostOnPath, FramesAreOrthonormalWithHorizontalAcross) {
  Random random(3);
  const ReferencePath path(GetParam());
  for (int trial = 0; trial < 100; ++trial) {
    const StageFrame frame = makeStageFrame(path.at(random.uniform(-1.0, path.length() + 1.0)));
    Matrix3 axes;
    axes << frame.foot.tangent, frame.horizontal, frame.vertical;
    EXPECT_LT((axes.transpose() * axes - Matrix3::Identity()).norm(), 1e-12);
    EXPECT_GT(axes.determinant(), 0.0);
    EXPECT_NEAR(frame.horizontal.z(), 0.0, 1e-12) << "alpha weighs the horizontal deviation";
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, TrackingCostOnPath, ::testing::Values(kLineAlongX, kCorner, kVertical));

// But for the last stage, where plans are held to rest instead of to the target's velocity.
TEST(TrackingCost, OfALineAlongXIsThatOfThePaper) {
  Random random(4);
  constexpr double kYd = 100.0;
  constexpr double kZd = 20.0;
  for (int trial = 0; trial < 50; ++trial) {
    const KinematicState start = randomState(random, Vector3(20, kYd, kZd));
    FlightProblem flight(kLineAlongX, 3.0, start);
    CostParameters& weights = flight.parameters.cost;
    randomiseWeights(random, weights);
    const Trajectory plan = wanderingPlan(random, start, 5.0, 0.0, flight.problem.dt);
    double sum = 0.0;
    for (std::size_t k = 1; k <= kHorizon; ++k) {
      const KinematicState& x = plan.knots[k];
      const Vector3 target(3.0 * static_cast<double>(k) * plan.dt, kYd, kZd);
      const Vector3 slower = weights.velocity_time * (x.v - Vector3(3, 0, 0));
      const double rate = weights.zeta * plan.jerks[k - 1].squaredNorm();
      sum += weights.alpha * std::pow(x.p.y() - kYd, 2) + weights.beta * std::pow(x.p.z() - kZd, 2) +
             weights.eta * (x.p - target).squaredNorm() + rate;
      if (k < kHorizon) {
        sum += weights.eta * slower.squaredNorm();
      } else {
        sum += weights.stop_weight * std::pow(weights.velocity_time, 2) *
               (x.v.squaredNorm() + std::pow(plan.dt / 3.0, 2) * x.a.squaredNorm());
      }
    }
    EXPECT_NEAR(planCost(flight.problem, plan), plan.dt * sum, 1e-9 * sum);
  }
}

TEST(TrackingCost, WeighsTheDeviationFromAVerticalPathAlongY) {
  FlightProblem flight(kVertical, 0.0, {Vector3(2, 3, 10), Vector3::Zero(), Vector3::Zero()});
  flight.parameters.cost.alpha = 1.0;
  flight.parameters.cost.beta = 10.0;
  flight.parameters.cost.eta = 0.0;
  const StageFrame frame = makeStageFrame(flight.problem.path->at(10.0));
  const auto costAt = [&](const Vector3& offset) {
    return stageCost(flight.problem, 1, frame, {Vector3(2, 3, 10) + offset, Vector3::Zero(), Vector3::Zero()}).value;
  };
  EXPECT_NEAR(costAt(Vector3(0, 2, 0)), 4.0 * flight.problem.dt, 1e-12);
  EXPECT_NEAR(costAt(Vector3(2, 0, 0)), 40.0 * flight.problem.dt, 1e-12);
  EXPECT_NEAR(costAt(Vector3(0, 0, 2)), 0.0, 1e-12);
}

TEST(TrackingCost, WeighsVelocityAndJerkAsTheQpDoes) {
  Random random(5);
  FlightProblem flight(kLineAlongX, 3.0, {});
  randomiseWeights(random, flight.parameters.cost);
  const CostParameters& weights = flight.parameters.cost;
  EXPECT_DOUBLE_EQ(jerkWeight(flight.parameters), 2.0 * flight.problem.dt * weights.zeta);
  const double squared_time = weights.velocity_time * weights.velocity_time;
  for (const int stage : {1, kHorizon - 1}) {
    EXPECT_DOUBLE_EQ(velocityWeight(flight.parameters, stage), 2.0 * flight.problem.dt * weights.eta * squared_time);
    EXPECT_EQ(accelerationWeight(flight.parameters, stage), 0.0);
  }
  const double final_weight = 2.0 * flight.problem.dt * weights.stop_weight * squared_time;
  EXPECT_DOUBLE_EQ(velocityWeight(flight.parameters, kHorizon), final_weight);
  EXPECT_DOUBLE_EQ(accelerationWeight(flight.parameters, kHorizon),
                   final_weight * std::pow(flight.problem.dt / 3.0, 2));
}

/// A UAV near moving obstacles of all kinds, where the robustness function counts.
class RobustTracking : public ::testing::Test {
 protected:
  /// An obstacle placed such that at `stage` the point `p` has the value `sum` of S.
  static void addObstacleAround(Random& random, FlightProblem& flight, const Vector3& p, int stage, double sum) {
    Superellipsoid shape = randomBody(random, 0.5, 5.0);
    const Vector3 exponents = random.vector(2.0, 10.0);
    shape = Superellipsoid(1, Vector3::Zero(), shape.radii(), exponents, shape.yaw(), shape.velocity());
    Vector3 u = random.direction();
    u /= shape.gauge(u, sum).value;
    const Vector3 center = p - u - stage * flight.problem.dt * shape.velocity();
    flight.addObstacle(Superellipsoid(1, center, shape.radii(), exponents, shape.yaw(), shape.velocity()));
  }
};

TEST_F(RobustTracking, HasTheGradientOfItsValue) {
  Random random(6);
  for (int trial = 0; trial < 300; ++trial) {
    FlightProblem flight(kLineAlongX, 3.0, {});
    flight.parameters.cost.robustness_gain = random.uniform(0.5, 5.0);
    const int stage = random.integer(1, kHorizon);
    const KinematicState x = randomState(random, Vector3(10, 100, 20));
    flight.problem.progress = 10.0;
    for (int i = 0; i < 3; ++i) addObstacleAround(random, flight, x.p, stage, random.uniform(1.0, 3.0));
    expectDerivatives(flight.problem, stage, x, 0.05);
  }
}

// Only the obstacles within reach are evaluated: leaving one out that counts would make the cost jump.
TEST_F(RobustTracking, AddsTheTermOfEveryObstacleWhereItIsThen) {
  Random random(7);
  int counted = 0;
  for (int trial = 0; trial < 500; ++trial) {
    FlightProblem flight(kLineAlongX, 3.0, {});
    const KinematicState x = randomState(random, Vector3(10, 100, 20));
    const int stage = random.integer(1, kHorizon);
    addObstacleAround(random, flight, x.p, stage, random.uniform(1.0, 3.0));
    flight.addUav(straightPlan(x.p, Vector3::Zero(), 0.0, flight.problem.dt));
    const StageFrame frame = makeStageFrame(flight.problem.path->nearest(x.p, 10.0));
    const double with = stageCost(flight.problem, stage, frame, x).value;
    const Superellipsoid then = flight.problem.bodies[0].obstacle()->movedBy(stage * flight.problem.dt);
    const double term = robustness(then, x.p, RobustnessParameters(flight.parameters.cost)).value;
    flight.parameters.cost.robustness_gain = 0.0;
    const double without = stageCost(flight.problem, stage, frame, x).value;
    EXPECT_NEAR(with - without, flight.problem.dt * term, 1e-9 * (1.0 + without));
    counted += term > 1e-6 ? 1 : 0;
  }
  EXPECT_GT(counted, 100);
}

TEST_F(RobustTracking, HasAPositiveSemiDefiniteHessian) {
  Random random(8);
  for (int trial = 0; trial < 500; ++trial) {
    FlightProblem flight(kLineAlongX, 3.0, {});
    randomiseWeights(random, flight.parameters.cost);
    flight.parameters.cost.robustness_gain = random.uniform(0.0, 100.0);
    const KinematicState x = randomState(random, Vector3(10, 100, 20));
    for (int i = 0; i < 3; ++i) addObstacleAround(random, flight, x.p, 4, random.uniform(0.1, 3.0));
    const StageCost cost = stageCost(flight.problem, 4, makeStageFrame(flight.problem.path->at(10.0)), x);
    const Matrix3& hessian = cost.position_hessian;
    EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-14 * hessian.norm());
    const Vector3 eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix3>(hessian).eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), 0.0) << "eta alone makes it positive";
  }
}

// A plan that goes straight on where its reference crosses itself must be held against its own branch.
TEST(StageFrames, DoNotJumpWhereTheReferenceCrossesItself) {
  // Forth along x, round a loop, and back across the first leg at (10, 0, 5), arc length 10 and 70.
  const Path loop{Vector3(0, 0, 5), Vector3(30, 0, 5), Vector3(30, 20, 5), Vector3(10, 20, 5), Vector3(10, -40, 5)};
  const double dt = 0.3;
  FlightProblem forth(loop, 3.0, {Vector3(2, 0.2, 5), Vector3(4, 0, 0), Vector3::Zero()});
  forth.problem.progress = 2.0;
  StageFrames frames;
  findStageFrames(forth.problem, straightPlan(Vector3(2, 0.2, 5), Vector3(4, 0, 0), 0.0, dt), frames);
  for (int k = 0; k <= kHorizon; ++k) {
    EXPECT_NEAR(frames[static_cast<std::size_t>(k)].foot.arc_length, 2.0 + 4.0 * dt * k, 1e-9) << "stage " << k;
  }
  FlightProblem back(loop, 3.0, {Vector3(10.2, 10, 5), Vector3(0, -4, 0), Vector3::Zero()});
  back.problem.progress = 80.0;
  findStageFrames(back.problem, straightPlan(Vector3(10.2, 10, 5), Vector3(0, -4, 0), 0.0, dt), frames);
  for (int k = 0; k <= kHorizon; ++k) {
    EXPECT_NEAR(frames[static_cast<std::size_t>(k)].foot.arc_length, 80.0 + 4.0 * dt * k, 1e-9) << "stage " << k;
  }
}

TEST(StageFrames, OfALengthZeroReferenceAreItsPoint) {
  FlightProblem flight({Vector3(1, 2, 3)}, 0.0, {Vector3(1, 2, 3), Vector3(1, 0, 0), Vector3::Zero()});
  StageFrames frames;
  findStageFrames(flight.problem, flight.coasting(), frames);
  for (const StageFrame& frame : frames) EXPECT_EQ(frame.foot.position, Vector3(1, 2, 3));
}

}  // namespace
}  // namespace swarm_planner
