// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: a UAV planned from a wrong place or velocity, or from numbers that are none.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "swarm_planner/model/flat_inputs.hpp"
#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/odometry_conversion.hpp"
#include "swarm_planner/ros/quad_odometry.hpp"

namespace swarm_planner {
namespace {

constexpr double kNow = 100.0;
constexpr double kTimeout = 0.5;
constexpr double kHalfPi = 1.5707963267948966;

nav_msgs::Odometry goodMessage() {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(kNow - 0.02);
  message.header.frame_id = "map";
  message.child_frame_id = "uav1/base_link";
  message.pose.pose.position = toPoint(Vector3(1, 2, 3));
  message.pose.pose.orientation = toQuaternionMessage(yawRotation(kHalfPi));
  message.twist.twist.linear = toVector3Message(Vector3(4, 0, 0.5));
  return message;
}

class OdometryConversion : public ::testing::Test {
 protected:
  OdometryResult convert(const nav_msgs::Odometry& message, TwistFrame twist = TwistFrame::kBody) {
    return convertOdometry(message, frames_, twist, kNow, kTimeout);
  }
  tf2::BufferCore buffer_;
  FrameTransformer frames_{buffer_, "map", kTimeout};
};

TEST_F(OdometryConversion, RotatesABodyTwistByTheAttitude) {
  const OdometryResult result = convert(goodMessage());
  ASSERT_EQ(result.fault, InputFault::kNone) << result.why;
  EXPECT_TRUE(result.sample.p.isApprox(Vector3(1, 2, 3)));
  EXPECT_TRUE(result.sample.v.isApprox(Vector3(0, 4, 0.5), 1e-12)) << result.sample.v.transpose();
  EXPECT_NEAR(yawOf(result.sample.orientation), kHalfPi, 1e-12);
  EXPECT_NEAR(result.sample.stamp, kNow - 0.02, 1e-6);
}

TEST_F(OdometryConversion, LeavesAWorldTwistUnrotated) {
  const OdometryResult result = convert(goodMessage(), TwistFrame::kWorld);
  EXPECT_TRUE(result.sample.v.isApprox(Vector3(4, 0, 0.5), 1e-12)) << result.sample.v.transpose();
}

TEST_F(OdometryConversion, BringsPoseAndTwistIntoThePlanningFrame) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "map";
  transform.child_frame_id = "odom";
  transform.transform.translation = toVector3Message(Vector3(10, 20, 0));
  transform.transform.rotation = toQuaternionMessage(yawRotation(kHalfPi));
  buffer_.setTransform(transform, "test", true);
  nav_msgs::Odometry message = goodMessage();
  message.header.frame_id = "odom";

  const OdometryResult body = convert(message);
  ASSERT_EQ(body.fault, InputFault::kNone) << body.why;
  EXPECT_TRUE(body.sample.p.isApprox(Vector3(8, 21, 3), 1e-12)) << body.sample.p.transpose();
  EXPECT_TRUE(body.sample.v.isApprox(Vector3(-4, 0, 0.5), 1e-12)) << body.sample.v.transpose();
  EXPECT_TRUE(convert(message, TwistFrame::kWorld).sample.v.isApprox(Vector3(0, 4, 0.5), 1e-12));
}

TEST_F(OdometryConversion, SimulatedOdometryGivesBackTheSimulatedState) {
  QuadState state;
  state.phi = 0.3;
  state.theta = -0.4;
  UavMeasurement measured;
  measured.p = Vector3(5, 6, 7);
  measured.v = Vector3(1, -2, 0.5);
  nav_msgs::Odometry message = goodMessage();
  setPoseAndTwist(measured, state, message);
  const OdometryResult result = convert(message);
  EXPECT_TRUE(result.sample.p.isApprox(measured.p, 1e-12));
  EXPECT_TRUE(result.sample.v.isApprox(measured.v, 1e-12)) << result.sample.v.transpose();
}

TEST_F(OdometryConversion, SimulatedAttitudePointsTheThrustAsTheModelDoes) {
  const VehicleParameters vehicle;
  const Attitude attitude = attitudeFor(Vector3(1, 2, 0), Vector3(2, -3, 1), vehicle);
  QuadState state;
  state.phi = attitude.phi;
  state.theta = attitude.theta;
  const Vector3 thrust_direction = orientationOf(state) * Vector3::UnitZ();
  const Vector3 wanted = thrustAcceleration(Vector3(1, 2, 0), Vector3(2, -3, 1), vehicle) + vehicle.gravity * upward();
  EXPECT_TRUE(thrust_direction.isApprox(wanted.normalized(), 1e-9));
}

struct BadOdometry {
  const char* what;
  InputFault fault;
  const char* message;  ///< that the operator must read
  std::function<void(nav_msgs::Odometry&)> spoil;
};

TEST_F(OdometryConversion, DropsWhatCannotBeUsedAndSaysWhy) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  using Odometry = nav_msgs::Odometry;
  const std::vector<BadOdometry> table = {
      {"NaN position", InputFault::kNotFinite, "position is not finite",
       [](Odometry& m) { m.pose.pose.position.y = kNan; }},
      {"infinite velocity", InputFault::kNotFinite, "velocity is not finite",
       [](Odometry& m) { m.twist.twist.linear.z = kInfinity; }},
      {"NaN orientation", InputFault::kNotFinite, "orientation is not finite",
       [](Odometry& m) { m.pose.pose.orientation.w = kNan; }},
      {"absurd position", InputFault::kAbsurd, "absurd", [](Odometry& m) { m.pose.pose.position.x = 1e8; }},
      {"absurd velocity", InputFault::kAbsurd, "absurd", [](Odometry& m) { m.twist.twist.linear.z = -1e300; }},
      {"frame of a megabyte", InputFault::kFrame, "(1000000 characters)",
       [](Odometry& m) { m.header.frame_id = std::string(1000000, 'f'); }},
      {"no orientation", InputFault::kOrientation, "norm 0.000",
       [](Odometry& m) { m.pose.pose.orientation = geometry_msgs::Quaternion(); }},
      {"long quaternion", InputFault::kOrientation, "norm 2.000",
       [](Odometry& m) { m.pose.pose.orientation.z = 0, m.pose.pose.orientation.w = 2; }},
      {"from the future", InputFault::kFromFuture, "1.00 s ahead",
       [](Odometry& m) { m.header.stamp = ros::Time(kNow + 1.0); }},
      {"stale", InputFault::kStale, "2.00 s old, limit 0.50 s",
       [](Odometry& m) { m.header.stamp = ros::Time(kNow - 2.0); }},
      {"never stamped", InputFault::kStale, "has no stamp", [](Odometry& m) { m.header.stamp = ros::Time(); }},
      {"unknown frame", InputFault::kFrame, "'odom' to 'map'", [](Odometry& m) { m.header.frame_id = "odom"; }},
      {"no frame", InputFault::kFrame, "frame_id is empty", [](Odometry& m) { m.header.frame_id = ""; }},
  };
  for (const BadOdometry& bad : table) {
    nav_msgs::Odometry message = goodMessage();
    bad.spoil(message);
    const OdometryResult result = convert(message);
    EXPECT_EQ(result.fault, bad.fault) << bad.what;
    EXPECT_NE(result.why.find(bad.message), std::string::npos) << bad.what << ": " << result.why;
  }
}

}  // namespace
}  // namespace swarm_planner
