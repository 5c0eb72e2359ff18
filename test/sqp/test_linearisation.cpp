// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The solver answers the QP that this poses, not the problem: where the two differ, plans are slow, stuck or unsafe.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "support/central_difference.hpp"
#include "support/flight_problem.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"
#include "swarm_planner/problem/tracking_cost.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/separating_planes.hpp"

namespace swarm_planner {
namespace {

constexpr double kBand = 3.0;
const std::vector<Vector3> kLine{Vector3(0, 0, 10), Vector3(100, 0, 10)};
const std::vector<Vector3> kCornered{Vector3(0, 0, 10), Vector3(8, 0, 10), Vector3(8, 30, 16)};
const std::vector<Vector3> kUpwards{Vector3(0, 0, 10), Vector3(0, 0, 60)};

using Jerks = std::array<Vector3, kHorizon>;

Jerks along(const Jerks& from, const Jerks& direction, double step) {
  Jerks jerks = from;
  for (std::size_t k = 0; k < kHorizon; ++k) jerks[k] += step * direction[k];
  return jerks;
}

/// The QP's objective without rows, less the constant.
double qpCost(const Qp& qp, const Jerks& jerks) {
  const Trajectory plan = makePlan(qp.start, jerks, 0.0, qp.model.dt);
  double sum = 0.0;
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const QpStage& stage = qp.stages[k];
    const KinematicState& x = plan.knots[k];
    const int number = static_cast<int>(k);
    sum += 0.5 * x.p.dot(qp.positionHessian(number) * x.p) + stage.position_gradient.dot(x.p) +
           0.5 * qp.model.velocityWeight(number) * x.v.squaredNorm() + stage.velocity_gradient.dot(x.v) +
           0.5 * qp.model.accelerationWeight(number) * x.a.squaredNorm() +
           0.5 * qp.model.jerk_weight * jerks[k - 1].squaredNorm();
  }
  return sum;
}

/// By how much a plan breaks the QP's rows at most.
double worstRow(const Qp& qp, const Trajectory& plan) {
  double worst = 0.0;
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    for (int i = 0; i < qp.stages[k].row_count; ++i) {
      const QpRow& row = qp.stages[k].rows[static_cast<std::size_t>(i)];
      const Vector3 y = outputValue(qp.outputs[static_cast<std::size_t>(row.output)], plan.knots[k]);
      worst = std::max(worst, row.d - row.n.dot(y));
    }
  }
  return worst;
}

int rowsOf(const Qp& qp, Output output) {
  int count = 0;
  for (const QpStage& stage : qp.stages) {
    for (int i = 0; i < stage.row_count; ++i) count += stage.rows[static_cast<std::size_t>(i)].output == output ? 1 : 0;
  }
  return count;
}

int bodyRows(const Qp& qp) {
  return rowsOf(qp, Output::kPosition) + rowsOf(qp, Output::kControlPoint1) + rowsOf(qp, Output::kControlPoint2);
}

/// Rows on positions that ask for a move along y.
int sidewaysRows(const Qp& qp) {
  int count = 0;
  for (const QpStage& stage : qp.stages) {
    for (int i = 0; i < stage.row_count; ++i) {
      const QpRow& row = stage.rows[static_cast<std::size_t>(i)];
      count += row.output == Output::kPosition && std::abs(row.n.y()) > 0.7 ? 1 : 0;
    }
  }
  return count;
}

Jerks randomJerks(Random& random, double size) {
  Jerks jerks;
  for (Vector3& jerk : jerks) jerk = random.vector(-size, size);
  return jerks;
}

/// A UAV on its way along a path, somewhat beside it.
KinematicState besidePath(Random& random) {
  return {Vector3(1, 0, 10) + random.vector(-0.8, 0.8), Vector3(3, 0, 0) + random.vector(-0.5, 0.5),
          random.vector(-0.5, 0.5)};
}

class LinearisationTest : public ::testing::Test {
 protected:
  const Qp& linearised(const UavProblem& problem, const Trajectory& iterate) {
    linearise(problem, iterate, kBand, *qp_, planes_);
    return *qp_;
  }

  std::unique_ptr<Qp> qp_ = std::make_unique<Qp>();
  SegmentPlanes planes_;
};

class CostModel : public LinearisationTest, public ::testing::WithParamInterface<std::vector<Vector3>> {};

