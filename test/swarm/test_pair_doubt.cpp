// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A UAV that is not seen may be off its motion, by more the longer that lasts. If the check forgets it, others fly into
// it; if it asks for more than their own motions have, they are left without any.
#include <gtest/gtest.h>

#include <cstdio>

#include "check_scene.hpp"
#include "swarm_planner/swarm/pair_check.hpp"

namespace swarm_planner {
namespace {

constexpr double kEpoch = 1e6;

Trajectory hovering(const Vector3& p) { return straightPlan(p, Vector3::Zero(), kEpoch, 0.3); }

TEST(MotionDoubt, GrowsFromWhenTheUavWasSeenLastUpToItsLimit) {
  const MotionDoubt doubt{100.0, 0.5, 2.0};
  EXPECT_EQ(doubt.at(99.0), 0.0);
  EXPECT_EQ(doubt.at(102.0), 1.0);
  EXPECT_EQ(doubt.at(104.0), 2.0);
  EXPECT_EQ(doubt.at(1e6), 2.0);
  EXPECT_EQ(doubt.times(0.5).at(102.0), 0.5);
  EXPECT_EQ(doubt.times(0.5).at(1e6), 1.0);
  EXPECT_TRUE(doubt.times(0.0).isNone());
  EXPECT_FALSE(doubt.isNone());
}

// Both rest: what counts in the end is the limit, however slowly it is reached.
TEST(PairDoubt, IsDemandedOnTopOfThePairDistanceForGood) {
  const auto accepted = [](double distance, const MotionDoubt& doubt) {
    CheckScene scene;
    scene.plan(hovering(Vector3::Zero()));
    CommittedMotion other;
    other.assignRest(kEpoch, Vector3(distance, 0.0, 0.0));
    scene.addMotion(other);
    scene.surroundings.uavs[0].doubt = doubt;
    return scene.check().accepted();
  };
  const double least = defaultCheckLimits().pair_horizontal;
  for (const double rate : {1e-3, 0.3, 100.0}) {
    const MotionDoubt doubt{kEpoch - 1.0, rate, 1.5};
    EXPECT_TRUE(accepted(least + 1.51, doubt)) << rate;
    EXPECT_FALSE(accepted(least + 1.49, doubt)) << rate;
  }
  EXPECT_TRUE(accepted(least + 0.01, MotionDoubt()));
}

// Who passes before it has grown may come as close as it has grown by then.
TEST(PairDoubt, CountsAsFarAsItHasGrownWhenTheUavPasses) {
  const auto accepted = [](double aside, double rate) {
    CheckScene scene;
    scene.plan(straightPlan(Vector3::Zero(), Vector3(4.0, 0.0, 0.0), kEpoch, 0.3));
    CommittedMotion other;
    other.assignRest(kEpoch, Vector3(4.0, aside, 0.0));  // beside it after one second
    scene.addMotion(other);
    scene.surroundings.uavs[0].doubt = {kEpoch, rate, 50.0 * rate};
    return scene.check().accepted();
  };
  const double least = defaultCheckLimits().pair_horizontal;
  EXPECT_TRUE(accepted(least + 0.35, 0.2)) << "it takes the whole growth for granted";
  EXPECT_FALSE(accepted(least + 0.15, 0.2));
  EXPECT_TRUE(accepted(least + 0.01, 0.0));
}

// The check against samples of the rule as it is stated, on random motions with random doubts.
TEST(PairDoubt, WhatIsAcceptedKeepsIt) {
  Random random(11);
  int accepted = 0;
  int refused_for_doubt = 0;
  for (int n = 0; n < 3000; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    scene.addRandomUav(random, random.uniform(1.0, 2.0));
    const bool without = scene.check().accepted();
    scene.surroundings.uavs[0].doubt = {scene.trajectory.epoch - random.uniform(-1.0, 2.0), random.uniform(0.0, 1.0),
                                        random.uniform(0.0, 2.0)};
    const bool with = scene.check().accepted();
    ASSERT_TRUE(without || !with) << n;
    refused_for_doubt += without && !with ? 1 : 0;
    if (!with) continue;
    ++accepted;
    ASSERT_GT(sampledPairSlack(scene, scene.surroundings.uavs[0]).slack, -1e-5) << n;
  }
  EXPECT_GT(accepted, 300);
  EXPECT_GT(refused_for_doubt, 100) << "nothing was at stake";
}

// The induction step. The motion flown bears the share that is demanded of plans; so it would be accepted itself, now
// and from any later knot on, however the doubt grows. Negative control: with the whole doubt it would be refused.
TEST(PairDoubt, LeavesTheMotionFlownAcceptedForGood) {
  Random random(12);
  int steps = 0;
  int refused_with_all_of_it = 0;
  for (int n = 0; n < 1500; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    scene.addRandomUav(random, random.uniform(1.05, 1.6));
    if (!scene.check().accepted()) continue;
    OtherMotion& other = scene.surroundings.uavs[0];
    const MotionDoubt doubt{scene.trajectory.epoch - 0.5, random.uniform(0.1, 1.0), random.uniform(0.2, 2.0)};
    other.doubt = doubt;
    refused_with_all_of_it += scene.check().accepted() ? 0 : 1;
    CommittedMotion flown = scene.motion;
    while (flown.pieces() > 0) {
      other.doubt = doubt;
      other.doubt = doubt.times(bearableShare(flown, other, scene.limits));
      ASSERT_TRUE(checkClearance(flown, flown.start(), scene.limits, scene.surroundings).accepted()) << n;
      // What it bears now it bears from the next knot on, too: the demand is never lowered again.
      CommittedMotion later = flown;
      later.dropPieces(1);
      scene.limits.pair_horizontal -= 1e-5;  // proven to within a tolerance once
      scene.limits.pair_vertical -= 1e-5;
      ASSERT_TRUE(checkClearance(later, later.start(), scene.limits, scene.surroundings).accepted()) << n;
      flown = later;
      ++steps;
    }
  }
  std::printf("  %d steps; %d motions refused with the whole doubt\n", steps, refused_with_all_of_it);
  EXPECT_GT(steps, 3000);
  EXPECT_GT(refused_with_all_of_it, 100);
}

TEST(PairDoubt, TheShareIsTheLargestThatTheMotionBears) {
  CheckScene scene;
  const double least = scene.limits.pair_horizontal;
  scene.plan(hovering(Vector3::Zero()));
  CommittedMotion other;
  const auto share = [&](double distance) {
    other.assignRest(kEpoch, Vector3(distance, 0.0, 0.0));
    scene.check();
    return bearableShare(scene.motion, {&other, 1e9, {kEpoch, 1.0, 2.0}}, scene.limits);
  };
  EXPECT_EQ(share(least + 2.1), 1.0);
  EXPECT_EQ(share(least + 1.9), 0.75);
  EXPECT_EQ(share(least + 1.1), 0.5);
  EXPECT_EQ(share(least + 0.6), 0.25);
  EXPECT_EQ(share(least + 0.4), 0.0);
  EXPECT_EQ(share(least - 0.5), 0.0) << "what the motion lacks already is waived, and nothing more asked";
}

}  // namespace
}  // namespace swarm_planner
