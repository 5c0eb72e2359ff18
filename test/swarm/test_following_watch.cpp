// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A vehicle that does not fly what it is told has to show before others are beside it, and one that is pushed, blown or
// measured badly must not.
#include <gtest/gtest.h>

#include "support/flight_problem.hpp"
#include "swarm_planner/simulation/gaussian_noise.hpp"
#include "swarm_planner/swarm/following_watch.hpp"

namespace swarm_planner {
namespace {

constexpr double kCycle = 0.3;    // [s]
constexpr double kBegin = 500.0;  // [s]
const Vector3 kPlace(1, 2, 10);
const Vector3 kFast(3, 0, 0);

class Following : public ::testing::Test {
 protected:
  Following() {
    const Trajectory plan = straightPlan(kPlace, kFast, kBegin, kCycle);
    StopManoeuvre stop;
    rollOutStop(plan.knots.back(), 10, kCycle, stop);
    CommittedMotion motion;
    motion.assign(plan, stop);
    motions_.commit(motion);
  }
  /// `dp` and `dv` off the motion, `t` seconds after its beginning.
  void note(double t, const Vector3& dp, const Vector3& dv, const Vector3& drift = Vector3::Zero()) {
    const KinematicState x = motions_.flown().at(kBegin + t);
    watch_.note({true, kBegin + t, x.p + dp, x.v + dv}, drift, motions_, parameters_.input);
  }
  /// It brakes with 3 m/s^2 from kBegin + `t` on.
  void noteBraking(double t, double since) {
    const double braked = std::clamp(t - since, 0.0, 1.0);
    const double way = 3.0 * (t - since) - (3.0 * braked - 1.5 * braked * braked);
    note(t, Vector3(-std::max(way, 0.0), 0, 0), Vector3(-3.0 * braked, 0, 0));
  }