TEST_P(CostModel, HasTheSlopeOfTheCost) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const KinematicState start = besidePath(random);
    FlightProblem flight(GetParam(), 3.0, start);
    if (trial % 2 == 0) crowd(random, flight);
    flight.parameters.cost.robustness_gain = trial % 4 == 0 ? 5.0 : 1.0;
    const Trajectory iterate = wanderingPlan(random, start, 1.0, 0.0, flight.problem.dt);
    const Qp& qp = linearised(flight.problem, iterate);
    const Jerks direction = randomJerks(random, 1.0);
    const double h = differenceStep() * 1e-2;
    const auto cost = [&](double step) {
      return planCost(flight.problem, makePlan(start, along(iterate.jerks, direction, step), 0.0, iterate.dt));
    };
    const double slope = (cost(h) - cost(-h)) / (2.0 * h);
    const double model =
        (qpCost(qp, along(iterate.jerks, direction, h)) - qpCost(qp, along(iterate.jerks, direction, -h))) / (2.0 * h);
    EXPECT_NEAR(model, slope, 1e-5 * (1.0 + std::abs(slope)) + 1e-15 * std::abs(cost(0.0)) / h) << "trial " << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, CostModel, ::testing::Values(kLine, kUpwards));

TEST_F(LinearisationTest, IsTheCostItselfOnALineWithoutObstacles) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const KinematicState start = besidePath(random);
    FlightProblem flight(kLine, 3.0, start);
    const Trajectory iterate = wanderingPlan(random, start, 1.0, 0.0, flight.problem.dt);
    const Qp& qp = linearised(flight.problem, iterate);
    const Jerks other = along(iterate.jerks, randomJerks(random, 3.0), 1.0);
    const double change =
        planCost(flight.problem, makePlan(start, other, 0.0, iterate.dt)) - planCost(flight.problem, iterate);
    EXPECT_NEAR(qpCost(qp, other) - qpCost(qp, iterate.jerks), change, 1e-8 * (1.0 + std::abs(change)));
  }
}

TEST_F(LinearisationTest, HasTheSlopeOfTheCostOnBothSidesOfACorner) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    // Inside of the corner, where the feet lie within the segments.
    const KinematicState start{Vector3(1, 0.5, 10.2), Vector3(2.0, 0.6, 0.1), Vector3::Zero()};
    FlightProblem flight(kCornered, 3.0, start);
    const Trajectory iterate = wanderingPlan(random, start, 0.3, 0.0, flight.problem.dt);
    const Qp& qp = linearised(flight.problem, iterate);
    const Jerks direction = randomJerks(random, 1.0);
    const double h = 1e-7;
    const auto cost = [&](double step) {
      return planCost(flight.problem, makePlan(start, along(iterate.jerks, direction, step), 0.0, iterate.dt));
    };
    const double slope = (cost(h) - cost(-h)) / (2.0 * h);
    const double model =
        (qpCost(qp, along(iterate.jerks, direction, h)) - qpCost(qp, along(iterate.jerks, direction, -h))) / (2.0 * h);
    EXPECT_NEAR(model, slope, 1e-4 * (1.0 + std::abs(slope))) << "trial " << trial;
  }
}

/// Pushes a plan until it satisfies every row of a QP; false if that does not succeed.
bool satisfyRows(const Qp& qp, Trajectory& plan) {
  // Kaczmarz's iteration in the jerks, whose effect on a row follows from the roll-out's linearity.
  for (int sweep = 0; sweep < 200; ++sweep) {
    if (worstRow(qp, plan) <= 1e-9) return true;
    for (std::size_t k = 1; k <= kHorizon; ++k) {
      for (int i = 0; i < qp.stages[k].row_count; ++i) {
        const QpRow& row = qp.stages[k].rows[static_cast<std::size_t>(i)];
        const OutputGains& gains = qp.outputs[static_cast<std::size_t>(row.output)];
        const double missing = row.d - row.n.dot(outputValue(gains, plan.knots[k]));
        if (missing <= 0.0) continue;
        Jerks gradient;
        double squared = 0.0;
        for (std::size_t j = 0; j < kHorizon; ++j) {
          gradient[j].setZero();
          if (j >= k) continue;
          KinematicState effect = propagate(KinematicState(), Vector3::Ones(), qp.model.dt);
          effect = propagate(effect, Vector3::Zero(), static_cast<double>(k - 1 - j) * qp.model.dt);
          gradient[j] = outputValue(gains, effect).cwiseProduct(row.n);
          squared += gradient[j].squaredNorm();
        }
        plan = makePlan(qp.start, along(plan.jerks, gradient, 1.01 * (missing + 1e-9) / squared), plan.epoch, plan.dt);
      }
    }
  }
  return worstRow(qp, plan) <= 1e-9;
}

