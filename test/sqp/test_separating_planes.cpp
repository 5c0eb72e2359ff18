// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// In a crowd only the nearest bodies get rows. A body that is left out although it matters is one that plans lead
// through until the check refuses them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "support/flight_problem.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/separating_planes.hpp"

namespace swarm_planner {
namespace {

const std::vector<Vector3> kLine{Vector3(0, 0, 10), Vector3(100, 0, 10)};

/// UAVs all about a start, on a lattice whose spacing is somewhat more than they keep; all drift like the start.
void addLattice(Random& random, FlightProblem& flight) {
  const LimitParameters& limits = flight.parameters.limits;
  const double spacing = random.uniform(1.05, 1.4) * (limits.pair_distance + limits.pair_margin);
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vector3 p = flight.problem.start.p + spacing * Vector3(x, y, z) + random.vector(-0.02, 0.02);
        flight.addUav(straightPlan(p, flight.problem.start.v, 0.0, flight.problem.dt));
      }
    }
  }
}

double clearanceOf(const UavProblem& problem, const Trajectory& plan, std::size_t body, int k) {
  PlanPoints points;
  findConstrainedPoints(problem, plan, points);
  return segmentClearance(problem.bodies[body], k, relativeConstrainedPoints(problem, points, k, problem.bodies[body]))
      .clearance;
}

class SeparatingPlanesTest : public ::testing::Test {
 protected:
  SeparatingPlanesTest() { planes_.reserve(kSegmentPlaneRoom); }

  SegmentPlanes planes_;
};

TEST_F(SeparatingPlanesTest, AreThoseOfTheNearestBodies) {
  Random random(1);
  int dropped = 0;
  for (int trial = 0; trial < 20; ++trial) {
    FlightProblem flight(kLine, 1.0, {Vector3(0, 0, 10), random.vector(-1.0, 1.0), Vector3::Zero()});
    addLattice(random, flight);
    const Trajectory plan = wanderingPlan(random, flight.problem.start, 0.5, 0.0, flight.problem.dt);
    const double band = random.uniform(1.0, 12.0);
    findSeparatingPlanes(flight.problem, plan, band, planes_);
    ASSERT_LE(planes_.size(), kSegmentPlaneRoom);
    for (std::size_t i = 1; i < planes_.size(); ++i) {
      const SegmentPlane& before = planes_[i - 1];
      EXPECT_TRUE(before.body < planes_[i].body ||
                  (before.body == planes_[i].body && before.segment < planes_[i].segment));
    }
    for (int k = 0; k < kHorizon; ++k) {
      std::vector<double> all;
      for (std::size_t body = 0; body < flight.problem.bodies.size(); ++body) {
        const double clearance = clearanceOf(flight.problem, plan, body, k);
        if (clearance <= band) all.push_back(clearance);
      }
      std::sort(all.begin(), all.end());
      dropped += static_cast<int>(all.size()) - static_cast<int>(std::min(all.size(), kMostSegmentPlanes));
      all.resize(std::min(all.size(), kMostSegmentPlanes));
      std::vector<double> kept;
      for (const SegmentPlane& plane : planes_) {
        if (plane.segment == k) kept.push_back(plane.clearance);
      }
      std::sort(kept.begin(), kept.end());
      ASSERT_EQ(kept, all) << "segment " << k;
    }
  }
  EXPECT_GT(dropped, 5000);
}

/// The planes of a flight with 2 m/s straight past a UAV at rest that comes as close to it as `share` of what they
/// keep, behind a target of `target_speed` [m/s].
SegmentPlanes planesPast(double share, double target_speed = 2.0) {
  FlightProblem flight(kLine, target_speed, {Vector3(0, 0, 10), Vector3(2.0, 0.0, 0.0), Vector3::Zero()});
  const LimitParameters& limits = flight.parameters.limits;
  const double distance = share * (limits.pair_distance + limits.pair_margin);
  flight.addUav(straightPlan(Vector3(6.0, distance, 10.0), Vector3::Zero(), 0.0, flight.problem.dt));
  const Trajectory plan = straightPlan(flight.problem.start.p, flight.problem.start.v, 0.0, flight.problem.dt);
  SegmentPlanes planes;
  planes.reserve(kSegmentPlaneRoom);
  findSeparatingPlanes(flight.problem, plan, 1.0, planes);
  return planes;
}

