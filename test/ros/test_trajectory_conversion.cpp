// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: a vehicle that flies something else than what was planned and checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/time_conversion.hpp"
#include "swarm_planner/ros/trajectory_conversion.hpp"

namespace swarm_planner {
namespace {

Trajectory somePlan() {
  Trajectory plan;
  plan.epoch = 1234.5;
  plan.dt = 0.3;
  for (std::size_t k = 0; k < plan.jerks.size(); ++k) {
    const auto x = static_cast<double>(k);
    plan.jerks[k] = Vector3(std::sin(x), std::cos(2.0 * x), 0.1 * x);
  }
  rollOut({Vector3(1, -2, 30), Vector3(3, 0.5, -0.25), Vector3(0.1, -0.2, 0.3)}, plan);
  return plan;
}

SetpointTrajectory someSetpoints() {
  SetpointTrajectory setpoints;
  const Trajectory plan = somePlan();
  sampleMotion(plan, plan.epoch, 0.05, 2.0, 0.7, setpoints);
  return setpoints;
}

TEST(TrajectoryConversion, MessageKeepsTheContract) {
  trajectory_msgs::MultiDOFJointTrajectory message;
  toMessage(someSetpoints(), "map", message);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_DOUBLE_EQ(message.header.stamp.toSec(), 1234.5);
  ASSERT_FALSE(message.points.empty());
  EXPECT_EQ(message.joint_names.size(), 1U);
  EXPECT_TRUE(message.points.front().time_from_start.isZero());
  for (std::size_t i = 0; i < message.points.size(); ++i) {
    const auto& point = message.points[i];
    if (i > 0) {
      EXPECT_GT(point.time_from_start, message.points[i - 1].time_from_start);
    }
    EXPECT_EQ(point.transforms.size(), 1U);
    EXPECT_EQ(point.velocities.size(), 1U);
    EXPECT_EQ(point.accelerations.size(), 1U);
    EXPECT_NEAR(yawOf(toQuaternion(point.transforms[0].rotation)), 0.7, 1e-12);
  }
}

TEST(TrajectoryConversion, SetpointsSurviveARoundTrip) {
  const SetpointTrajectory sent = someSetpoints();
  trajectory_msgs::MultiDOFJointTrajectory message;
  toMessage(sent, "map", message);
  const SetpointTrajectory received = toSetpoints(message);
  EXPECT_NEAR(received.epoch, sent.epoch, 1e-6);
  ASSERT_EQ(received.points.size(), sent.points.size());
  for (std::size_t i = 0; i < sent.points.size(); ++i) {
    EXPECT_NEAR(received.points[i].time_from_start, sent.points[i].time_from_start, 1e-8);
    EXPECT_EQ(received.points[i].p, sent.points[i].p);
    EXPECT_EQ(received.points[i].v, sent.points[i].v);
    EXPECT_EQ(received.points[i].a, sent.points[i].a);
    EXPECT_NEAR(received.points[i].yaw, sent.points[i].yaw, 1e-12);
  }
}

TEST(TrajectoryConversion, ReusedMessageKeepsNothingOfTheOneBefore) {
  trajectory_msgs::MultiDOFJointTrajectory message;
  toMessage(someSetpoints(), "map", message);
  SetpointTrajectory shorter = someSetpoints();
  shorter.points.resize(3);
  toMessage(shorter, "map", message);
  EXPECT_EQ(message.points.size(), 3U);
}

TEST(TrajectoryConversion, RefusesAPointWithoutPose) {
  trajectory_msgs::MultiDOFJointTrajectory message;
  message.points.resize(1);
  EXPECT_THROW(toSetpoints(message), std::invalid_argument);
}

/// The state that a reader of the message finds at `time` [s] after its epoch, by what UavPlan.msg says.
KinematicState stateIn(const UavPlan& message, double time) {
  const auto vector = [](const auto& numbers, std::size_t first) {
    return Vector3(numbers[first], numbers[first + 1], numbers[first + 2]);
  };
  KinematicState x{vector(message.position, 0), vector(message.velocity, 0), vector(message.acceleration, 0)};
  for (std::size_t k = 0; 3 * k < message.jerks.size(); ++k) {
    const double into = std::min(time - static_cast<double>(k) * message.dt, message.dt);
    if (into <= 0.0) break;
    x = propagate(x, vector(message.jerks, 3 * k), into);
  }
  return x;
}

TEST(TrajectoryConversion, ThePlanMessageIsTheWholeMotionWithItsStop) {
  const Trajectory plan = somePlan();
  StopManoeuvre stop;
  rollOutStop(plan.knots.back(), 12, plan.dt, stop);
  CommittedMotion motion;
  motion.assign(plan, stop);
  for (int dropped = 0; dropped < 2; ++dropped) {
    UavPlan message;
    message.jerks.resize(500);
    toMessage(motion, "uav1", message);
    EXPECT_EQ(message.name, "uav1");
    EXPECT_NEAR(toSeconds(message.epoch), motion.epoch(), 1e-6);
    EXPECT_EQ(message.dt, motion.dt());
    ASSERT_EQ(message.jerks.size(), static_cast<std::size_t>(3 * (kHorizon + 12 - dropped)));
    for (double time = 0.0; time <= motion.duration(); time += 0.07) {
      const KinematicState read = stateIn(message, time);
      const KinematicState flown = motion.after(time);
      ASSERT_LT((read.p - flown.p).norm(), 1e-8) << time;
      ASSERT_LT((read.v - flown.v).norm(), 1e-8) << time;
      ASSERT_LT((read.a - flown.a).norm(), 1e-8) << time;
    }
    const KinematicState end = stateIn(message, motion.duration());
    EXPECT_LT((end.p - motion.restingPlace()).norm(), 1e-8);
    EXPECT_LT(end.v.norm() + end.a.norm(), 1e-8) << "it is said to rest after the last segment";
    motion.dropPieces(1);
  }
}

TEST(TrajectoryConversion, ThePlanMessageOfAUavAtRestHasNoSegments) {
  CommittedMotion motion;
  motion.assignRest(12.0, Vector3(1, 2, 3));
  UavPlan message;
  message.velocity[1] = 7.0;
  toMessage(motion, "uav2", message);
  EXPECT_TRUE(message.jerks.empty());
  EXPECT_LT((stateIn(message, 5.0).p - Vector3(1, 2, 3)).norm(), 1e-12);
  EXPECT_EQ(stateIn(message, 5.0).v.norm(), 0.0);
}

}  // namespace
}  // namespace swarm_planner