// Rows hold the whole segment, moving bodies included: what satisfies them may be flown.
TEST_F(LinearisationTest, APlanThatSatisfiesTheRowsKeepsClearOfTheBodies) {
  Random random(4);
  int judged = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const KinematicState start = besidePath(random);
    FlightProblem flight(kLine, 3.0, start);
    const LimitParameters& limits = flight.parameters.limits;
    const double dt = flight.problem.dt;
    const Vector3 radii(random.logUniform(0.5, 3.0), random.logUniform(0.5, 3.0), random.logUniform(0.5, 3.0));
    const Superellipsoid obstacle(1, Vector3(random.uniform(6, 15), random.uniform(-2, 2), 10), radii,
                                  random.vector(2.0, 10.0), random.uniform(-3.0, 3.0), random.vector(-4.0, 4.0));
    const Trajectory other = wanderingPlan(
        random, {Vector3(random.uniform(8, 20), random.uniform(-6, 6), 10), random.vector(-2.0, 2.0), Vector3::Zero()},
        1.0, 0.0, dt);
    flight.addObstacle(obstacle);
    flight.addUav(other);
    Trajectory plan = wanderingPlan(random, start, 1.0, 0.0, dt);
    // With a band as wide as the scene every segment has its row, however far the plan has moved since.
    linearise(flight.problem, plan, 1e3, *qp_, planes_);
    if (!satisfyRows(*qp_, plan)) continue;
    ++judged;
    // The first segment hangs on the start, which may be too close already.
    for (double t = dt; t <= kHorizon * dt; t += dt / 20.0) {
      const Vector3 p = plan.after(t).p;
      EXPECT_GE(obstacle.movedBy(t).signedDistance(p), limits.uav_radius + limits.tracking_margin - 1e-6);
      EXPECT_GE(pairGauge(p - other.after(t).p, limits.pair_distance + limits.pair_margin,
                          limits.pair_distance_vertical + limits.pair_margin),
                1.0 - 1e-6);
    }
  }
  EXPECT_GT(judged, 75);
}

// Towards the segment and past a body met head on alike.
TEST_F(LinearisationTest, KeepsTheGrownDistanceOnEachSegment) {
  Random random(7);
  int sideways = 0;
  int count = 0;
  for (int trial = 0; trial < 200; ++trial) {
    FlightProblem flight(kLine, 3.0, {Vector3(0, 0, 10), Vector3(3, 0, 0), Vector3::Zero()});
    const DistanceGrowth growth{random.uniform(0.0, 0.2), random.uniform(0.0, 2.0)};
    const Vector3 center(random.uniform(6.0, 16.0), random.uniform(-2.0, 2.0), random.uniform(8.0, 12.0));
    flight.addObstacle(Superellipsoid(1, center, random.vector(0.5, 2.0), random.vector(2.0, 8.0), 0.3,
                                      Vector3(random.uniform(-1.0, 0.0), 0.0, 0.0)),
                       growth);
    const MovingBody& body = flight.problem.bodies[0];
    linearise(flight.problem, flight.coasting(), kBand, *qp_, planes_);
    for (const SegmentPlane& plane : planes_) {
      double support = 0.0;
      for (int i = 0; i < 200; ++i) {
        const Vector3 u = random.direction();
        support = std::max(support, plane.half_space.n.dot(u) / body.obstacle()->gauge(u).value);
      }
      const double kept = body.distance() + std::min((plane.segment + 1) * growth.per_stage, growth.limit);
      ASSERT_GE(plane.half_space.offset, support + kept - 1e-9) << plane.segment;
      sideways += std::abs(plane.half_space.n.x()) < 0.1 ? 1 : 0;
      ++count;
    }
  }
  EXPECT_GT(count, 500);
  EXPECT_GT(sideways, 100);
}

TEST_F(LinearisationTest, HoldsTheSpeedByTheTangentPlaneAtTheIterate) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(4, 0, 0), Vector3(1, 0, 0)};
  FlightProblem flight(kLine, 3.0, start);
  const Qp& qp = linearised(flight.problem, flight.coasting());
  EXPECT_EQ(rowsOf(qp, Output::kVelocity), kHorizon);
  EXPECT_EQ(rowsOf(qp, Output::kVelocityControlPoint), kHorizon);
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    for (int i = 0; i < qp.stages[k].row_count; ++i) {
      const QpRow& row = qp.stages[k].rows[static_cast<std::size_t>(i)];
      if (row.output != Output::kVelocity) continue;
      EXPECT_NEAR((row.n + Vector3::UnitX()).norm(), 0.0, 1e-12) << "the tangent plane faces the iterate";
      EXPECT_NEAR(row.d, -flight.problem.bounds.max_speed, 1e-12);
    }
  }
}

