// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: odometry of another frame taken for the planning frame's, or dropped though tf knows it.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include "swarm_planner/ros/frame_transformer.hpp"
#include "swarm_planner/ros/geometry_conversion.hpp"

namespace swarm_planner {
namespace {

class FrameTransformerTest : public ::testing::Test {
 protected:
  void send(double stamp, double x, bool fixed = false) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time(stamp);
    transform.header.frame_id = "map";
    transform.child_frame_id = "odom";
    transform.transform.translation = toVector3Message(Vector3(x, 0, 0));
    transform.transform.rotation = toQuaternionMessage(yawRotation(0.5));
    buffer_.setTransform(transform, "test", fixed);
  }
  std::optional<double> x(double stamp) {
    const auto pose = frames_.toPlanning("odom", ros::Time(stamp), why_);
    return pose ? std::optional<double>(pose->translation().x()) : std::nullopt;
  }

  tf2::BufferCore buffer_;
  FrameTransformer frames_{buffer_, "map", 0.5};
  std::string why_;
};

TEST_F(FrameTransformerTest, PlanningFrameNeedsNoTf) {
  const auto pose = frames_.toPlanning("/map", ros::Time(3.0), why_);
  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->isApprox(Eigen::Isometry3d::Identity()));
}

TEST_F(FrameTransformerTest, InterpolatesAtTheStamp) {
  send(10.0, 1.0);
  send(11.0, 3.0);
  ASSERT_TRUE(x(10.5));
  EXPECT_NEAR(*x(10.5), 2.0, 1e-9);
}

TEST_F(FrameTransformerTest, ServesStaticTransformsAtAnyTime) {
  send(0.0, 7.0, true);
  ASSERT_TRUE(x(5000.0));
  EXPECT_EQ(*x(5000.0), 7.0);
}

TEST_F(FrameTransformerTest, UsesTheNewestTransformWhileTfLagsALittle) {
  send(10.0, 1.0);
  send(10.1, 2.0);
  ASSERT_TRUE(x(10.4));
  EXPECT_NEAR(*x(10.4), 2.0, 1e-9);
}

TEST_F(FrameTransformerTest, RefusesATransformThatIsTooOld) {
  send(10.0, 1.0);
  send(10.1, 2.0);
  EXPECT_FALSE(x(10.7));
  EXPECT_NE(why_.find("no transform from 'odom' to 'map'"), std::string::npos) << why_;
}

TEST_F(FrameTransformerTest, ZeroStampMeansTheNewest) {
  send(10.0, 1.0);
  send(12.0, 5.0);
  ASSERT_TRUE(x(0.0));
  EXPECT_NEAR(*x(0.0), 5.0, 1e-9);
}

TEST_F(FrameTransformerTest, NamesAnUnknownOrEmptyFrame) {
  EXPECT_FALSE(frames_.toPlanning("nowhere", ros::Time(1.0), why_));
  EXPECT_NE(why_.find("nowhere"), std::string::npos) << why_;
  EXPECT_FALSE(frames_.toPlanning("", ros::Time(1.0), why_));
  EXPECT_EQ(why_, "header.frame_id is empty");
}

}  // namespace
}  // namespace swarm_planner
