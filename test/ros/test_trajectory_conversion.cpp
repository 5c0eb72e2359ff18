// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: a vehicle that flies something else than what was planned and checked.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "swarm_planner/ros/geometry_conversion.hpp"
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

TEST(TrajectoryConversion, PlanSurvivesARoundTripExactly) {
  const Trajectory sent = somePlan();
  UavPlan message;
  toMessage(sent, "uav1", message);
  EXPECT_EQ(message.name, "uav1");
  const Trajectory received = toTrajectory(message);
  EXPECT_NEAR(received.epoch, sent.epoch, 1e-6);
  EXPECT_EQ(received.dt, sent.dt);
  for (std::size_t k = 0; k < sent.knots.size(); ++k) {
    EXPECT_EQ(received.knots[k].p, sent.knots[k].p) << k;
    EXPECT_EQ(received.knots[k].v, sent.knots[k].v) << k;
    EXPECT_EQ(received.knots[k].a, sent.knots[k].a) << k;
  }
}

TEST(TrajectoryConversion, RefusesAPlanOfAnotherShape) {
  UavPlan message;
  toMessage(somePlan(), "uav1", message);
  UavPlan short_plan = message;
  short_plan.jerks.pop_back();
  EXPECT_THROW(toTrajectory(short_plan), std::invalid_argument);
  message.dt = 0.0;
  EXPECT_THROW(toTrajectory(message), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
