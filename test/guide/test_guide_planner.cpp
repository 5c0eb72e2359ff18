// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// When a guide is made, kept, changed and dropped. If these fail, UAVs wait behind obstacles, or change sides for ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "guide_scene.hpp"
#include "support/random.hpp"

namespace swarm_planner {
namespace {

constexpr double kEnd = 100.0;  // of references along x [m]

void followAlongX(GuideRounds& rounds, const Vector3& position, double end = kEnd) {
  rounds.follow(0, Vector3(0, 0, 10), Vector3(end, 0, 10), position);
}

TEST(GuidePlanner, MakesNoneWhereTheReferenceIsClearWithinReach) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(15, 6, 10), Vector3(3, 5, 9), 10.0));
  rounds.scene.bodies.push_back(bodyOf(Vector3(60, 0, 10), Vector3(3, 5, 9), 10.0));
  followAlongX(rounds, Vector3(0, 0, 10));
  EXPECT_EQ(rounds.round().state, GuideState::kNotNeeded);
  EXPECT_EQ(rounds.planner.searches(), 0);
}

TEST(GuidePlanner, LeadsRoundAndBackAndIsDroppedBehind) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(15, 0, 10), Vector3(3, 5, 9), 10.0));
  followAlongX(rounds, Vector3(0, 0, 10));
  const GuideAnswer& answer = rounds.round();
  ASSERT_EQ(answer.state, GuideState::kGuided);
  EXPECT_TRUE(answer.rejoins);
  EXPECT_EQ(answer.branch, 0.0);
  EXPECT_GT(answer.rejoin, 18.0);
  EXPECT_LT(answer.rejoin, 30.0);
  EXPECT_EQ(answer.path.end(), Vector3(answer.rejoin, 0, 10));
  followAlongX(rounds, Vector3(19.5, -0.5, 10));
  EXPECT_EQ(rounds.round().state, GuideState::kNotNeeded);
}

TEST(GuidePlanner, LeadsToTheClearPointNearestToAnEndInsideAnObstacleAndOnWhenThatHasGone) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(21, 0, 10), Vector3(3, 5, 9), 10.0));
  followAlongX(rounds, Vector3(0, 0, 10), 20.0);
  const GuideAnswer& answer = rounds.round();
  ASSERT_EQ(answer.state, GuideState::kGuided);
  EXPECT_FALSE(answer.rejoins);
  EXPECT_LT((answer.path.end() - Vector3(20, 0, 10)).norm(), 4.5);
  EXPECT_GT(rounds.scene.bodies[0].shape.signedDistance(answer.path.end()), kTestDistance - 1e-3);
  // There it waits: nothing changes.
  followAlongX(rounds, answer.path.end(), 20.0);
  const Vector3 place = answer.path.end();
  for (int i = 0; i < 20; ++i) {
    rounds.round();
    ASSERT_EQ(answer.state, GuideState::kGuided);
    EXPECT_LT((answer.path.end() - place).norm(), 0.05);
  }
  rounds.scene.bodies.clear();
  EXPECT_EQ(rounds.round().state, GuideState::kNotNeeded);
}

TEST(GuidePlanner, SaysThatThereIsNoWayAndLooksAgain) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(15, 0, 15), Vector3(1, 70, 20), 10.0));
  followAlongX(rounds, Vector3(0, 0, 10));
  EXPECT_EQ(rounds.round().state, GuideState::kNoWay);
  rounds.scene.bodies[0] = bodyOf(Vector3(15, 0, 15), Vector3(1, 30, 20), 10.0);
  int tries = 0;
  while (rounds.round().state == GuideState::kNoWay && tries < 20) ++tries;
  EXPECT_EQ(rounds.answers[0].state, GuideState::kGuided);
  EXPECT_GT(tries, 1) << "not in every round anew";
}

// An obstacle whose track is noisy, exactly ahead: both sides are as good, now one, now the other by a little.
TEST(GuidePlanner, DoesNotChangeSidesForALittleGain) {
  GuideRounds rounds;
  Random random(3);
  int changes = 0;
  double side = 0.0;
  for (int i = 0; i < 60; ++i) {
    rounds.scene.bodies = {bodyOf(Vector3(15, random.uniform(-0.1, 0.1), 10), Vector3(3, 5, 30), 10.0)};
    followAlongX(rounds, Vector3(0.05 * i, 0, 10));
    const GuideAnswer& answer = rounds.round();
    ASSERT_EQ(answer.state, GuideState::kGuided);
    const double y = answer.path.points[1].y();
    if (side * y < 0.0) ++changes;
    side = y;
  }
  EXPECT_EQ(changes, 0);
}

