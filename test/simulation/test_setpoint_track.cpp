// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What a vehicle makes of the trajectories it receives. If these fail, vehicles fly something else than what was
// published, or the wrong one of two trajectories.
#include <gtest/gtest.h>

#include <limits>

#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/simulation/setpoint_track.hpp"

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Trajectory curvedPlan(double epoch) {
  Trajectory plan;
  plan.epoch = epoch;
  plan.dt = 0.3;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const double x = static_cast<double>(k);
    plan.jerks[k] = Vector3(4.0 - 0.4 * x, k % 2 == 0 ? 2.0 : -2.0, 0.1 * x - 1.0);
  }
  rollOut({Vector3(1.0, 2.0, 3.0), Vector3(0.5, -1.0, 0.0), Vector3(0.0, 1.0, -0.5)}, plan);
  return plan;
}

SetpointTrajectory at(double epoch, const Vector3& p) {
  SetpointTrajectory trajectory;
  trajectory.epoch = epoch;
  trajectory.points.resize(1);
  trajectory.points[0].p = p;
  return trajectory;
}

const Vector3 kStart(9.0, 9.0, 9.0);

TEST(SetpointTrack, ASampledPlanIsFlownExactly) {
  const Trajectory plan = curvedPlan(100.0);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.05, kInfinity, 0.0, sampled);
  SetpointTrack track(kStart);
  ASSERT_TRUE(track.receive(sampled, 99.0));
  for (double t = 100.003; t < 100.0 + plan.duration(); t += 0.017) {
    const KinematicState expected = plan.at(t);
    const MotionSetpoint setpoint = track.at(t);
    const auto segment = static_cast<std::size_t>((t - 100.0) / plan.dt);
    EXPECT_LT((setpoint.p - expected.p).norm(), 1e-9);
    EXPECT_LT((setpoint.v - expected.v).norm(), 1e-8);
    EXPECT_LT((setpoint.a - expected.a).norm(), 1e-6);
    EXPECT_LT((setpoint.jerk - plan.jerks[segment]).norm(), 1e-3);  // fourth differences of positions 0.05 s apart
  }
}

TEST(SetpointTrack, BetweenCoarseSamplesTheMotionStaysSmoothAndNear) {
  const Trajectory plan = curvedPlan(0.0);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.4, kInfinity, 0.0, sampled);
  SetpointTrack track(kStart);
  ASSERT_TRUE(track.receive(sampled, 0.0));
  MotionSetpoint last = track.at(0.0);
  constexpr double kStep = 1e-3;
  for (double t = kStep; t < plan.duration() - kStep; t += kStep) {
    const MotionSetpoint setpoint = track.at(t);
    EXPECT_LT((setpoint.p - plan.at(t).p).norm(), 0.01);
    EXPECT_LT((setpoint.a - last.a).norm(), 0.05);
    EXPECT_LT((setpoint.v - last.v - 0.5 * kStep * (setpoint.a + last.a)).norm(), 1e-5);
    last = setpoint;
  }
}

TEST(SetpointTrack, TrajectoriesTakeOverInTheOrderOfTheirEpochs) {
  const Vector3 first(1.0, 0.0, 0.0), second(2.0, 0.0, 0.0), third(3.0, 0.0, 0.0);
  SetpointTrack track(kStart);
  ASSERT_TRUE(track.receive(at(1.0, first), 0.0));
  ASSERT_TRUE(track.receive(at(2.0, second), 0.0));
  ASSERT_TRUE(track.receive(at(3.0, third), 0.0));
  EXPECT_EQ(track.at(0.9).p, kStart);
  EXPECT_EQ(track.at(1.9).p, first);
  EXPECT_EQ(track.at(2.9).p, second);
  EXPECT_EQ(track.at(3.1).p, third);
}

TEST(SetpointTrack, ANewTrajectoryReplacesTheWaitingOnesThatBeginLater) {
  const Vector3 first(1.0, 0.0, 0.0), late(2.0, 0.0, 0.0), newest(3.0, 0.0, 0.0);
  SetpointTrack track(kStart);
  ASSERT_TRUE(track.receive(at(1.0, first), 0.0));
  ASSERT_TRUE(track.receive(at(4.0, late), 0.0));
  ASSERT_TRUE(track.receive(at(2.0, newest), 1.5));
  EXPECT_EQ(track.at(1.9).p, first);
  EXPECT_EQ(track.at(2.1).p, newest);
  EXPECT_EQ(track.at(5.0).p, newest);
}

TEST(SetpointTrack, OneThatArrivesAfterItsEpochIsJoinedUnderWay) {
  const Trajectory plan = curvedPlan(0.0);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.05, kInfinity, 0.0, sampled);
  SetpointTrack track(kStart);
  ASSERT_TRUE(track.receive(sampled, 1.0));
  EXPECT_LT((track.at(1.0).p - plan.at(1.0).p).norm(), 1e-9);
}

// A source whose clock runs ahead, or that never stops sending for later.
TEST(SetpointTrack, WhatWaitsIsBounded) {
  SetpointTrack track(kStart);
  EXPECT_FALSE(track.receive(at(100.0, Vector3(1.0, 0.0, 0.0)), 0.0)) << "more than a minute ahead";
  EXPECT_EQ(track.at(101.0).p, kStart);
  for (int i = 0; i < 10000; ++i) {
    const double epoch = 1.0 + 0.005 * i;
    ASSERT_TRUE(track.receive(at(epoch, Vector3(epoch, 0.0, 0.0)), 0.0));
  }
  EXPECT_EQ(track.at(1.001).p.x(), 1.0) << "the first to begin stay";
  EXPECT_EQ(track.at(60.0).p.x(), 1.0 + 0.005 * 9999) << "and the newest";
}

TEST(SetpointTrack, LargeTimesAreNoTrouble) {
  const double now = 1.7e9 + 0.123456;  // ROS time counts from 1970
  const Trajectory plan = curvedPlan(now);
  SetpointTrajectory sampled;
  sampleMotion(plan, plan.epoch, 0.05, kInfinity, 0.0, sampled);
  for (Setpoint& point : sampled.points) point.time_from_start += 0.1;
  SetpointTrack track(kStart);
  ASSERT_TRUE(track.receive(sampled, now));
  for (double t = now; t < now + 1.0; t += 1e-4) ASSERT_TRUE(track.at(t).p.allFinite());
}

}  // namespace
}  // namespace swarm_planner
