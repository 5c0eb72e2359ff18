// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What is left out here no plan keeps clear of.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/flight_problem.hpp"
#include "swarm_planner/swarm/surroundings.hpp"

namespace swarm_planner {
namespace {

constexpr double kEpoch = 100.0;

TrackedObstacle track(const Vector3& center, const Vector3& velocity, double stamp, double radius = 1.0) {
  TrackedObstacle tracked;
  tracked.shape = Superellipsoid(7, center, Vector3::Constant(radius), Vector3::Constant(2.0), 0.0, velocity);
  tracked.stamp = stamp;
  return tracked;
}

/// UAV 0 plans from the origin.
class SurroundingsTest : public ::testing::Test {
 protected:
  SurroundingsTest() : flight_({Vector3::Zero(), Vector3(100, 0, 0)}, 3.0, {}) { flight_.problem.epoch = kEpoch; }

  /// The bodies that UAV 0 has to keep clear of.
  const std::vector<MovingBody>& collected(Surroundings& surroundings, std::size_t uav = 0) {
    surroundings.findNeighbours();
    surroundings.collect(uav, flight_.problem);
    return flight_.problem.bodies;
  }
  Trajectory resting(const Vector3& p) const { return straightPlan(p, Vector3::Zero(), kEpoch, flight_.problem.dt); }

