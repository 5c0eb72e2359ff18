// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The merit decides which plan is flown, the violation which one is reported: what they do not see, nobody sees.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/flight_problem.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"
#include "swarm_planner/problem/tracking_cost.hpp"

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::vector<Vector3> kPath{Vector3(0, 0, 10), Vector3(100, 0, 10)};

Trajectory acceleratingPlan(const Vector3& p, const Vector3& a, double dt) {
  std::array<Vector3, kHorizon> jerks;
  jerks.fill(Vector3::Zero());
  return makePlan({p, Vector3::Zero(), a}, jerks, 0.0, dt);
}

/// A problem in which nothing but what a test adds can be violated.
class ViolationTest : public ::testing::Test {
 protected:
  ViolationTest() : flight_(kPath, 3.0, {Vector3(0, 0, 10), Vector3::Zero(), Vector3::Zero()}) {
    flight_.parameters.limits.max_speed = 1e3;
    flight_.parameters.limits.max_thrust_ratio = 1e3;
    flight_.parameters.limits.min_thrust_ratio = -1e3;
    flight_.parameters.vehicle.drag_x = flight_.parameters.vehicle.drag_y = flight_.parameters.vehicle.drag_z = 0.0;
    flight_.useParameters();
  }

  /// Expects `count` constraints to be violated by `by` each.
  void expectViolation(const Trajectory& plan, int count, double by) const {
    const Violation violation = planViolation(flight_.problem, plan);
    EXPECT_NEAR(violation.linear, count * by, 1e-9);
    EXPECT_NEAR(violation.quadratic, count * by * by, 1e-9);
    EXPECT_NEAR(violation.largest, by, 1e-9);
  }
  Trajectory resting(const Vector3& p) const { return straightPlan(p, Vector3::Zero(), 0.0, flight_.problem.dt); }

  FlightProblem flight_;
};

TEST_F(ViolationTest, IsZeroWithoutAnythingToViolate) { expectViolation(resting(Vector3(0, 0, 10)), 0, 0.0); }

TEST_F(ViolationTest, CountsSpeedAtKnotsAndControlPoints) {
  flight_.problem.bounds.max_speed = 5.0;
  const double dt = flight_.problem.dt;
  expectViolation(straightPlan(Vector3::Zero(), Vector3(3, 0, 4), 0.0, dt), 0, 0.0);
  expectViolation(straightPlan(Vector3::Zero(), Vector3(0, 3.6, -4.8), 0.0, dt), 2 * kHorizon, 1.0);
}

TEST_F(ViolationTest, CountsSpeedBetweenTheKnots) {
  // Faster and slower again within the second stage: the knots are innocent.
  flight_.problem.bounds.max_speed = 5.0;
  const double dt = flight_.problem.dt;
  const double a = 1.2 / dt;
  std::array<Vector3, kHorizon> jerks;
  jerks.fill(Vector3::Zero());
  jerks[0] = Vector3(2.0 * a / dt, 0, 0);
  jerks[1] = -jerks[0];
  jerks[2] = 0.5 * jerks[0];
  const Trajectory plan = makePlan({Vector3::Zero(), Vector3(4.9, 0, 0), Vector3(-a, 0, 0)}, jerks, 0.0, dt);
  for (const KinematicState& knot : plan.knots) ASSERT_LT(knot.v.norm(), 5.0);
  ASSERT_GT(plan.after(1.5 * dt).v.norm(), 5.0);
  expectViolation(plan, 1, 0.5);
  flight_.problem.bounds.between_samples = false;
  expectViolation(plan, 0, 0.0);
}

TEST_F(ViolationTest, CountsAcceleration) {
  flight_.problem.bounds.max_acceleration = 2.0;
  expectViolation(acceleratingPlan(Vector3::Zero(), Vector3(0, 1.9, 0), flight_.problem.dt), 0, 0.0);
  expectViolation(acceleratingPlan(Vector3::Zero(), Vector3(0, 1.8, 2.4), flight_.problem.dt), kHorizon, 1.0);
}

