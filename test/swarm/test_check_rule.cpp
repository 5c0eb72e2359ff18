// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What the check demands, of whom and for how long, and the induction that the safety case rests on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "check_scene.hpp"

namespace swarm_planner {
namespace {

TEST(PlanCheck, GrowsTheDistanceWithTheAgeOfThePrediction) {
  const auto verdict = [](double age, double growth) {
    CheckScene scene;
    scene.plan(straightPlan(Vector3(-6.0, 0.0, 0.0), Vector3(3.0, 0.0, 0.0), 100.0, 0.3));
    scene.addObstacle(
        Superellipsoid(1, Vector3(0.0, 2.0, 0.0), Vector3::Ones(), Vector3::Constant(2.0), 0.0, Vector3::Zero()));
    scene.surroundings.obstacles[0].stamp = 100.0 - age;
    scene.surroundings.obstacles[0].growth_rate = growth;
    return scene.check();
  };
  // Passed at 2 s with half a metre more than the 0.5 m demanded; closest a little later, at 0.5 = 2 g + g^2 / 9.
  EXPECT_TRUE(verdict(0.0, 0.246).accepted());
  EXPECT_FALSE(verdict(0.0, 0.248).accepted());
  EXPECT_TRUE(verdict(3.0, 0.099).accepted());
  EXPECT_FALSE(verdict(3.0, 0.101).accepted());
}

TEST(PlanCheck, EndsTheGrowthWithItsTime) {
  const auto verdict = [](double age, double growth, double growth_time) {
    CheckScene scene;
    scene.plan(straightPlan(Vector3(-6.0, 0.0, 0.0), Vector3(3.0, 0.0, 0.0), 100.0, 0.3));
    scene.addObstacle(
        Superellipsoid(1, Vector3(0.0, 2.0, 0.0), Vector3::Ones(), Vector3::Constant(2.0), 0.0, Vector3::Zero()));
    scene.surroundings.obstacles[0].stamp = 100.0 - age;
    scene.surroundings.obstacles[0].growth_rate = growth;
    scene.surroundings.obstacles[0].growth_time = growth_time;
    return scene.check();
  };
  // Passed at 2 s with half a metre more than the 0.5 m demanded.
  EXPECT_TRUE(verdict(0.0, 0.499, 1.0).accepted());
  EXPECT_FALSE(verdict(0.0, 0.501, 1.0).accepted());
  EXPECT_TRUE(verdict(0.5, 0.499, 1.0).accepted());
  EXPECT_FALSE(verdict(0.5, 0.501, 1.0).accepted());
  EXPECT_TRUE(verdict(10.0, 0.499, 1.0).accepted()) << "it ended before the epoch";
  EXPECT_FALSE(verdict(10.0, 0.501, 1.0).accepted());
  EXPECT_TRUE(verdict(0.0, 100.0, 0.0).accepted());
  EXPECT_FALSE(verdict(-3.0, 0.501, 1.0).accepted()) << "a stamp from the future must not demand less";
  EXPECT_EQ(verdict(0.0, 0.0, std::nan("")).reason, CheckReason::kNotFinite);
  EXPECT_EQ(verdict(0.0, 0.0, -1.0).reason, CheckReason::kNotFinite);
}

TEST(PlanCheck, KeepsTheDoubtOfATrackBeyondTheDistance) {
  const auto verdict = [](double position_sigma, double velocity_sigma) {
    CheckScene scene;
    scene.plan(straightPlan(Vector3(-6.0, 0.0, 0.0), Vector3(3.0, 0.0, 0.0), 100.0, 0.3));
    TrackedObstacle track;
    track.shape =
        Superellipsoid(1, Vector3(0.0, 2.0, 0.0), Vector3::Ones(), Vector3::Constant(2.0), 0.0, Vector3::Zero());
    track.stamp = 99.5;
    track.position_sigma = position_sigma;
    track.velocity_sigma = velocity_sigma;
    InputParameters input;
    input.track_sigmas = 2.0;
    input.track_growth_time = 1.5;
    scene.surroundings.obstacles.push_back(predictObstacle(track.shape, track.stamp, inflationOf(track, input), 0.5));
    return scene.check().accepted();
  };
  // Passed at 2 s, 2.5 s after the stamp, with half a metre more than the 0.5 m without doubt.
  EXPECT_TRUE(verdict(0.249, 0.0));
  EXPECT_FALSE(verdict(0.251, 0.0));
  EXPECT_TRUE(verdict(0.0, 0.249 / 1.5));
  EXPECT_FALSE(verdict(0.0, 0.251 / 1.5));
  EXPECT_TRUE(verdict(0.1, 0.149 / 1.5));
  EXPECT_FALSE(verdict(0.1, 0.151 / 1.5));
}

/// Verdict on a straight flight beside a sphere, that starts `clearance` from its surface. `committed`: clearance of
/// the motion committed before.
CheckVerdict besideASphere(double clearance, const Vector3& velocity, double least = 0.3, double committed = 1e3) {
  CheckScene scene;
  scene.committed = Vector3(0.0, 1.0 + committed, 0.0);
  scene.plan(straightPlan(Vector3(0.0, 1.0 + clearance, 0.0), velocity, 0.0, 0.3));
  scene.addObstacle(Superellipsoid(1, Vector3::Zero(), Vector3::Ones(), Vector3::Constant(2.0), 0.0, Vector3::Zero()));
  scene.surroundings.obstacles[0].least_distance = least;
  return scene.check();
}

TEST(LeastDistance, IsDemandedAllAlongAndNoMore) {
  const Vector3 zero = Vector3::Zero();
  EXPECT_TRUE(besideASphere(0.3, zero).accepted());
  EXPECT_TRUE(besideASphere(0.3, Vector3(1.0, 0.0, 0.0)).accepted());
  EXPECT_TRUE(besideASphere(0.3, Vector3(1.0, 0.5, 0.0)).accepted());
  EXPECT_FALSE(besideASphere(0.3, Vector3(0.0, -0.005, 0.0)).accepted());
  EXPECT_TRUE(besideASphere(0.4, Vector3(0.0, -0.005, 0.0)).accepted()) << "comes closer, but not too close";
  EXPECT_TRUE(besideASphere(0.3 - 0.9e-6, zero).accepted());
  EXPECT_FALSE(besideASphere(0.3 - 2e-6, zero).accepted());
  EXPECT_FALSE(besideASphere(0.3 - 2e-6, Vector3(0.0, 3.0, 0.0)).accepted());
  EXPECT_FALSE(besideASphere(-0.5, Vector3(0.0, 3.0, 0.0), 0.0).accepted());  // inside
}

// An obstacle that appears beside a UAV must not ground it, and no plan may take it closer than it would come anyway.
TEST(LeastDistance, LetsAUavLeaveWhereItsMotionIsTooCloseAlready) {
  const Vector3 zero = Vector3::Zero();
  const Vector3 away(0.0, 2.0, 0.0);
  EXPECT_TRUE(besideASphere(0.2, away, 0.3, 0.2).accepted());
  EXPECT_TRUE(besideASphere(0.2, Vector3(1.0, 0.0, 0.0), 0.3, 0.2).accepted());
  EXPECT_TRUE(besideASphere(0.2, zero, 0.3, 0.2).accepted()) << "to stay is no worse";
  EXPECT_TRUE(besideASphere(0.2, away, 0.3, 0.1).accepted());
  EXPECT_FALSE(besideASphere(0.2, away, 0.3, 0.201).accepted()) << "its motion was farther off than this start";
  EXPECT_FALSE(besideASphere(0.2, Vector3(0.0, -0.005, 0.0), 0.3, 0.2).accepted()) << "closer still";
  EXPECT_TRUE(besideASphere(0.2, Vector3(0.0, -0.005, 0.0), 0.3, 0.1).accepted()) << "not as close as its motion";
  EXPECT_FALSE(besideASphere(0.2, Vector3(0.0, -0.05, 0.0), 0.3, 0.1).accepted()) << "closer than its motion";
  EXPECT_FALSE(besideASphere(0.2, away, 0.3, 0.35).accepted());
}

TEST(LeastDistance, OfAPairToo) {
  const auto verdict = [](double apart, const Vector3& velocity, double committed = 1e3) {
    CheckScene scene;
    scene.committed = Vector3(0.0, committed, 0.0);
    scene.limits.pair_horizontal = 2.0;
    scene.limits.pair_vertical = 3.0;
    scene.plan(straightPlan(Vector3(0.0, apart, 0.0), velocity, 0.0, 0.3));
    CommittedMotion other;
    other.assignRest(-5.0, Vector3::Zero());
    scene.addMotion(other);
    return scene.check();
  };
  const Vector3 zero = Vector3::Zero();
  EXPECT_TRUE(verdict(2.0, Vector3(2.0, 0.0, 0.0)).accepted());
  EXPECT_TRUE(verdict(2.0, Vector3(0.0, 2.0, 1.0)).accepted());
  EXPECT_FALSE(verdict(2.0, Vector3(0.0, -0.005, 0.0)).accepted());
  EXPECT_TRUE(verdict(2.1, Vector3(0.0, -0.005, 0.0)).accepted());
  EXPECT_TRUE(verdict(2.0, zero).accepted());
  EXPECT_FALSE(verdict(2.0 - 2e-6, zero).accepted());
  // Two that stood too close before the first plan.
  EXPECT_TRUE(verdict(1.9, zero, 1.9).accepted());
  EXPECT_TRUE(verdict(1.9, Vector3(0.0, 2.0, 0.0), 1.9).accepted());
  EXPECT_TRUE(verdict(1.9, Vector3(0.0, 2.0, 0.0), 1.8).accepted());
  EXPECT_FALSE(verdict(1.9, Vector3(0.0, 2.0, 0.0), 1.901).accepted());
  EXPECT_FALSE(verdict(1.9, Vector3(0.0, -0.005, 0.0), 1.9).accepted());
  EXPECT_TRUE(verdict(1.9, Vector3(0.0, -0.005, 0.0), 1.8).accepted());
  EXPECT_FALSE(verdict(1.9, Vector3(0.0, -0.05, 0.0), 1.8).accepted());
}

// A motion that may be flown because newer setpoints were lost is so for a while only.
TEST(OtherMotion, IsKeptClearOfAsLongAsItMayBeFlown) {
  const auto verdict = [](double valid_for) {
    CheckScene scene;
    scene.plan(straightPlan(Vector3::Zero(), Vector3(2.0, 0.0, 0.0), 50.0, 0.3));
    CommittedMotion other;
    other.assignRest(49.0, Vector3(6.0, 0.5, 0.0));  // the two come together after 2 s
    scene.addMotion(other, 50.0 + valid_for);
    return scene.check();
  };
  EXPECT_TRUE(verdict(-0.5).accepted());
  EXPECT_TRUE(verdict(1.4).accepted());
  EXPECT_EQ(verdict(2.2).reason, CheckReason::kUav);
  EXPECT_EQ(verdict(100.0).reason, CheckReason::kUav);
}

TEST(OtherMotion, IsOfNoConcernToTheRestAfterThat) {
  CheckScene scene;
  scene.plan(makePlan({Vector3::Zero(), Vector3::Zero(), Vector3::Zero()}, noJerks(), 0.0, 0.15));
  StopManoeuvre stop;
  const Trajectory coming = straightPlan(Vector3(12.0, 1.0, 0.0), Vector3(-2.0, 0.0, 0.0), 0.0, 0.3);
  planStop(coming.knots.back(), 0.3, scene.limits.bounds, stop);
  CommittedMotion other;
  other.assign(coming, stop);
  scene.addMotion(other, 2.0);
  EXPECT_TRUE(scene.check().accepted()) << "the motion rests after that time";
  scene.surroundings.uavs[0].valid_until = 1e3;
  EXPECT_EQ(scene.check().reason, CheckReason::kUav);
}

TEST(LeastDistance, OfTheWorkspaceAndTheSpeedToo) {
  const auto verdict = [](double x, double speed) {
    CheckScene scene;
    scene.limits.bounds.workspace.min = Vector3(-100.0, -100.0, -100.0);
    scene.limits.bounds.workspace.max = Vector3(10.0, 100.0, 100.0);
    scene.limits.workspace_slack = 0.2;
    scene.limits.bound_slack = 0.02;
    scene.plan(straightPlan(Vector3(x, 0.0, 0.0), Vector3(0.0, speed, 0.0), 0.0, 0.3));
    return scene.check().reason;
  };
  EXPECT_EQ(verdict(10.0, 5.0), CheckReason::kAccepted);
  EXPECT_EQ(verdict(10.15, 5.0), CheckReason::kAccepted);
  EXPECT_EQ(verdict(10.21, 5.0), CheckReason::kWorkspace);
  EXPECT_EQ(verdict(10.0, 5.09), CheckReason::kAccepted);
  EXPECT_EQ(verdict(10.0, 5.11), CheckReason::kSpeed);
}

// The induction step: whatever was accepted is accepted again from any later knot of it on, if the new predictions stay
// within the growth that the old ones stated. And its negative control.
TEST(Induction, AnAcceptedMotionStaysAccepted) {
  Random random(7);
  int steps = 0;
  int refused_after_too_much = 0;
  for (int n = 0; n < 2000; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    scene.addRandomObstacle(random, random.uniform(0.5, 0.8));
    scene.addRandomUav(random, random.uniform(1.1, 1.5));
    if (!scene.check().accepted()) continue;
    const PredictedObstacle old = scene.surroundings.obstacles[0];
    for (int dropped = 1; dropped <= scene.motion.pieces(); dropped += random.integer(1, 6)) {
      CommittedMotion rest = scene.motion;
      rest.dropPieces(dropped);
      const auto recheck = [&](double factor) {
        // Seen anew at the later epoch: off by up to what the growth allowed until then, and with as much less to grow.
        const double elapsed = rest.epoch() - old.stamp;
        const double grown = factor * old.growth_rate * std::min(elapsed, old.growth_time);
        const Superellipsoid seen(1, old.body->center() + elapsed * old.body->velocity() + grown * random.direction(),
                                  old.body->radii(), old.body->exponents(), old.body->yaw(), old.body->velocity());
        CheckSurroundings surroundings = scene.surroundings;
        surroundings.obstacles[0].body = &seen;
        surroundings.obstacles[0].stamp = rest.epoch();
        surroundings.obstacles[0].growth_time = std::max(old.growth_time - elapsed, 0.0);
        CheckLimits limits = scene.limits;
        // What is proven to within a tolerance once need not be so to within none the next time.
        surroundings.obstacles[0].least_distance -= 1e-5;
        limits.pair_horizontal -= 1e-5;
        limits.pair_vertical -= 1e-5;
        limits.look_ahead -= rest.epoch() - scene.motion.epoch() - (scene.motion.duration() - rest.duration());
        return checkClearance(rest, scene.committed, limits, surroundings);
      };
      const CheckVerdict verdict = recheck(1.0);
      ASSERT_TRUE(verdict.accepted()) << n << " " << checkReasonText(verdict.reason) << " at " << verdict.time;
      ++steps;
      refused_after_too_much += recheck(100.0).accepted() ? 0 : 1;
    }
  }
  std::printf("  %d steps; with a hundred times the growth %d refused\n", steps, refused_after_too_much);
  EXPECT_GT(steps, 1000);
  EXPECT_GT(refused_after_too_much, 20);
}

}  // namespace
}  // namespace swarm_planner
