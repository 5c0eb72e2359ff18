// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What is left out here no plan keeps clear of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
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
  /// Surroundings of `uavs` UAVs in the cycle of the epoch, UAV 0 on its way.
  Surroundings makeSurroundings(std::size_t uavs) const {
    Surroundings surroundings(flight_.parameters, uavs, 4);
    surroundings.setEpoch(kEpoch);
    surroundings.setPlanning(0, flight_.problem.start);
    return surroundings;
  }
  const CommittedMotion& resting(const Vector3& p) {
    motions_.emplace_back().assignRest(kEpoch, p);
    return motions_.back();
  }
  /// Flies straight on for a horizon, then stops.
  const CommittedMotion& flying(const Vector3& p, const Vector3& v, double epoch = kEpoch) {
    const Trajectory plan = straightPlan(p, v, epoch, flight_.problem.dt);
    StopManoeuvre stop;
    planStop(plan.knots.back(), plan.dt, flight_.problem.bounds, stop);
    motions_.emplace_back().assign(plan, stop);
    return motions_.back();
  }

  FlightProblem flight_;
  std::deque<CommittedMotion> motions_;
};

TEST_F(SurroundingsTest, PredictTracksToTheEpochAndOverTheHorizon) {
  Surroundings surroundings = makeSurroundings(1);
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
  Surroundings surroundings = makeSurroundings(1);
  surroundings.setObstacles({track(Vector3(10, 0, 0), Vector3(1, -2, 0.5), kEpoch - 0.6)}, kEpoch - 0.3);
  ASSERT_EQ(collected(surroundings).size(), 1U);
  EXPECT_LT((flight_.problem.bodies[0].point(0, 0) - Vector3(10.3, -0.6, 0.15)).norm(), 1e-12);
}