// One that creeps into the guide: the guide gives way to it on the same side.
TEST(GuidePlanner, GivesWayOnTheSameSideToWhatMovesIntoIt) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(15, 1, 10), Vector3(3, 5, 30), 10.0));
  followAlongX(rounds, Vector3(0, 0, 10));
  const std::uint32_t number = rounds.round().number;
  for (int i = 1; i <= 20; ++i) {
    rounds.scene.bodies = {bodyOf(Vector3(15, 1 - 0.05 * i, 10), Vector3(3, 5, 30), 10.0)};
    const GuideAnswer& answer = rounds.round();
    ASSERT_EQ(answer.state, GuideState::kGuided);
    EXPECT_TRUE(std::all_of(answer.path.points.begin(),
                            answer.path.points.begin() + static_cast<std::ptrdiff_t>(answer.path.count),
                            [](const Vector3& point) { return point.y() < 1e-6; }))
        << i;
  }
  EXPECT_GT(rounds.answers[0].number, number) << "it need not have moved: this shows nothing";
}

TEST(GuidePlanner, ChangesSidesForARealGain) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(15, 2, 10), Vector3(3, 9, 30), 10.0));
  followAlongX(rounds, Vector3(0, 0, 10));
  ASSERT_LT(rounds.round().path.points[1].y(), 0.0);
  // It turns out to reach much farther there; the guide, which leads wide of it, would still be clear.
  rounds.answers[0].path.points[1].y() = -24.0;
  rounds.answers[0].path.points[rounds.answers[0].path.count - 2].y() = -24.0;
  rounds.scene.bodies[0] = bodyOf(Vector3(15, -8, 10), Vector3(3, 12, 30), 10.0);
  for (int i = 0; i < 6; ++i) rounds.round();
  EXPECT_GT(rounds.answers[0].path.points[1].y(), 0.0);
}

TEST(GuidePlanner, LeadsRoundAUavAtRest) {
  GuideRounds rounds;
  GuideBody resting;
  resting.shape =
      Superellipsoid(0, Vector3(12, 0, 10), Vector3::Constant(2.2), Vector3::Constant(2.0), 0.0, Vector3::Zero());
  resting.uav = 1;
  rounds.scene.bodies.push_back(resting);
  followAlongX(rounds, Vector3(0, 0, 10));
  EXPECT_EQ(rounds.round().state, GuideState::kGuided);
  // Itself is in nobody's way.
  rounds.scene.bodies[0].uav = 0;
  EXPECT_EQ(rounds.round().state, GuideState::kNotNeeded);
}

TEST(GuidePlanner, StartsTooNearToAnObstacleAllTheSame) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(5, 0, 10), Vector3(3, 5, 9), 10.0));
  followAlongX(rounds, Vector3(1.8, 0, 10));
  EXPECT_EQ(rounds.round().state, GuideState::kGuided);
}

// Many at once: a round stays bounded, and everybody's turn comes.
TEST(GuidePlanner, ServesACrowdInTurns) {
  constexpr std::size_t kUavs = 64;
  GuideRounds rounds(kUavs);
  for (std::size_t i = 0; i < kUavs; ++i) {
    const double y = -40.0 + 1.25 * static_cast<double>(i);
    rounds.follow(i, Vector3(0, y, 10), Vector3(80, y, 10), Vector3(0, y, 10));
  }
  rounds.scene.bodies.push_back(bodyOf(Vector3(15, 0, 0), Vector3(2, 60, 20), 10.0));
  std::size_t guided = 0;
  for (int i = 0; i < 20 && guided < kUavs; ++i) {
    rounds.round();
    EXPECT_LT(rounds.planner.expansions(), GuidePlanner::kRoundBudget + 5 * GuidePlanner::kSearchBudget + 1);
    guided = static_cast<std::size_t>(
        std::count_if(rounds.answers.begin(), rounds.answers.end(),
                      [](const GuideAnswer& answer) { return answer.state == GuideState::kGuided; }));
  }
  EXPECT_EQ(guided, kUavs);
}

TEST(GuidePlanner, ForgetsWhatWasFoundForAnotherReference) {
  GuideRounds rounds;
  rounds.scene.bodies.push_back(bodyOf(Vector3(15, 0, 10), Vector3(3, 5, 9), 10.0));
  followAlongX(rounds, Vector3(0, 0, 10));
  const std::uint32_t number = rounds.round().number;
  rounds.follow(0, Vector3(0, 0, 10), Vector3(0, 40, 10), Vector3(0, 0, 10));
  rounds.requests[0].version = 2;
  EXPECT_EQ(rounds.round().state, GuideState::kNotNeeded);
  followAlongX(rounds, Vector3(0, 0, 10));
  rounds.requests[0].version = 3;
  EXPECT_EQ(rounds.round().state, GuideState::kGuided);
  EXPECT_NE(rounds.answers[0].number, number);
}

}  // namespace
}  // namespace swarm_planner