TEST_F(LinearisationTest, HasNoRowsFarFromEverything) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(1, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 3.0, start);
  flight.addObstacle(
      Superellipsoid(1, Vector3(0, 30, 10), Vector3::Constant(2.0), Vector3::Constant(2.0), 0.0, Vector3::Zero()));
  flight.addUav(straightPlan(Vector3(0, -30, 10), Vector3::Zero(), 0.0, flight.problem.dt));
  const Workspace workspace{Vector3(-20, -20, 0), Vector3(50, 20, 40)};
  flight.setWorkspace(&workspace);
  EXPECT_EQ(linearised(flight.problem, flight.coasting()).rowCount(), 0);
}

TEST_F(LinearisationTest, HasRowsWithinTheBandOnly) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(1, 0, 0), Vector3::Zero()};
  const auto rowsBeside = [&](double gap) {
    FlightProblem flight(kLine, 3.0, start);
    flight.parameters.cost.epsilon_s = 0.0;
    const double y = 2.0 + flight.parameters.limits.uav_radius + flight.parameters.limits.tracking_margin + gap;
    flight.addObstacle(
        Superellipsoid(1, Vector3(0, y, 10), Vector3::Constant(2.0), Vector3::Constant(2.0), 0.0, Vector3(1, 0, 0)));
    return bodyRows(linearised(flight.problem, flight.coasting()));
  };
  // All control points but those three of the first segment that the start fixes, and two of the stop; where two
  // segments have the same plane one row holds for the knot between them.
  EXPECT_EQ(rowsBeside(kBand - 0.01), 3 * kHorizon - 2);
  EXPECT_EQ(rowsBeside(kBand + 0.01), 0);
}

TEST_F(LinearisationTest, HasWorkspaceRowsWithinTheBandOnly) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(1, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 3.0, start);
  const double margin = flight.parameters.limits.tracking_margin;
  const Workspace near{Vector3(-50, -margin - kBand + 0.01, -50), Vector3(50, 50, 50)};
  flight.setWorkspace(&near);
  EXPECT_EQ(bodyRows(linearised(flight.problem, flight.coasting())), 3 * kHorizon - 2);
  const Workspace far{Vector3(-50, -margin - kBand - 0.01, -50), Vector3(50, 50, 50)};
  flight.setWorkspace(&far);
  EXPECT_EQ(bodyRows(linearised(flight.problem, flight.coasting())), 0);
}

TEST_F(LinearisationTest, HasRowsAtTheKnotsAloneWithoutSegmentConstraints) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(4, 0, 0), Vector3(1, 0, 0)};
  FlightProblem flight(kLine, 3.0, start);
  flight.parameters.limits.segment_constraints = false;
  const Workspace workspace{Vector3(-50, -1, -50), Vector3(50, 50, 50)};
  flight.setWorkspace(&workspace);
  flight.addUav(straightPlan(Vector3(0, 3, 10), Vector3(4, 0, 0), 0.0, flight.problem.dt));
  const Qp& qp = linearised(flight.problem, flight.coasting());
  EXPECT_EQ(rowsOf(qp, Output::kVelocity), kHorizon);
  EXPECT_EQ(rowsOf(qp, Output::kVelocityControlPoint), 0);
  EXPECT_EQ(rowsOf(qp, Output::kControlPoint1) + rowsOf(qp, Output::kControlPoint2), 0);
  // Of each knot the workspace's face and, while the other one is near, the pair's plane.
  EXPECT_GT(rowsOf(qp, Output::kPosition), kHorizon);
  EXPECT_LE(rowsOf(qp, Output::kPosition), 2 * kHorizon);
}

// The half-space is the one towards the knot, not the one towards the middle of the way to it.
TEST_F(LinearisationTest, TurnsThePlanesToTheKnotsWithoutSegmentConstraints) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(4, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 3.0, start);
  flight.parameters.limits.segment_constraints = false;
  flight.useParameters();
  const Vector3 other(2.0, 2.5, 10);
  flight.addUav(straightPlan(other, Vector3::Zero(), 0.0, flight.problem.dt));
  const Trajectory iterate = flight.coasting();
  const Qp& qp = linearised(flight.problem, iterate);
  for (std::size_t k = 1; k <= 3; ++k) {
    const QpStage& stage = qp.stages[k];
    const auto row = std::find_if(stage.rows.begin(), stage.rows.begin() + stage.row_count,
                                  [](const QpRow& r) { return r.output == Output::kPosition; });
    ASSERT_NE(row, stage.rows.begin() + stage.row_count);
    EXPECT_LT((row->n - (iterate.knots[k].p - other).normalized()).norm(), 1e-9) << "knot " << k;
  }
}

