// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Odometry shows a vehicle as it was. Held against the wrong moment, every fast vehicle seems to lag behind its plan.
#include <gtest/gtest.h>

#include "support/flight_problem.hpp"
#include "swarm_planner/swarm/flown_path.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;

CommittedMotion wandering(Random& random, double epoch) {
  const KinematicState start{random.vector(-9.0, 9.0), random.vector(-3.0, 3.0), random.vector(-1.0, 1.0)};
  const Trajectory plan = wanderingPlan(random, start, 4.0, epoch, kDt);
  StopManoeuvre stop;
  rollOutStop(plan.knots.back(), 10, kDt, stop);
  CommittedMotion motion;
  motion.assign(plan, stop);
  return motion;
}

void expectSame(const KinematicState& x, const KinematicState& y, double t) {
  EXPECT_LT((x.p - y.p).norm(), 1e-8) << t;
  EXPECT_LT((x.v - y.v).norm(), 1e-8) << t;
  EXPECT_LT((x.a - y.a).norm(), 1e-7) << t;
}

TEST(FlownPath, CoversNothingAtFirst) {
  FlownPath path;
  EXPECT_FALSE(path.covers(0.0));
  EXPECT_FALSE(path.covers(100.0));
}

TEST(FlownPath, IsTheMotionUntilItEnds) {
  Random random(1);
  const CommittedMotion motion = wandering(random, 100.0);
  FlownPath path;
  path.append(motion, 101.0);  // in the middle of a piece
  EXPECT_FALSE(path.covers(99.999));
  EXPECT_FALSE(path.covers(101.001));
  for (double t = 100.0; t <= 101.0; t += 0.05) {
    ASSERT_TRUE(path.covers(t)) << t;
    expectSame(path.at(t), motion.at(t), t);
  }
}

TEST(FlownPath, GoesOverToTheNextMotion) {
  Random random(2);
  const CommittedMotion first = wandering(random, 100.0);
  const CommittedMotion second = wandering(random, 100.9);
  FlownPath path;
  path.append(first, 100.9);
  path.append(second, 102.0);
  for (double t = 100.02; t < 100.9; t += 0.05) expectSame(path.at(t), first.at(t), t);
  for (double t = 100.92; t < 102.0; t += 0.05) expectSame(path.at(t), second.at(t), t);
}

// A motion that goes on is appended bit by bit, each from where the last one ended.
TEST(FlownPath, GrowsBitByBit) {
  Random random(3);
  const CommittedMotion motion = wandering(random, 100.0);
  FlownPath path;
  for (const double until : {100.1, 100.1, 100.25, 100.3, 100.05, 101.4, 101.5}) path.append(motion, until);
  for (double t = 100.0; t <= 101.5; t += 0.03) {
    ASSERT_TRUE(path.covers(t)) << t;
    expectSame(path.at(t), motion.at(t), t);
  }
  EXPECT_FALSE(path.covers(101.51));
}

// Memory is short: what is known already must not take it twice.
TEST(FlownPath, KeepsNothingTwice) {
  Random random(7);
  const CommittedMotion motion = wandering(random, 100.0);
  FlownPath path;
  path.append(motion, 100.0 + 10.0 * kDt);
  path.append(motion, 100.0 + 20.0 * kDt);
  ASSERT_TRUE(path.covers(100.0));
  expectSame(path.at(100.1), motion.at(100.1), 100.1);
}

TEST(FlownPath, OfAMotionThatRestsStaysThere) {
  Random random(4);
  const CommittedMotion motion = wandering(random, 100.0);
  FlownPath path;
  path.append(motion, 100.0 + motion.duration() + 5.0);
  const double late = 100.0 + motion.duration() + 4.0;
  ASSERT_TRUE(path.covers(late));
  expectSame(path.at(late), motion.at(late), late);
  CommittedMotion rest;
  rest.assignRest(100.0, Vector3(1, 2, 3));
  FlownPath still;
  still.append(rest, 300.0);
  ASSERT_TRUE(still.covers(100.0)) << "a long rest takes no more memory than a short one";
  EXPECT_EQ(still.at(105.0).p, Vector3(1, 2, 3));
  EXPECT_EQ(still.at(105.0).v.norm(), 0.0);
}

// Memory has an end: the oldest goes, and what it says of the rest stays right.
TEST(FlownPath, ForgetsTheOldest) {
  Random random(5);
  FlownPath path;
  std::vector<CommittedMotion> motions;
  const int count = 2 * static_cast<int>(FlownPath::kMostPieces) + 5;
  for (int i = 0; i < count; ++i) {
    motions.push_back(wandering(random, 100.0 + kDt * i));
    path.append(motions.back(), 100.0 + kDt * (i + 1));
  }
  const double end = 100.0 + kDt * count;
  const double begin = end - kDt * static_cast<double>(FlownPath::kMostPieces);
  EXPECT_FALSE(path.covers(begin - 0.01));
  EXPECT_FALSE(path.covers(100.1));
  for (double t = begin + 0.01; t < end; t += 0.1) {
    ASSERT_TRUE(path.covers(t)) << t;
    expectSame(path.at(t), motions[static_cast<std::size_t>((t - 100.0) / kDt)].at(t), t);
  }
}

TEST(FlownPath, ForgetsAll) {
  Random random(6);
  FlownPath path;
  path.append(wandering(random, 100.0), 101.0);
  path.clear();
  EXPECT_FALSE(path.covers(100.5));
  // A jump back of time: the path before does not hold up the new one.
  const CommittedMotion motion = wandering(random, 50.0);
  path.append(motion, 51.0);
  EXPECT_TRUE(path.covers(50.0));
  expectSame(path.at(50.5), motion.at(50.5), 50.5);
}

}  // namespace
}  // namespace swarm_planner