TEST_F(ViolationTest, CountsThrust) {
  const double g = flight_.parameters.vehicle.gravity;
  flight_.problem.bounds.max_thrust_acceleration = 2.0 * g;
  expectViolation(acceleratingPlan(Vector3::Zero(), Vector3(0, 0, 0.99 * g), flight_.problem.dt), 0, 0.0);
  expectViolation(acceleratingPlan(Vector3::Zero(), Vector3(0, 0, 1.5 * g), flight_.problem.dt), kHorizon, 0.5 * g);
  // Sideways it takes sqrt(3) g to come to twice the weight.
  const double sideways = std::sqrt(9.0 - 1.0) * g;
  expectViolation(acceleratingPlan(Vector3::Zero(), Vector3(sideways, 0, 0), flight_.problem.dt), kHorizon, g);
}

TEST_F(ViolationTest, CountsTheDragInThrust) {
  const double g = flight_.parameters.vehicle.gravity;
  flight_.problem.bounds.max_thrust_acceleration = 2.0 * g;
  flight_.problem.bounds.drag_over_mass = Vector3(0, 0, 0.5);
  expectViolation(straightPlan(Vector3::Zero(), Vector3(0, 0, 2.0 * g + 2.0), 0.0, flight_.problem.dt), kHorizon, 1.0);
}

TEST_F(ViolationTest, CountsLeastThrust) {
  const double g = flight_.parameters.vehicle.gravity;
  flight_.problem.bounds.min_vertical_thrust = -0.8 * g;
  expectViolation(acceleratingPlan(Vector3::Zero(), Vector3(5, 0, -0.79 * g), flight_.problem.dt), 0, 0.0);
  expectViolation(acceleratingPlan(Vector3::Zero(), Vector3(5, 0, -0.9 * g), flight_.problem.dt), kHorizon, 0.1 * g);
}

TEST_F(ViolationTest, CountsTheWorkspaceLessTheMargin) {
  const Workspace workspace{Vector3(-5, -5, 0), Vector3(5, 5, 20)};
  const double margin = flight_.parameters.limits.tracking_margin;
  flight_.problem.bounds.workspace = FlightBounds(flight_.parameters, &workspace).workspace;
  expectViolation(resting(Vector3(0, 5.0 - margin, margin)), 0, 0.0);
  // Three control points of every segment; the first one is the last of the segment before or the start.
  expectViolation(resting(Vector3(0, 5.0 - margin + 0.5, 10)), 3 * kHorizon, 0.5);
  expectViolation(resting(Vector3(-5.0 + margin - 0.5, 0, 10)), 3 * kHorizon, 0.5);
  expectViolation(resting(Vector3(0, 0, margin - 0.5)), 3 * kHorizon, 0.5);
  flight_.problem.bounds.between_samples = false;
  expectViolation(resting(Vector3(0, 0, margin - 0.5)), kHorizon, 0.5);
}

TEST_F(ViolationTest, CountsObstacles) {
  flight_.parameters.cost.epsilon_s = 0.0;
  const LimitParameters& limits = flight_.parameters.limits;
  const double kept = limits.uav_radius + limits.tracking_margin;
  flight_.addObstacle(
      Superellipsoid(1, Vector3(0, 0, 10), Vector3::Constant(5.0), Vector3::Constant(2.0), 0.0, Vector3::Zero()));
  expectViolation(resting(Vector3(0, -5.0 - kept, 10)), 0, 0.0);
  expectViolation(resting(Vector3(0, 0, 15.0 + kept - 0.4)), 4 * kHorizon, 0.4);
}

TEST_F(ViolationTest, CountsObstaclesWhereTheyWillBe) {
  // It runs over the UAV in the third second: ten stages later it is centred on it.
  const double dt = flight_.problem.dt;
  flight_.addObstacle(Superellipsoid(1, Vector3(-10.0 * dt * 4.0, 0, 10), Vector3::Constant(1.0),
                                     Vector3::Constant(2.0), 0.0, Vector3(4, 0, 0)));
  EXPECT_GT(planViolation(flight_.problem, resting(Vector3(0, 0, 10))).largest, 1.0);
  EXPECT_EQ(planViolation(flight_.problem, resting(Vector3(0, 3, 10))).largest, 0.0);
  EXPECT_EQ(planViolation(flight_.problem, straightPlan(Vector3::Zero() + Vector3(0, 0, 10), Vector3(5, 0, 0), 0.0, dt))
                .largest,
            0.0);
}

TEST_F(ViolationTest, CountsOtherUavs) {
  flight_.addUav(resting(Vector3(0, 0, 10)));
  const double kept = flight_.parameters.limits.pair_distance + flight_.parameters.limits.pair_margin;
  expectViolation(resting(Vector3(kept, 0, 10)), 0, 0.0);
  expectViolation(resting(Vector3(0, kept - 0.7, 10)), 4 * kHorizon, 0.7);
}

