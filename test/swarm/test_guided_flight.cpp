// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A UAV on a guide. If these fail, one that is drawn through a wall by a target far round its corner stands there for
// good.
#include <gtest/gtest.h>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/swarm/guided_flight.hpp"

namespace swarm_planner {
namespace {

/// At (0, 0, 0) beside a wall, whose opening a guide leads through; its target is already at the reference's end.
class GuidedFlightTest : public ::testing::Test {
 protected:
  GuidedFlightTest() {
    target_.path = ReferencePath({Vector3::Zero(), Vector3(20, 0, 0)});
    target_.start = 20.0;
    guided_.setFollowed(target_);
    answer_.state = GuideState::kGuided;
    answer_.version = guided_.version();
    answer_.path.points[0] = Vector3::Zero();
    answer_.path.points[1] = Vector3(0, 6, 0);
    answer_.path.points[2] = Vector3(4, 6, 0);
    answer_.path.points[3] = Vector3(4, 0, 0);
    answer_.path.count = 4;
    answer_.rejoin = 4.0;
    answer_.rejoins = true;
    guided_.take(answer_, target_);
    problem_.parameters = &parameters_;
    problem_.bounds = FlightBounds(parameters_, nullptr);
    problem_.dt = parameters_.time.sampling_time;
  }

  /// Where the target is at the end of the horizon, after a cycle whose plan ends at `end`.
  Vector3 lastTarget() {
    double progress = 0.0;
    guided_.pose(target_, progress, problem_);
    return problem_.targets[kHorizon].p;
  }
  void plansReachTheirTargets(int cycles) {
    for (int i = 0; i < cycles; ++i) guided_.notePlan(lastTarget(), problem_);
  }
  void plansEndAt(const Vector3& end, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      lastTarget();
      guided_.notePlan(end, problem_);
    }
  }

  Parameters parameters_;
  MovingTarget target_;
  GuidedFlight guided_;
  GuideAnswer answer_;
  UavProblem problem_;
};

TEST_F(GuidedFlightTest, TargetsLeadAllTheWayWhilePlansGetOn) {
  plansReachTheirTargets(20);
  EXPECT_GT(lastTarget().x(), 4.0);
}

TEST_F(GuidedFlightTest, TargetsComeNearerWhilePlansDoNotGetOn) {
  plansEndAt(Vector3::Zero(), 20);
  EXPECT_NEAR((lastTarget() - Vector3(0, parameters_.limits.pair_distance, 0)).norm(), 0.0, 1e-9)
      << "it is drawn round the corner";
  plansReachTheirTargets(20);
  EXPECT_GT(lastTarget().x(), 4.0) << "it gets on, and its targets stay back";
}

TEST_F(GuidedFlightTest, AnotherWayRoundIsTriedAsAWhole) {
  plansEndAt(Vector3::Zero(), 20);
  answer_.number = answer_.course = 1;
  guided_.take(answer_, target_);
  EXPECT_TRUE(guided_.needsFreshStart());
  EXPECT_GT(lastTarget().x(), 4.0);
}

}  // namespace
}  // namespace swarm_planner