  FlightProblem flight_;
};

TEST_F(SurroundingsTest, PredictTracksToTheEpochAndOverTheHorizon) {
  Surroundings surroundings(flight_.parameters, 1, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.setObstacles({track(Vector3(10, 0, 0), Vector3(1, -2, 0.5), kEpoch - 0.6)}, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 1U);
  const MovingBody& body = flight_.problem.bodies[0];
  ASSERT_FALSE(body.isUav());
  EXPECT_LT((body.point(0, 0) - Vector3(10.6, -1.2, 0.3)).norm(), 1e-12);
  const double end = 0.6 + kHorizon * flight_.problem.dt;
  EXPECT_LT((body.point(kHorizon - 1, 3) - Vector3(10, 0, 0) - end * Vector3(1, -2, 0.5)).norm(), 1e-9);
}

TEST_F(SurroundingsTest, TakeTracksForNewWithoutLatencyCompensation) {
  flight_.parameters.limits.latency_compensation = false;
  Surroundings surroundings(flight_.parameters, 1, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.setObstacles({track(Vector3(10, 0, 0), Vector3(1, -2, 0.5), kEpoch - 0.6)}, kEpoch - 0.3, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 1U);
  EXPECT_LT((flight_.problem.bodies[0].point(0, 0) - Vector3(10.3, -0.6, 0.15)).norm(), 1e-12);
}

TEST_F(SurroundingsTest, KeepTheDistancesOfTheParameters) {
  const LimitParameters& limits = flight_.parameters.limits;
  Surroundings surroundings(flight_.parameters, 2, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.setResting(1, Vector3(0, 8, 0));
  surroundings.setObstacles({track(Vector3(10, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 2U);
  for (const MovingBody& body : flight_.problem.bodies) {
    const Vector3 r = body.isUav() ? Vector3(0, -5, 0) : Vector3(-5, 0, 0);
    const double level = std::exp(0.5 * flight_.parameters.cost.epsilon_s);  // radius of S = e^eps_s
    const double kept = body.isUav() ? limits.pair_distance : level + limits.uav_radius;
    EXPECT_NEAR(body.supportingHalfSpace(r).clearance(r), 5.0 - kept - limits.tracking_margin, 1e-12);
    EXPECT_EQ(body.relief(0), 0.0);
  }
}

TEST_F(SurroundingsTest, KeepTheInflationOfATrackAtTheEndOfEachSegment) {
  const LimitParameters& limits = flight_.parameters.limits;
  Surroundings surroundings(flight_.parameters, 1, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  TrackedObstacle doubtful = track(Vector3(10, 0, 0), Vector3::Zero(), kEpoch - 0.4);
  doubtful.position_sigma = 0.2;
  doubtful.velocity_sigma = 0.1;
  surroundings.setObstacles({doubtful}, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 1U);
  const MovingBody& body = flight_.problem.bodies[0];
  const TrackInflation inflation = inflationOf(doubtful, flight_.parameters.input);
  const Vector3 r(-5, 0, 0);
  const double level = std::exp(0.5 * flight_.parameters.cost.epsilon_s);
  const double clearance = 5.0 - level - limits.uav_radius - limits.tracking_margin;
  EXPECT_NEAR(body.supportingHalfSpace(r).clearance(r), clearance - inflation.at(0.4), 1e-12);
  for (int k = 0; k < kHorizon; ++k) {
    const double end = 0.4 + (k + 1) * flight_.problem.dt;
    EXPECT_NEAR(segmentClearance(body, k, {r, r, r, r}).clearance, clearance - inflation.at(end), 1e-12) << k;
  }
  EXPECT_GT(inflation.at(1.0), inflation.at(0.4) + 0.1);
}

TEST_F(SurroundingsTest, HoldWhatOnlyItsInflationBringsWithinReach) {
  const double reach = flight_.parameters.limits.max_speed * kHorizon * flight_.problem.dt;
  Surroundings surroundings(flight_.parameters, 1, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  TrackedObstacle doubtful = track(Vector3(reach + 3.0, 0, 0), Vector3::Zero(), kEpoch);
  surroundings.setObstacles({doubtful}, kEpoch);
  EXPECT_EQ(collected(surroundings).size(), 0U);
  doubtful.velocity_sigma = 1.0;
  surroundings.setObstacles({doubtful}, kEpoch);
  EXPECT_EQ(collected(surroundings).size(), 1U);
}

TEST_F(SurroundingsTest, WaiveTheMarginWhereTheStartIsTooClose) {
  Surroundings surroundings(flight_.parameters, 2, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.setResting(1, Vector3(0, 2.1, 0));
  surroundings.setObstacles({track(Vector3(1.4, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 2U);
  for (const MovingBody& body : flight_.problem.bodies) {
    EXPECT_GT(body.relief(0), 0.05);
    EXPECT_LE(body.relief(0), flight_.parameters.limits.tracking_margin);
    EXPECT_EQ(body.relief(kHorizon - 1), 0.0);
  }
}

TEST_F(SurroundingsTest, HoldOnlyWhatCanBeReached) {
  const double reach = flight_.parameters.limits.max_speed * kHorizon * flight_.problem.dt;
  const auto bodiesWith = [&](double distance) {
    Surroundings surroundings(flight_.parameters, 2, 4);
    surroundings.setPlanning(0, flight_.problem.start);
    surroundings.setPlan(1, resting(Vector3(0, distance + 2.0, 0)), kEpoch);
    surroundings.setObstacles({track(Vector3(distance + 1.0, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
    return collected(surroundings).size();
  };
  EXPECT_EQ(bodiesWith(reach - 0.1), 2U);
  EXPECT_EQ(bodiesWith(reach + 3.0), 0U);
}

TEST_F(SurroundingsTest, HoldWhatComesWithinReach) {
  Surroundings surroundings(flight_.parameters, 2, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  // Both are far away now and here within the horizon.
  surroundings.setPlan(1, straightPlan(Vector3(0, 50, 0), Vector3(0, -8, 0), kEpoch, flight_.problem.dt), kEpoch);
  surroundings.setObstacles({track(Vector3(50, 0, 0), Vector3(-8, 0, 0), kEpoch)}, kEpoch);
  EXPECT_EQ(collected(surroundings).size(), 2U);
}

TEST_F(SurroundingsTest, ReachFartherFromAFastStart) {
  flight_.problem.start.v = Vector3(0, 12, 0);  // blown away: faster than max_speed
  Surroundings surroundings(flight_.parameters, 2, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.setResting(1, Vector3(0, 60, 0));
  EXPECT_EQ(collected(surroundings).size(), 1U);
}

TEST_F(SurroundingsTest, HoldEveryOtherUavButNotOneself) {
  Surroundings surroundings(flight_.parameters, 4, 4);
  for (std::size_t uav = 0; uav < 4; ++uav) {
    surroundings.setResting(uav, Vector3(0, 3.0 * static_cast<double>(uav), 0));
    surroundings.setPlanning(uav, {Vector3(0, 3.0 * static_cast<double>(uav), 0), Vector3::Zero(), Vector3::Zero()});
  }
  surroundings.setUnknown(2);
  ASSERT_EQ(collected(surroundings).size(), 2U) << "all but oneself and the one that nothing is known of";
  EXPECT_LT((flight_.problem.bodies[0].point(0, 0) - Vector3(0, 3, 0)).norm(), 1e-12);
  EXPECT_LT((flight_.problem.bodies[1].point(0, 0) - Vector3(0, 9, 0)).norm(), 1e-12);
}

TEST_F(SurroundingsTest, TakeOverANewPlanWithinTheCycle) {
  Surroundings surroundings(flight_.parameters, 2, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.setResting(1, Vector3(0, 5, 0));
  surroundings.setPlanning(1, {Vector3(0, 5, 0), Vector3::Zero(), Vector3::Zero()});
  ASSERT_EQ(collected(surroundings).size(), 1U);
  surroundings.setPlan(1, straightPlan(Vector3(0, 5, 0), Vector3(1, 0, 0), kEpoch, flight_.problem.dt), kEpoch);
  surroundings.collect(0, flight_.problem);
  ASSERT_EQ(flight_.problem.bodies.size(), 1U);
  const double end = kHorizon * flight_.problem.dt;
  EXPECT_LT((flight_.problem.bodies[0].point(kHorizon - 1, 3) - Vector3(end, 5, 0)).norm(), 1e-9);
}

TEST_F(SurroundingsTest, StopALastPlanAtItsEnd) {
  Surroundings surroundings(flight_.parameters, 2, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  const double dt = flight_.problem.dt;
  const Trajectory old = straightPlan(Vector3(0, 5, 0), Vector3(1, 0, 0), kEpoch - 10.0 * dt, dt);
  surroundings.setLastPlan(1, old, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 1U);
  const MovingBody& body = flight_.problem.bodies[0];
  EXPECT_LT((body.point(5, 0) - old.at(kEpoch + 5.0 * dt).p).norm(), 1e-9);
  EXPECT_LT((body.point(kHorizon - 1, 3) - old.knots.back().p).norm(), 1e-9);
}

TEST_F(SurroundingsTest, PartUavsOnTopOfEachOther) {
  Surroundings surroundings(flight_.parameters, 2, 4);
  for (std::size_t uav = 0; uav < 2; ++uav) {
    surroundings.setResting(uav, Vector3::Zero());
    surroundings.setPlanning(uav, {});
  }
  ASSERT_EQ(collected(surroundings, 0).size(), 1U);
  const Vector3 first = flight_.problem.bodies[0].supportingHalfSpace(Vector3::Zero()).n;
  ASSERT_EQ(collected(surroundings, 1).size(), 1U);
  EXPECT_EQ(flight_.problem.bodies[0].supportingHalfSpace(Vector3::Zero()).n, -first);
}

TEST_F(SurroundingsTest, AreEmptyWithoutAvoidance) {
  flight_.parameters.limits.avoidance = false;
  Surroundings surroundings(flight_.parameters, 2, 4);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.setResting(1, Vector3(0, 1, 0));
  surroundings.setObstacles({track(Vector3(1, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
  EXPECT_TRUE(collected(surroundings).empty());
}

}  // namespace
}  // namespace swarm_planner