TEST_F(ViolationTest, CountsBodiesAtTheKnotsAloneWithoutSegmentConstraints) {
  const double dt = flight_.problem.dt;
  const double stage = 7.0;  // [m]
  const auto passing = [&](double x, double y) {
    return straightPlan(Vector3(x, y, 10), Vector3(stage / dt, 0, 0), 0.0, dt);
  };
  flight_.addObstacle(
      Superellipsoid(1, Vector3(0, 0, 10), Vector3::Constant(1.0), Vector3::Constant(2.0), 0.0, Vector3::Zero()));
  flight_.addUav(resting(Vector3(0, 0, 10)));
  // Through the middle of both, with the knots 3.5 m before and behind.
  EXPECT_GT(planViolation(flight_.problem, passing(-1.5 * stage, 0.0)).largest, 1.0);
  flight_.problem.bounds.between_samples = false;
  expectViolation(passing(-1.5 * stage, 0.0), 0, 0.0);
  const double kept = flight_.parameters.limits.pair_distance + flight_.parameters.limits.pair_margin;
  expectViolation(passing(-2.0 * stage, kept - 0.4), 1, 0.4);
}

TEST_F(ViolationTest, SumsWhatItCounts) {
  flight_.problem.bounds.max_acceleration = 2.0;
  flight_.addUav(resting(Vector3(500, 0, 10)));
  flight_.problem.bounds.min_vertical_thrust = -1.0;
  const Violation violation =
      planViolation(flight_.problem, acceleratingPlan(Vector3::Zero(), Vector3(0, 0, -3), flight_.problem.dt));
  EXPECT_NEAR(violation.linear, kHorizon * (1.0 + 2.0), 1e-9);
  EXPECT_NEAR(violation.quadratic, kHorizon * (1.0 + 4.0), 1e-9);
  EXPECT_NEAR(violation.largest, 2.0, 1e-9);
}

TEST_F(ViolationTest, MeritIsTheCostAndBothPenalties) {
  flight_.addUav(resting(Vector3(0, 0, 10)));
  const Trajectory plan = resting(Vector3(0, 1, 10));
  const Violation violation = planViolation(flight_.problem, plan);
  const SqpParameters& sqp = flight_.parameters.sqp;
  ASSERT_GT(violation.linear, 1.0);
  EXPECT_NEAR(merit(flight_.problem, plan).value,
              planCost(flight_.problem, plan) + sqp.slack_linear * violation.linear +
                  0.5 * sqp.slack_quadratic * violation.quadratic,
              1e-9);
}

// Comparisons with it are false, so such a plan never replaces one with numbers.
TEST_F(ViolationTest, MeritOfAPlanThatIsNotFiniteIsNotBelowAnything) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    Trajectory plan = resting(Vector3(0, 1, 10));
    plan.knots[7].p.y() = bad;
    EXPECT_FALSE(merit(flight_.problem, plan).value < std::numeric_limits<double>::max());
  }
}

TEST(FlightBounds, AreThoseOfTheParameters) {
  Parameters parameters;
  parameters.limits.max_speed = 4.0;
  parameters.limits.max_acceleration = 7.0;
  const Workspace workspace{Vector3(-1, -2, -3), Vector3(1, 2, 3)};
  const FlightBounds bounds(parameters, &workspace);
  EXPECT_EQ(bounds.max_speed, 4.0);
  EXPECT_EQ(bounds.max_acceleration, 7.0);
  EXPECT_NEAR(bounds.max_thrust_acceleration, 2.0 * 9.81, 1e-12);
  EXPECT_NEAR(bounds.min_vertical_thrust + 9.81, 0.2 * 9.81, 1e-12);
  EXPECT_NEAR(bounds.drag_over_mass.x(), 0.25 / 0.468, 1e-12);
  EXPECT_LT((bounds.workspace.max - Vector3(0.8, 1.8, 2.8)).norm(), 1e-12);
  EXPECT_LT((bounds.workspace.min + Vector3(0.8, 1.8, 2.8)).norm(), 1e-12);
  EXPECT_EQ(FlightBounds(parameters, nullptr).workspace.max, Vector3::Constant(kInfinity));
  EXPECT_TRUE(bounds.between_samples);
  parameters.limits.segment_constraints = false;
  EXPECT_FALSE(FlightBounds(parameters, &workspace).between_samples);
}

