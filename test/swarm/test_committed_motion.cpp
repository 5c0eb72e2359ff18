// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What a UAV flies if nothing more is commanded, and what all others keep clear of. If these fail the vehicle does
// something else than the check has seen.
#include <gtest/gtest.h>

#include "check_scene.hpp"

namespace swarm_planner {
namespace {

TEST(CommittedMotion, IsItsPlanThenItsStopThenRest) {
  Random random(9);
  for (int n = 0; n < 200; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    const CommittedMotion& motion = scene.motion;
    for (int i = 0; i < 50; ++i) {
      const double t = random.uniform(-0.1, 1.3 * motion.duration());
      const KinematicState x = motion.after(t);
      if (t <= scene.trajectory.duration()) {
        const KinematicState planned = scene.trajectory.after(t);
        ASSERT_LT((x.p - planned.p).norm(), 1e-10);
        ASSERT_LT((x.v - planned.v).norm(), 1e-9);
        ASSERT_LT((x.a - planned.a).norm(), 1e-7);
      }
      if (t >= motion.duration()) {
        ASSERT_EQ(x.p, motion.restingPlace());
        ASSERT_EQ(x.v.norm() + x.a.norm(), 0.0);
      }
      if (t < 0.0) continue;
      Box box = motion.boxOver(t, t + 0.5);
      ASSERT_TRUE(box.near({x.p, x.p}, 1e-7));
      ASSERT_TRUE(motion.box().near({x.p, x.p}, 1e-12));
    }
    CommittedMotion rest = motion;
    const int dropped = random.integer(0, motion.pieces());
    rest.dropPieces(dropped);
    const double t = random.uniform(0.0, motion.duration());
    ASSERT_LT((rest.after(t).p - motion.after(t + dropped * motion.dt()).p).norm(), 1e-9);
  }
}

TEST(CommittedMotion, KnowsHowManyPiecesHaveEnded) {
  Random random(2);
  CheckScene scene;
  scene.planRandomly(random, 4.0);
  const CommittedMotion& motion = scene.motion;
  EXPECT_EQ(motion.endedPieces(motion.epoch() - 100.0), 0);
  EXPECT_EQ(motion.endedPieces(motion.epoch() + 0.9 * motion.dt()), 0);
  EXPECT_EQ(motion.endedPieces(motion.epoch() + 3.1 * motion.dt()), 3);
  EXPECT_EQ(motion.endedPieces(motion.epoch() + 1e9), motion.pieces());
}

TEST(CommittedMotion, HasTheJerksOfItsPieces) {
  Random random(1);
  CheckScene scene;
  scene.planRandomly(random, 4.0);
  for (int k = 0; k < kHorizon; ++k) {
    EXPECT_LT((scene.motion.jerk(k) - scene.trajectory.jerks[static_cast<std::size_t>(k)]).norm(), 1e-6) << k;
  }
  for (int k = kHorizon; k < scene.motion.pieces(); ++k) {
    const KinematicState begin = scene.motion.after(k * scene.motion.dt());
    const KinematicState end = propagate(begin, scene.motion.jerk(k), scene.motion.dt());
    const KinematicState next = scene.motion.after((k + 1) * scene.motion.dt());
    EXPECT_LT((end.p - next.p).norm() + (end.v - next.v).norm(), 1e-7) << k;
  }
  EXPECT_EQ(scene.motion.jerk(scene.motion.pieces()).norm(), 0.0);
}

TEST(CommittedMotion, OfAStopBrakesAtOnce) {
  const KinematicState start{Vector3(1, 2, 3), Vector3(4, 0, 0), Vector3(0, 1, 0)};
  StopManoeuvre stop;
  planStop(start, 0.3, defaultCheckLimits().bounds, stop);
  CommittedMotion motion;
  motion.assignStop(100.0, stop);
  EXPECT_EQ(motion.pieces(), stop.stages);
  EXPECT_LT((motion.at(100.0).p - start.p).norm() + (motion.at(100.0).v - start.v).norm(), 1e-12);
  EXPECT_EQ(motion.after(motion.duration()).v.norm(), 0.0);
  EXPECT_LT((motion.restingPlace() - stop.knots[static_cast<std::size_t>(stop.stages)].p).norm(), 1e-12);
}

TEST(CommittedMotion, KeepsItsTimesWhenPiecesAreDropped) {
  Random random(2);
  CheckScene scene;
  scene.planRandomly(random, 4.0);
  const CommittedMotion whole = scene.motion;
  CommittedMotion& rest = scene.motion;
  rest.dropPieces(3);
  EXPECT_NEAR(rest.epoch(), whole.epoch() + 3.0 * whole.dt(), 1e-9);
  for (double t = rest.epoch(); t < rest.epoch() + 10.0; t += 0.1) {
    EXPECT_LT((rest.at(t).p - whole.at(t).p).norm(), 1e-8) << t - whole.epoch();
  }
  rest.dropPieces(1000);
  EXPECT_EQ(rest.pieces(), 0);
  EXPECT_EQ(rest.start(), whole.restingPlace());
  rest.dropPieces(-1);
  EXPECT_EQ(rest.start(), whole.restingPlace());
}

// A vehicle that gets no new setpoints flies its motion to the end and rests. Thought to fly on, it would be flown
// into.
TEST(CommittedMotion, IsPredictedToRest) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    const CommittedMotion& motion = scene.motion;
    const double dt = motion.dt();
    const double ahead = random.uniform(0.0, 1.5) * motion.duration();
    PredictedMotion predicted;
    predict(motion, motion.epoch() + ahead, dt, predicted);
    // The fit through the stages is off where the jerk changes between them.
    double change = 0.0;
    for (int k = 0; k < motion.pieces(); ++k) change = std::max(change, (motion.jerk(k + 1) - motion.jerk(k)).norm());
    for (int k = 0; k < kHorizon; ++k) {
      const BernsteinPoints<4> points{predicted.point(k, 0), predicted.point(k, 1), predicted.point(k, 2),
                                      predicted.point(k, 3)};
      for (double s = 0.0; s <= 1.0; s += 0.1) {
        const Vector3 p = subcurve(points, s, s)[0];
        EXPECT_LT((p - motion.after(ahead + (k + s) * dt).p).norm(), change * dt * dt * dt / 192.0 + 1e-7);
      }
    }
    if (ahead + (kHorizon - 1) * dt > motion.duration()) {
      EXPECT_EQ(predicted.point(kHorizon - 1, 3), motion.restingPlace());
    }
  }
}

}  // namespace
}  // namespace swarm_planner