  const Vector3 none_ = Vector3::Zero();
  Parameters parameters_;
  MotionMemory motions_;
  FollowingWatch watch_;
};

TEST_F(Following, IsSeenInOnWhoStopsOnItsOwn) {
  for (double since = 0.6; since < 0.9; since += 0.05) {
    watch_.reset();
    int suspected = 0;
    int told = 0;
    for (int cycle = 0; cycle < 8 && told == 0; ++cycle) {
      noteBraking(kCycle * cycle, since);
      if (suspected == 0 && watch_.isSuspected()) suspected = cycle;
      if (watch_.isNotFollowing()) told = cycle;
    }
    EXPECT_LE(kCycle * suspected - since, 0.51) << since;
    EXPECT_LE(kCycle * told - since, 0.81) << since;
    EXPECT_GT(suspected, 2) << "it has been doubted before it did anything";
  }
}

TEST_F(Following, LetsNoisePassThatItIsMadeFor) {
  GaussianNoise noise(1);
  const double n = parameters_.input.odometry_noise;
  int suspected = 0;
  for (int i = 0; i < 5000; ++i) {
    note(0.001 * i, noise.vector(n), noise.vector(n));
    EXPECT_FALSE(watch_.isNotFollowing()) << i;
    suspected += watch_.isSuspected() ? 1 : 0;
  }
  EXPECT_LT(suspected, 500);
  for (int i = 0; i < 5000; ++i) {
    note(0.001 * i, noise.vector(3.0 * n), noise.vector(3.0 * n));
    if (watch_.isNotFollowing()) return;
  }
  ADD_FAILURE() << "nothing was at stake";
}

// Others keep clear of where it may end; nobody is told.
TEST_F(Following, OfAUavThatIsPushedIsDoubtedUntilItFliesOn) {
  note(0.3, none_, none_);
  note(0.6, Vector3(0, 0.2, 0), Vector3(0, 2.0, 0));
  EXPECT_TRUE(watch_.isSuspected());
  EXPECT_FALSE(watch_.isNotFollowing());
  note(0.9, Vector3(0, 0.1, 0), Vector3(0, 0.1, 0));
  EXPECT_FALSE(watch_.isSuspected());
}

TEST_F(Following, TakesTwoDeviationsToOneSide) {
  for (int i = 1; i < 10; ++i) {
    note(0.3 * i, none_, Vector3(0, i % 2 == 0 ? 1.0 : -1.0, 0));
    EXPECT_FALSE(watch_.isNotFollowing());
  }
  note(3.0, none_, Vector3(0, 1.0, 0));
  note(3.0, none_, Vector3(0, 1.0, 0));
  EXPECT_FALSE(watch_.isNotFollowing()) << "the same measurement twice";
  note(3.3, none_, Vector3(0, 1.0, 0));
  EXPECT_TRUE(watch_.isNotFollowing());
}

TEST_F(Following, DoesNotBlameTheVehicleForTheDriftOfItsOdometry) {
  note(0.3, Vector3(0, 0.8, 0), none_, Vector3(0, 0.8, 0));
  note(0.6, Vector3(0, 1.0, 0), none_, Vector3(0, 1.0, 0));
  EXPECT_FALSE(watch_.isSuspected());
  note(0.9, Vector3(0, 1.0, 0), none_);
  note(1.2, Vector3(0, 1.0, 0), none_);
  EXPECT_TRUE(watch_.isNotFollowing());
}

// A plan from where it hovers has it nearby at first: that shows nothing.
TEST_F(Following, IsBelievedAgainOnceItHasFlown) {
  const KinematicState there = motions_.flown().at(kBegin + 0.6);
  note(0.3, none_, Vector3(-2, 0, 0));
  note(0.6, none_, Vector3(-2, 0, 0));
  ASSERT_TRUE(watch_.isOff());
  CommittedMotion rest;
  rest.assignRest(kBegin + 0.6, there.p);
  motions_.startAnew(rest);
  note(0.9, none_, none_);
  EXPECT_TRUE(watch_.isNotFollowing());
  EXPECT_FALSE(watch_.isOff());
  note(2.0, none_, none_);
  EXPECT_FALSE(watch_.isNotFollowing()) << "it rests where it is to rest: nothing to be told";
  EXPECT_TRUE(watch_.isSuspected());
  rest.assignRest(kBegin + 2.1, there.p + Vector3(0.8, 0, 0));
  motions_.startAnew(rest);
  note(2.4, none_, none_);
  EXPECT_FALSE(watch_.isSuspected()) << "it has gone where it was to go";
}

TEST_F(Following, DoesNotHoldZeroAgainstASourceThatDoesNotKnowTheVelocity) {
  for (double t = 0.3; t < 3.0; t += 0.3) {
    const Vector3 p = motions_.flown().at(kBegin + t).p;
    watch_.note({true, kBegin + t, p, Vector3::Zero()}, none_, motions_, parameters_.input);
  }
  EXPECT_FALSE(watch_.isSuspected());
  for (double t = 3.0; t < 4.0; t += 0.3) note(t, none_, Vector3(0, 0, 1e-6) - kFast);
  EXPECT_TRUE(watch_.isNotFollowing());
}

TEST_F(Following, AllowsForALostTrajectory) {
  CommittedMotion turn;
  StopManoeuvre stop;
  rollOutStop(motions_.flown().at(kBegin + 0.3), 4, kCycle, stop);
  turn.assignStop(kBegin + 0.3, stop);
  const CommittedMotion before = motions_.flown();
  motions_.commit(turn);
  for (const double t : {0.6, 0.9, 1.2}) {
    const KinematicState x = before.at(kBegin + t);
    watch_.note({true, kBegin + t, x.p, x.v}, none_, motions_, parameters_.input);
  }
  EXPECT_FALSE(watch_.isSuspected());
  EXPECT_GT((before.at(kBegin + 1.2).v - turn.at(kBegin + 1.2).v).norm(), 1.0) << "nothing was at stake";
}

}  // namespace
}  // namespace swarm_planner