TEST_F(SurroundingsTest, KeepTheDistancesOfTheParameters) {
  LimitParameters& limits = flight_.parameters.limits;
  limits.tracking_margin = 0.3;
  limits.pair_margin = 0.7;
  Surroundings surroundings = makeSurroundings(2);
  surroundings.setMotions(1, resting(Vector3(0, 8, 0)), nullptr);
  surroundings.setObstacles({track(Vector3(10, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 2U);
  for (const MovingBody& body : flight_.problem.bodies) {
    const Vector3 r = body.isUav() ? Vector3(0, -5, 0) : Vector3(-5, 0, 0);
    const double level = std::exp(0.5 * flight_.parameters.cost.epsilon_s);  // radius of S = e^eps_s
    const double kept =
        body.isUav() ? limits.pair_distance + limits.pair_margin : level + limits.uav_radius + limits.tracking_margin;
    EXPECT_NEAR(body.supportingHalfSpace(r).clearance(r), 5.0 - kept, 1e-12);
    EXPECT_EQ(body.relief(0), 0.0);
  }
}

TEST_F(SurroundingsTest, KeepTheInflationOfATrackAtTheEndOfEachSegment) {
  const LimitParameters& limits = flight_.parameters.limits;
  Surroundings surroundings = makeSurroundings(1);
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
  const double reach = flight_.parameters.limits.max_speed * (kHorizon + 1) * flight_.problem.dt;
  Surroundings surroundings = makeSurroundings(1);
  TrackedObstacle doubtful = track(Vector3(reach + 3.0, 0, 0), Vector3::Zero(), kEpoch);
  surroundings.setObstacles({doubtful}, kEpoch);
  EXPECT_EQ(collected(surroundings).size(), 0U);
  doubtful.velocity_sigma = 1.0;
  surroundings.setObstacles({doubtful}, kEpoch);
  EXPECT_EQ(collected(surroundings).size(), 1U);
}

TEST_F(SurroundingsTest, WaiveTheMarginWhereTheStartIsTooClose) {
  Surroundings surroundings = makeSurroundings(2);
  surroundings.setMotions(1, resting(Vector3(0, 2.1, 0)), nullptr);
  surroundings.setObstacles({track(Vector3(1.4, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
  ASSERT_EQ(collected(surroundings).size(), 2U);
  for (const MovingBody& body : flight_.problem.bodies) {
    EXPECT_GT(body.relief(0), 0.05);
    EXPECT_LE(body.relief(0), flight_.parameters.limits.tracking_margin);
    EXPECT_EQ(body.relief(kHorizon - 1), 0.0);
  }
}

TEST_F(SurroundingsTest, HoldOnlyWhatCanBeReached) {
  const double reach = flight_.parameters.limits.max_speed * (kHorizon + 1) * flight_.problem.dt;
  const auto bodiesWith = [&](double distance) {
    Surroundings surroundings = makeSurroundings(2);
    surroundings.setMotions(1, resting(Vector3(0, distance + 2.0, 0)), nullptr);
    surroundings.setObstacles({track(Vector3(distance + 1.0, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
    return collected(surroundings).size();
  };
  EXPECT_EQ(bodiesWith(reach - 0.1), 2U);
  EXPECT_EQ(bodiesWith(reach + 3.0), 0U);
}

TEST_F(SurroundingsTest, HoldWhatComesWithinReach) {
  Surroundings surroundings = makeSurroundings(2);
  // Both are far away now and here within the horizon.
  surroundings.setMotions(1, flying(Vector3(0, 50, 0), Vector3(0, -8, 0)), nullptr);
  surroundings.setObstacles({track(Vector3(50, 0, 0), Vector3(-8, 0, 0), kEpoch)}, kEpoch);
  EXPECT_EQ(collected(surroundings).size(), 2U);
}

TEST_F(SurroundingsTest, ReachFartherFromAFastStart) {
  flight_.problem.start.v = Vector3(0, 12, 0);  // blown away: faster than max_speed
  Surroundings surroundings = makeSurroundings(2);
  surroundings.setMotions(1, resting(Vector3(0, 60, 0)), nullptr);
  EXPECT_EQ(collected(surroundings).size(), 1U);
}

TEST_F(SurroundingsTest, HoldEveryOtherUavButNotOneself) {
  Surroundings surroundings = makeSurroundings(4);
  for (std::size_t uav = 0; uav < 4; ++uav) {
    surroundings.setMotions(uav, resting(Vector3(0, 3.0 * static_cast<double>(uav), 0)), nullptr);
    surroundings.setPlanning(uav, {Vector3(0, 3.0 * static_cast<double>(uav), 0), Vector3::Zero(), Vector3::Zero()});
  }
  surroundings.setUnknown(2);
  ASSERT_EQ(collected(surroundings).size(), 2U) << "all but oneself and the one that nothing is known of";
  EXPECT_LT((flight_.problem.bodies[0].point(0, 0) - Vector3(0, 3, 0)).norm(), 1e-12);
  EXPECT_LT((flight_.problem.bodies[1].point(0, 0) - Vector3(0, 9, 0)).norm(), 1e-12);
}

TEST_F(SurroundingsTest, TakeOverANewMotionWithinTheCycle) {
  Surroundings surroundings = makeSurroundings(2);
  surroundings.setMotions(1, resting(Vector3(0, 5, 0)), nullptr);
  surroundings.setPlanning(1, {Vector3(0, 5, 0), Vector3::Zero(), Vector3::Zero()});
  ASSERT_EQ(collected(surroundings).size(), 1U);
  surroundings.replaceMotions(1, flying(Vector3(0, 5, 0), Vector3(1, 0, 0)), nullptr);
  surroundings.collect(0, flight_.problem);
  ASSERT_EQ(flight_.problem.bodies.size(), 1U);
  const double end = kHorizon * flight_.problem.dt;
  EXPECT_LT((flight_.problem.bodies[0].point(kHorizon - 1, 3) - Vector3(end, 5, 0)).norm(), 1e-9);
}

// A vehicle that gets no new setpoints flies its last plan, stops and rests: the others must not think it on its way.
TEST_F(SurroundingsTest, HoldTheStopAndTheRestOfAnOldMotion) {
  Surroundings surroundings = makeSurroundings(2);
  const double dt = flight_.problem.dt;
  const CommittedMotion& old = flying(Vector3(0, 5, 0), Vector3(1, 0, 0), kEpoch - 10.0 * dt);
  surroundings.setMotions(1, old, nullptr);
  ASSERT_EQ(collected(surroundings).size(), 1U);
  const MovingBody& body = flight_.problem.bodies[0];
  EXPECT_LT((body.point(5, 0) - Vector3(15.0 * dt, 5, 0)).norm(), 1e-9);
  ASSERT_LT(old.duration(), 30.0 * dt) << "it is still on its way at the horizon's end";
  EXPECT_LT((body.point(kHorizon - 1, 3) - old.restingPlace()).norm(), 1e-9);
}

TEST_F(SurroundingsTest, GiveTheCheckBothMotionsThatAUavMayFly) {
  Surroundings surroundings = makeSurroundings(3);
  const CommittedMotion& newest = flying(Vector3(0, 5, 0), Vector3(1, 0, 0));
  const CommittedMotion& older = flying(Vector3(0, 6, 0), Vector3(0, 0, 1), kEpoch - 1.0);
  surroundings.setMotions(1, newest, &older);
  surroundings.setMotions(2, resting(Vector3(0, -5, 0)), nullptr);
  surroundings.findNeighbours();
  CheckSurroundings check;
  surroundings.collect(0, check);
  ASSERT_EQ(check.uavs.size(), 3U);
  EXPECT_EQ(check.uavs[0].motion, &newest);
  EXPECT_EQ(check.uavs[0].valid_until, std::numeric_limits<double>::infinity());
  EXPECT_EQ(check.uavs[1].motion, &older);
  EXPECT_NEAR(check.uavs[1].valid_until, kEpoch + flight_.parameters.time.cycle_period, 1e-9);
  EXPECT_EQ(check.uavs[2].motion, &motions_.back());
  flight_.parameters.input.lost_setpoints = 0;
  surroundings.collect(0, check);
  EXPECT_EQ(check.uavs.size(), 2U) << "setpoints that are never lost leave no doubt";
  flight_.parameters.limits.avoidance = false;
  surroundings.collect(0, check);
  EXPECT_TRUE(check.uavs.empty());
}

// Only where the older one of its motions takes it do the two meet.
TEST_F(SurroundingsTest, FindNeighboursByTheOlderMotionToo) {
  const double far = 200.0;
  Surroundings surroundings = makeSurroundings(2);
  const CommittedMotion& older = resting(Vector3(0, 5, 0));
  surroundings.setMotions(1, resting(Vector3(0, far, 0)), &older);
  surroundings.findNeighbours();
  CheckSurroundings check;
  surroundings.collect(0, check);
  EXPECT_EQ(check.uavs.size(), 2U);
}

// A UAV that is not seen: farther off, at once and more later, and where it was seen last.
TEST_F(SurroundingsTest, KeepFartherFromAUavThatIsNotSeen) {
  const MotionDoubt doubt{kEpoch - 1.0, 0.4, 3.0};
  const auto surroundingsWith = [&](const CommittedMotion* aside, bool is_lost) {
    Surroundings surroundings = makeSurroundings(2);
    surroundings.setMotions(1, resting(Vector3(0, 5, 0)), nullptr);
    if (is_lost) surroundings.setDoubt(1, doubt, aside);
    surroundings.findNeighbours();
    return surroundings;
  };
  Surroundings seen = surroundingsWith(nullptr, false);
  ASSERT_EQ(collected(seen).size(), 1U);
  const double distance = flight_.problem.bodies[0].distance();
  CheckSurroundings check;
  seen.collect(0, check);
  EXPECT_TRUE(check.uavs[0].doubt.isNone());

  Surroundings lost = surroundingsWith(&resting(Vector3(0, 9, 0)), true);
  ASSERT_EQ(collected(lost).size(), 2U);
  const MovingBody& body = flight_.problem.bodies[0];
  EXPECT_NEAR(body.distance(), distance + 0.4, 1e-12);
  EXPECT_NEAR(body.growth(0), 0.4 * flight_.problem.dt, 1e-12);
  EXPECT_NEAR(body.growth(kHorizon - 1), std::min(0.4 * kHorizon * flight_.problem.dt, 2.6), 1e-12);
  EXPECT_EQ(flight_.problem.bodies[1].point(3, 0), Vector3(0, 9, 0));
  EXPECT_NE(flight_.problem.bodies[1].identity(), body.identity());
  lost.collect(0, check);
  ASSERT_EQ(check.uavs.size(), 2U);
  for (const OtherMotion& other : check.uavs) EXPECT_EQ(other.doubt.limit, 3.0);
  EXPECT_EQ(check.uavs[1].motion->restingPlace(), Vector3(0, 9, 0));
  EXPECT_EQ(surroundingsWith(nullptr, true).neighbours().size(), 2U);
}

// Only the doubt brings the two together.
TEST_F(SurroundingsTest, FindNeighboursByTheDoubtToo) {
  const double reach = flight_.parameters.limits.max_speed * (kHorizon + 1) * flight_.problem.dt;
  for (const double limit : {0.0, 5.0}) {
    Surroundings surroundings = makeSurroundings(2);
    surroundings.setMotions(1, resting(Vector3(0, reach + 5.0, 0)), nullptr);
    surroundings.setDoubt(1, {kEpoch, 1.0, limit}, nullptr);
    surroundings.findNeighbours();
    CheckSurroundings check;
    surroundings.collect(0, check);
    EXPECT_EQ(check.uavs.size(), limit > 0.0 ? 1U : 0U);
  }
}

TEST_F(SurroundingsTest, DemandOfTheCheckWhatATrackDoes) {
  LimitParameters& limits = flight_.parameters.limits;
  limits.tracking_margin = 0.5;
  limits.tracking_error = 0.1;
  for (const bool compensated : {true, false}) {
    limits.latency_compensation = compensated;
    Surroundings surroundings = makeSurroundings(1);
    TrackedObstacle doubtful = track(Vector3(10, 0, 0), Vector3(1, 0, 0), kEpoch - 0.6);
    doubtful.position_sigma = 0.2;
    surroundings.setObstacles({doubtful}, kEpoch - 0.3);
    surroundings.findNeighbours();
    CheckSurroundings check;
    surroundings.collect(0, check);
    ASSERT_EQ(check.obstacles.size(), 1U);
    const double inflation = inflationOf(doubtful, flight_.parameters.input).at_stamp;
    EXPECT_GT(inflation, 0.1);
    EXPECT_NEAR(check.obstacles[0].least_distance, limits.uav_radius + 0.1 + inflation, 1e-12);
    EXPECT_NEAR(check.obstacles[0].stamp, compensated ? kEpoch - 0.6 : kEpoch - 0.3, 1e-9);
  }
}

// UAVs that are planned at the same time have been told of an area. A motion that leaves it meets one that nobody
// holds it against.
TEST_F(SurroundingsTest, KnowWhetherAMotionStaysWhereOthersExpectIt) {
  Surroundings surroundings(flight_.parameters, 1, 4);
  surroundings.setEpoch(kEpoch);
  const double reach = flight_.parameters.limits.max_speed * (kHorizon + 1) * flight_.problem.dt;
  surroundings.setMotions(0, resting(Vector3(0, 0, reach + 4.0)), nullptr);
  surroundings.setPlanning(0, flight_.problem.start);
  surroundings.findNeighbours();
  EXPECT_TRUE(surroundings.isWithinArea(0, resting(Vector3(reach - 1e-6, 0, 0))));
  EXPECT_FALSE(surroundings.isWithinArea(0, resting(Vector3(reach + 1e-6, 0, 0))));
  EXPECT_FALSE(surroundings.isWithinArea(0, resting(Vector3(0, -reach - 1e-6, 0))));
  EXPECT_TRUE(surroundings.isWithinArea(0, resting(Vector3(0, 0, reach + 4.0)))) << "where its motion takes it";
  EXPECT_FALSE(surroundings.isWithinArea(0, flying(Vector3(reach - 1.0, 0, 0), Vector3(1, 0, 0))));
}

TEST_F(SurroundingsTest, PartUavsOnTopOfEachOther) {
  Surroundings surroundings = makeSurroundings(2);
  for (std::size_t uav = 0; uav < 2; ++uav) {
    surroundings.setMotions(uav, resting(Vector3::Zero()), nullptr);
    surroundings.setPlanning(uav, {});
  }
  ASSERT_EQ(collected(surroundings, 0).size(), 1U);
  const Vector3 first = flight_.problem.bodies[0].supportingHalfSpace(Vector3::Zero()).n;
  ASSERT_EQ(collected(surroundings, 1).size(), 1U);
  EXPECT_EQ(flight_.problem.bodies[0].supportingHalfSpace(Vector3::Zero()).n, -first);
}

TEST_F(SurroundingsTest, AreEmptyWithoutAvoidance) {
  flight_.parameters.limits.avoidance = false;
  Surroundings surroundings = makeSurroundings(2);
  surroundings.setMotions(1, resting(Vector3(0, 1, 0)), nullptr);
  surroundings.setObstacles({track(Vector3(1, 0, 0), Vector3::Zero(), kEpoch)}, kEpoch);
  EXPECT_TRUE(collected(surroundings).empty());
}

}  // namespace
}  // namespace swarm_planner