/// The largest angle between a violated plane's normal and that of the nearest way out, which is across the flight.
double largestTurn(const SegmentPlanes& planes, const Vector3& out) {
  double largest = 0.0;
  for (const SegmentPlane& plane : planes) {
    if (plane.clearance < 0.0) largest = std::max(largest, std::acos(std::min(1.0, plane.half_space.n.dot(out))));
  }
  return largest;
}

// The plane of another way past would be violated by metres: the solver got stuck on plans that lean on a body.
TEST_F(SeparatingPlanesTest, OfAPlanThatLeansOnABodyAreTheNearest) {
  constexpr double kSmall = 0.35;  // [rad]
  const SegmentPlanes leaning = planesPast(0.99);
  EXPECT_TRUE(std::any_of(leaning.begin(), leaning.end(), [](const SegmentPlane& p) { return p.clearance < 0.0; }));
  EXPECT_LT(largestTurn(leaning, -Vector3::UnitY()), kSmall);
  EXPECT_GT(largestTurn(planesPast(0.3), -Vector3::UnitY()), kSmall) << "one that leads through it needs another way";
}

// In a jam all plans lean on others, and stay as they are unless some go another way.
TEST_F(SeparatingPlanesTest, OfAPlanThatDoesNotGetOnAreThoseOfAnotherWay) {
  constexpr double kTooFast = 5.0;  // [m/s]
  EXPECT_LT(largestTurn(planesPast(0.99), -Vector3::UnitY()), 0.01);
  EXPECT_GT(largestTurn(planesPast(0.99, kTooFast), -Vector3::UnitY()), 0.1);
}

// An answer that keeps the planes left out, too, is the answer of the QP with all of them.
TEST_F(SeparatingPlanesTest, LeaveOutNothingThatTheAnswerMeets) {
  Random random(2);
  const auto qp = std::make_unique<Qp>();
  const auto solution = std::make_unique<QpSolution>();
  int held = 0;
  for (int trial = 0; trial < 20; ++trial) {
    FlightProblem flight(kLine, random.uniform(0.5, 3.0),
                         {Vector3(0, 0, 10), random.vector(-0.5, 0.5), Vector3::Zero()});
    addLattice(random, flight);
    const Trajectory iterate = flight.coasting();
    linearise(flight.problem, iterate, 12.0, *qp, planes_);
    GeneratedSolver solver(std::make_shared<GeneratedTables>(std::vector<QpModel>{qp->model}));
    solution->active.count = 0;
    ASSERT_EQ(solver.solve(*qp, *solution), QpStatus::kSolved);
    held += solution->active.count > 0 ? 1 : 0;
    const Trajectory answer = makePlan(flight.problem.start, solution->jerks, 0.0, flight.problem.dt);
    PlanPoints before;
    PlanPoints after;
    findConstrainedPoints(flight.problem, iterate, before);
    findConstrainedPoints(flight.problem, answer, after);
    for (const MovingBody& body : flight.problem.bodies) {
      for (int k = 1; k < kHorizon; ++k) {
        const HalfSpace plane =
            segmentClearance(body, k, relativeConstrainedPoints(flight.problem, before, k, body)).half_space;
        for (const Vector3& r : relativeConstrainedPoints(flight.problem, after, k, body)) {
          ASSERT_GE(plane.clearance(r), -1e-6) << "trial " << trial << " segment " << k;
        }
      }
    }
  }
  EXPECT_EQ(held, 20) << "nothing kept the UAV back";
}

}  // namespace
}  // namespace swarm_planner