/// Everything that a plan can violate, sampled densely. Between the knots thrust is not held exactly: there the
/// velocity departs from the line between the knots by up to jerk dt^2 / 8, which drag carries into the thrust.
double sampledViolation(const FlightProblem& flight, const std::vector<Superellipsoid>& obstacles,
                        const std::vector<Trajectory>& uavs, const Trajectory& plan) {
  const FlightBounds& bounds = flight.problem.bounds;
  const LimitParameters& limits = flight.parameters.limits;
  double worst = -kInfinity;
  for (int i = kHorizon * 8; i >= 8; --i) {
    const double t = i * plan.dt / 8.0;
    const KinematicState x = plan.after(t);
    const double curvature = plan.jerks[static_cast<std::size_t>((i - 1) / 8)].norm() * plan.dt * plan.dt / 8.0;
    const double bend = bounds.drag_over_mass.maxCoeff() * curvature;
    const Vector3 thrust = x.a + bounds.drag_over_mass.cwiseProduct(x.v) + bounds.gravity;
    worst = std::max({worst, x.v.norm() - bounds.max_speed, x.a.norm() - bounds.max_acceleration,
                      thrust.norm() - bend - bounds.max_thrust_acceleration,
                      bounds.min_vertical_thrust - bend - (thrust - bounds.gravity).z(),
                      (x.p - bounds.workspace.max).maxCoeff(), (bounds.workspace.min - x.p).maxCoeff()});
    for (const Superellipsoid& obstacle : obstacles) {
      const double kept = limits.uav_radius + limits.tracking_margin;
      worst = std::max(worst, kept - obstacle.movedBy(t).signedDistance(x.p));
    }
    for (const Trajectory& uav : uavs) {
      const double gauge = pairGauge(x.p - uav.after(t).p, limits.pair_distance + limits.pair_margin,
                                     limits.pair_distance_vertical + limits.pair_margin);
      worst = std::max(worst, 1.0 - gauge);
    }
  }
  return worst;
}

/// Random plans among random obstacles and UAVs; calls `judge` with the sampled and the reported violation.
void forRandomPlans(const std::function<void(double sampled, const Violation& reported)>& judge) {
  Random random(1);
  for (int trial = 0; trial < 600; ++trial) {
    const KinematicState start{random.vector(-2.0, 2.0) + Vector3(0, 0, 10), random.vector(-2.0, 2.0),
                               random.vector(-1.0, 1.0)};
    FlightProblem flight(kPath, 3.0, start);
    flight.parameters.limits.max_acceleration = 4.0;
    flight.parameters.limits.pair_distance_vertical = random.uniform(1.0, 3.0);
    const Workspace workspace{Vector3(-15, -15, 0), Vector3(15, 15, 20)};
    flight.setWorkspace(&workspace);
    std::vector<Superellipsoid> obstacles;
    for (int i = random.integer(0, 2); i > 0; --i) {
      const Vector3 radii(random.logUniform(0.3, 4.0), random.logUniform(0.3, 4.0), random.logUniform(0.3, 4.0));
      obstacles.emplace_back(i, random.vector(-8.0, 8.0) + Vector3(0, 0, 10), radii, random.vector(2.0, 10.0),
                             random.uniform(-3.0, 3.0), random.vector(-2.0, 2.0));
      flight.addObstacle(obstacles.back());
    }
    std::vector<Trajectory> uavs;
    for (int i = random.integer(0, 2); i > 0; --i) {
      const KinematicState other{random.vector(-8.0, 8.0) + Vector3(0, 0, 10), random.vector(-2.0, 2.0),
                                 Vector3::Zero()};
      uavs.push_back(wanderingPlan(random, other, 3.0, 0.0, flight.problem.dt));
      flight.addUav(uavs.back());
    }
    const Trajectory plan = wanderingPlan(random, start, random.uniform(0.0, 8.0), 0.0, flight.problem.dt);
    judge(sampledViolation(flight, obstacles, uavs, plan), planViolation(flight.problem, plan));
  }
}

TEST(PlanViolation, OfZeroMeansThatTheWholeCurveKeepsEverything) {
  int clear = 0;
  forRandomPlans([&](double sampled, const Violation& reported) {
    if (reported.linear > 0.0) return;
    ++clear;
    EXPECT_LE(sampled, 1e-9);
  });
  EXPECT_GT(clear, 100);
}