// Rows on what no jerk can change would only add a constant penalty and take room from others.
TEST_F(LinearisationTest, HasNoRowForWhatTheStartFixes) {
  Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const KinematicState start = besidePath(random);
    FlightProblem flight(kLine, 3.0, start);
    crowd(random, flight);
    const Qp& qp = linearised(flight.problem, flight.coasting());
    EXPECT_EQ(qp.stages[0].row_count, 0);
    for (int i = 0; i < qp.stages[1].row_count; ++i) {
      const QpRow& row = qp.stages[1].rows[static_cast<std::size_t>(i)];
      const KinematicState effect = propagate(KinematicState(), Vector3::Ones(), qp.model.dt);
      EXPECT_GT(outputValue(qp.outputs[static_cast<std::size_t>(row.output)], effect).norm(), 0.0);
    }
  }
}

TEST_F(LinearisationTest, HasRoomForTheNearestBodiesOfACrowd) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(1, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 3.0, start);
  for (int i = 0; i < 2 * kMaxStageRows; ++i) {
    flight.addUav(straightPlan(Vector3(0.01 * i, 4.0, 10), Vector3(1, 0, 0), 0.0, flight.problem.dt));
  }
  const Qp& qp = linearised(flight.problem, flight.coasting());
  for (std::size_t k = 1; k <= kHorizon; ++k) EXPECT_LE(qp.stages[k].row_count, kMaxStageRows);
  EXPECT_EQ(qp.stages[5].row_count, 3 * static_cast<int>(kMostSegmentPlanes));
  EXPECT_EQ(linearised(flight.problem, flight.coasting()).rowCount(), qp.rowCount()) << "rows of the last time remain";
}

TEST_F(LinearisationTest, GoesRoundABoxMetHeadOn) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(4, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 4.0, start);
  flight.addObstacle(
      Superellipsoid(1, Vector3(14, 0, 10), Vector3(1, 3, 9), Vector3::Constant(10.0), 0.0, Vector3::Zero()));
  EXPECT_GT(sidewaysRows(linearised(flight.problem, flight.coasting())), 0) << "no row asks for a way round";
}

// The UAV itself has room on either side, half a stage's way of the box from where the box is at the stage's beginning.
TEST_F(LinearisationTest, GoesOutOfTheWayOfABoxBesideTheWorkspacesEdge) {
  const KinematicState start{Vector3(0, 0, 10), Vector3::Zero(), Vector3::Zero()};
  FlightProblem flight(kLine, 0.0, start);
  const double edge = 0.3 + flight.parameters.limits.tracking_margin;
  const Workspace workspace{Vector3(-50, -50, 0), Vector3(edge, 50, 50)};
  flight.setWorkspace(&workspace);
  flight.addObstacle(
      Superellipsoid(1, Vector3(15, 0, 10), Vector3(1, 3, 9), Vector3::Constant(10.0), 0.0, Vector3(-6, 0, 0)));
  EXPECT_GT(sidewaysRows(linearised(flight.problem, flight.coasting())), 0);
}

TEST_F(LinearisationTest, CutsOffAnAnswerBeyondTheNormLimits) {
  const KinematicState start{Vector3(0, 0, 10), Vector3(3, 0, 0), Vector3::Zero()};
  FlightProblem flight(kLine, 3.0, start);
  const Trajectory iterate = flight.coasting();
  linearise(flight.problem, iterate, kBand, *qp_, planes_);
  const int before = qp_->rowCount();
  addNormCuts(flight.problem, iterate, 0, *qp_);
  EXPECT_EQ(qp_->rowCount(), before) << "nothing to cut off an answer within the limits";
  Jerks jerks = noJerks();
  jerks[0] = Vector3(0, 10, 0);
  const Trajectory swinging = makePlan(start, jerks, 0.0, iterate.dt);
  ASSERT_GT(swinging.knots.back().v.norm(), flight.problem.bounds.max_speed);
  const double seen = worstRow(*qp_, swinging);
  addNormCuts(flight.problem, swinging, 0, *qp_);
  EXPECT_GT(qp_->rowCount(), before);
  EXPECT_GT(worstRow(*qp_, swinging), seen);
  EXPECT_LE(worstRow(*qp_, iterate), 1e-12) << "a cut must leave what is within the limits";
}

}  // namespace
}  // namespace swarm_planner
