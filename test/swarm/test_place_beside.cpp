// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A UAV that gives way has to go where it can stay, and no farther than it must.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "check_scene.hpp"
#include "perfect_flight.hpp"
#include "swarm_planner/swarm/place_beside.hpp"

namespace swarm_planner {
namespace {

const Vector3 kPlace(0, 0, 10);
constexpr double kTime = 100.0;  // [s]

/// A ball of 2 m that comes along x and passes `aside` of the place, 10 s later.
class PlaceBeside : public ::testing::Test {
 protected:
  void come(const Vector3& aside, const Vector3& velocity) {
    body_ = Superellipsoid(1, kPlace + aside - 10.0 * velocity, Vector3::Constant(2.0), Vector3::Constant(2.0), 0.0,
                           velocity);
    PredictedObstacle obstacle;
    obstacle.body = &*body_;
    obstacle.stamp = kTime;
    obstacle.least_distance = 0.5;
    surroundings_.obstacles = {obstacle};
  }
  std::optional<Vector3> find() const { return placeBeside(kPlace, 0, kTime, limits_, surroundings_); }
  bool isClear(const Vector3& place) const {
    CommittedMotion rest;
    rest.assignRest(kTime, place);
    return checkClearance(rest, place, limits_, surroundings_).accepted();
  }

  CheckLimits limits_ = defaultCheckLimits();
  CheckSurroundings surroundings_;
  std::optional<Superellipsoid> body_;
};

TEST_F(PlaceBeside, IsClearAndNear) {
  for (const Vector3& aside : {Vector3(0, 1, 0), Vector3(0, -1, 0.2), Vector3(0, 0.1, 1), Vector3(0, 0, -1)}) {
    come(aside, Vector3(0.6, 0, 0));
    ASSERT_FALSE(isClear(kPlace));
    const std::optional<Vector3> place = find();
    ASSERT_TRUE(place);
    EXPECT_TRUE(isClear(*place));
    EXPECT_NEAR((*place - kPlace).norm(), 2.0 + 0.5 + 0.5 - 1.0, 0.02) << "to the side that is nearest";
    EXPECT_LT((*place - kPlace).dot(aside), 0.0);
  }
}

TEST_F(PlaceBeside, OfWhatFallsStraightDownOrGrowsWhereItStands) {
  come(Vector3(1, 0, 0), Vector3(0, 0, -0.6));
  ASSERT_TRUE(find());
  EXPECT_TRUE(isClear(*find()));
  come(Vector3(2.6, 0, 0), Vector3::Zero());
  surroundings_.obstacles[0].growth_rate = 0.1;
  ASSERT_FALSE(isClear(kPlace));
  ASSERT_TRUE(find());
  EXPECT_TRUE(isClear(*find()));
}

TEST_F(PlaceBeside, IsNotWhereAnotherUavIsOrNoUavMayBe) {
  come(Vector3(0, -1, 0), Vector3(0.6, 0, 0));
  CommittedMotion other;
  other.assignRest(kTime, kPlace + Vector3(0, 3, 0));
  surroundings_.uavs.push_back({&other, 1e9, {}});
  const std::optional<Vector3> place = find();
  ASSERT_TRUE(place);
  EXPECT_TRUE(isClear(*place));
  EXPECT_GT(std::abs(place->z() - kPlace.z()), 1.0) << "above or below";
  limits_.bounds.workspace = {kPlace - Vector3::Constant(0.5), kPlace + Vector3::Constant(0.5)};
  EXPECT_FALSE(find());
}

/// UAVs one above the other along x at 3 m/s, which pass x = 40 m about 14 s after the start. A ball of 10 m comes
/// along y and is there `after` seconds after the start.
Mission acrossAWay(double after) {
  const std::vector<Vector3> starts{{0, 0, 18}, {0, 0, 22}}, ends{{100, 0, 18}, {100, 0, 22}};
  Mission mission = makeTestMission(starts, ends, 3.0);
  ScenarioObstacle obstacle;
  obstacle.id = 1;
  obstacle.radii = Vector3::Constant(10.0);
  obstacle.velocity = Vector3(0, -3, 0);
  obstacle.center = Vector3(40, 0, 20) - after * obstacle.velocity;
  mission.scenario.obstacles.push_back(obstacle);
  return mission;
}

struct Crossing {
  double slowest = std::numeric_limits<double>::infinity();    ///< of the UAVs on the way to x = 55 m [m/s]
  double farthest_off = 0.0;                                   ///< of them from their references there [m]
  double clearance = std::numeric_limits<double>::infinity();  ///< least of all motions, 20 s of rest included [m]
  int refused = 0;
};

Crossing flyAcross(double after, PlanningMode mode) {
  PerfectFlight flight(acrossAWay(after), 0.0, mode);
  Crossing crossing;
  for (int n = 0; n < 60; ++n) {
    flight.cycle();
    for (std::size_t uav = 0; uav < 2; ++uav) {
      const CommittedMotion& motion = flight.planner().committed(uav);
      for (double t = 0.0; t <= motion.duration() + 20.0; t += 0.05) {
        const double distance = flight.obstacle(0, motion.epoch() + t).signedDistance(motion.after(t).p);
        crossing.clearance = std::min(crossing.clearance, distance);
      }
      const KinematicState x = flight.vehicle(uav);
      if (x.p.x() > 10.0 && x.p.x() < 55.0) {
        crossing.slowest = std::min(crossing.slowest, x.v.norm());
        crossing.farthest_off =
            std::max(crossing.farthest_off, std::hypot(x.p.y(), x.p.z() - (uav == 0 ? 18.0 : 22.0)));
      }
      crossing.refused += flight.planner().report().uavs[uav].refusal != CheckReason::kAccepted ? 1 : 0;
    }
  }
  return crossing;
}

// The ball comes within the 20 s for which a resting place is to stay clear: plans end in its way for several seconds.
TEST(StopBeside, LetsUavsCrossWhereThereIsTimeWithoutWaiting) {
  for (const PlanningMode mode : {PlanningMode::kIterative, PlanningMode::kJoint}) {
    const Crossing crossing = flyAcross(27.0, mode);
    EXPECT_GT(crossing.slowest, 2.9);
    EXPECT_LT(crossing.farthest_off, 0.1);
    EXPECT_EQ(crossing.refused, 0);
    EXPECT_GT(crossing.clearance, Parameters().limits.uav_radius) << "a motion ends where the ball comes";
  }
}

TEST(StopBeside, DoesNotTakeThemAcrossInFrontOfItWhereThereIsNone) {
  for (const PlanningMode mode : {PlanningMode::kIterative, PlanningMode::kJoint}) {
    const Crossing crossing = flyAcross(14.0, mode);
    EXPECT_GT(crossing.farthest_off, 3.0) << "the ball is not in the way";
    EXPECT_GT(crossing.clearance, Parameters().limits.uav_radius);
  }
}

}  // namespace
}  // namespace swarm_planner