// The control points that are held lie outside of the curve: a plan that passes at a distance must not be blamed.
TEST(PlanViolation, IsZeroForPlansThatKeepEverythingWithRoom) {
  constexpr double kRoom = 1.0;
  int clear = 0;
  forRandomPlans([&](double sampled, const Violation& reported) {
    if (sampled > -kRoom) return;
    ++clear;
    EXPECT_EQ(reported.linear, 0.0);
  });
  EXPECT_GT(clear, 10);
}

TEST(PredictedClearance, IsInfiniteWithoutPartners) {
  FlightProblem flight(kPath, 3.0, {Vector3(0, 0, 10), Vector3(3, 0, 0), Vector3::Zero()});
  const PredictedClearance alone = predictedClearance(flight.problem, flight.coasting());
  EXPECT_EQ(alone.obstacle, kInfinity);
  EXPECT_EQ(alone.pair, kInfinity);
}

TEST(PredictedClearance, AgreesWithSamplingTheKnots) {
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const KinematicState start{Vector3(0, 0, 10), Vector3(4, 0, 0), Vector3::Zero()};
    FlightProblem flight(kPath, 3.0, start);
    const double dt = flight.problem.dt;
    const Trajectory plan = wanderingPlan(random, start, 5.0, 0.0, dt);
    std::vector<Superellipsoid> spheres;
    std::vector<Trajectory> uavs;
    for (int i = 0; i < 3; ++i) {
      spheres.emplace_back(i, Vector3(random.uniform(0, 25), random.uniform(-9, 9), 10),
                           Vector3::Constant(random.uniform(0.5, 5.0)), Vector3::Constant(2.0), 0.0,
                           random.vector(-2.0, 2.0));
      flight.addObstacle(spheres.back());
      const KinematicState other{Vector3(random.uniform(0, 25), random.uniform(-9, 9), 10), random.vector(-3.0, 3.0),
                                 Vector3::Zero()};
      uavs.push_back(wanderingPlan(random, other, 5.0, 0.0, dt));
      flight.addUav(uavs.back());
    }
    double obstacle = kInfinity;
    double pair = kInfinity;
    for (int k = 0; k <= kHorizon; ++k) {
      const Vector3& p = plan.knots[static_cast<std::size_t>(k)].p;
      for (const Superellipsoid& sphere : spheres) {
        const double distance = (p - sphere.movedBy(k * dt).center()).norm() - sphere.radii().x();
        obstacle = std::min(obstacle, distance - flight.parameters.limits.uav_radius);
      }
      for (const Trajectory& uav : uavs) pair = std::min(pair, (p - uav.after(k * dt).p).norm());
    }
    const PredictedClearance clearance = predictedClearance(flight.problem, plan);
    EXPECT_NEAR(clearance.pair, pair, 1e-9);
    EXPECT_NEAR(clearance.obstacle, obstacle, 1e-9);
  }
}

TEST(PredictedClearance, NeverPromisesMoreThanThereIs) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const KinematicState start{Vector3(0, 0, 10), Vector3(4, 0, 0), Vector3::Zero()};
    FlightProblem flight(kPath, 3.0, start);
    const Trajectory plan = wanderingPlan(random, start, 5.0, 0.0, flight.problem.dt);
    double least = kInfinity;
    std::vector<Superellipsoid> bodies;
    for (int i = 0; i < 3; ++i) {
      const Vector3 radii(random.logUniform(0.3, 10.0), random.logUniform(0.3, 10.0), random.logUniform(0.3, 10.0));
      bodies.emplace_back(i, Vector3(random.uniform(0, 25), random.uniform(-9, 9), 10), radii, random.vector(2.0, 10.0),
                          random.uniform(-3.0, 3.0), random.vector(-2.0, 2.0));
      flight.addObstacle(bodies.back());
    }
    for (const Superellipsoid& body : bodies) {
      for (int k = 0; k <= kHorizon; ++k) {
        const double distance =
            body.movedBy(k * flight.problem.dt).signedDistance(plan.knots[static_cast<std::size_t>(k)].p);
        least = std::min(least, distance - flight.parameters.limits.uav_radius);
      }
    }
    EXPECT_LE(predictedClearance(flight.problem, plan).obstacle, least + 1e-8);
  }
}

}  // namespace
}  // namespace swarm_planner
