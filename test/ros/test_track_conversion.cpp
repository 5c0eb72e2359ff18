// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: an obstacle that is not avoided, or avoided where it is not.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/track_conversion.hpp"

namespace swarm_planner {
namespace {

constexpr double kNow = 50.0;
constexpr double kTimeout = 1.0;
constexpr double kHalfPi = 1.5707963267948966;

Superellipsoid someBody(int id) {
  return Superellipsoid(id, Vector3(10, 20, 5), Vector3(1, 2, 3), Vector3(2, 2.5, 4), 0.3, Vector3(0, -1, 0.5));
}

ObstacleTrackArray arrayOf(const std::vector<ObstacleTrack>& tracks) {
  ObstacleTrackArray message;
  message.header.stamp = ros::Time(kNow - 0.2);
  message.header.frame_id = "map";
  message.tracks = tracks;
  return message;
}

class TrackConversion : public ::testing::Test {
 protected:
  TrackBatch convert(const ObstacleTrackArray& message) { return convertTracks(message, frames_, kNow, kTimeout); }
  tf2::BufferCore buffer_;
  FrameTransformer frames_{buffer_, "map", kTimeout};
};

TEST_F(TrackConversion, BodySurvivesARoundTrip) {
  ObstacleTrack track = toMessage(someBody(7));
  track.position_sigma = 0.1;
  track.velocity_sigma = 0.2;
  const TrackBatch batch = convert(arrayOf({track}));
  ASSERT_EQ(batch.tracks.size(), 1U);
  EXPECT_TRUE(batch.faults.empty());
  const TrackedObstacle& obstacle = batch.tracks[0];
  EXPECT_EQ(obstacle.shape.id(), 7);
  EXPECT_EQ(obstacle.shape.center(), Vector3(10, 20, 5));
  EXPECT_EQ(obstacle.shape.radii(), Vector3(1, 2, 3));
  EXPECT_EQ(obstacle.shape.exponents(), Vector3(2, 2.5, 4));
  EXPECT_EQ(obstacle.shape.velocity(), Vector3(0, -1, 0.5));
  EXPECT_NEAR(obstacle.shape.yaw(), 0.3, 1e-12);
  EXPECT_NEAR(obstacle.stamp, kNow - 0.2, 1e-6);
  EXPECT_EQ(obstacle.position_sigma, 0.1);
  EXPECT_EQ(obstacle.velocity_sigma, 0.2);
}

TEST_F(TrackConversion, BringsCentreVelocityAndYawIntoThePlanningFrame) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "map";
  transform.child_frame_id = "radar";
  transform.transform.translation = toVector3Message(Vector3(100, 0, 0));
  transform.transform.rotation = toQuaternionMessage(yawRotation(kHalfPi));
  buffer_.setTransform(transform, "test", true);
  ObstacleTrackArray message = arrayOf({toMessage(someBody(1))});
  message.header.frame_id = "radar";
  const TrackBatch batch = convert(message);
  ASSERT_EQ(batch.tracks.size(), 1U);
  EXPECT_TRUE(batch.tracks[0].shape.center().isApprox(Vector3(80, 10, 5), 1e-12));
  EXPECT_TRUE(batch.tracks[0].shape.velocity().isApprox(Vector3(1, 0, 0.5), 1e-12));
  EXPECT_NEAR(batch.tracks[0].shape.yaw(), 0.3 + kHalfPi, 1e-12);
}

TEST_F(TrackConversion, ReplacesATiltedBodyByASphereThatHoldsIt) {
  ObstacleTrack track = toMessage(someBody(1));
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.4, Vector3::UnitX()));
  track.orientation = toQuaternionMessage(tilt);
  const TrackBatch batch = convert(arrayOf({track}));
  ASSERT_EQ(batch.tracks.size(), 1U);
  const Superellipsoid& sphere = batch.tracks[0].shape;
  const Superellipsoid upright = someBody(1);
  // Tips of the tilted body's axes.
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 2, 0), Vector3(0, 0, 3)}) {
    EXPECT_LE(sphere.sum(tilt * axis), 1.0 + 1e-12);
  }
  EXPECT_GE(sphere.radii().minCoeff(), upright.boundingRadius() - 1e-12);
}

struct BadTrack {
  const char* what;
  const char* message;
  std::function<void(ObstacleTrack&)> spoil;
};

TEST_F(TrackConversion, DropsABadTrackAloneAndNamesIt) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<BadTrack> table = {
      {"NaN centre", "centre", [](ObstacleTrack& t) { t.center.x = kNan; }},
      {"infinite velocity", "velocity", [](ObstacleTrack& t) { t.velocity.y = kInfinity; }},
      {"zero radius", "radii", [](ObstacleTrack& t) { t.radii.z = 0.0; }},
      {"negative radius", "radii", [](ObstacleTrack& t) { t.radii.x = -1.0; }},
      {"NaN radius", "radii", [](ObstacleTrack& t) { t.radii.x = kNan; }},
      {"exponent below 2", "exponents", [](ObstacleTrack& t) { t.exponents.y = 1.99; }},
      {"infinite exponent", "exponents", [](ObstacleTrack& t) { t.exponents.y = kInfinity; }},
      {"no orientation", "orientation", [](ObstacleTrack& t) { t.orientation = geometry_msgs::Quaternion(); }},
      {"negative sigma", "standard deviations", [](ObstacleTrack& t) { t.velocity_sigma = -0.1; }},
      {"NaN sigma", "standard deviations", [](ObstacleTrack& t) { t.position_sigma = kNan; }},
      {"absurd centre", "absurd", [](ObstacleTrack& t) { t.center.z = 1e8; }},
      {"absurd velocity", "absurd", [](ObstacleTrack& t) { t.velocity.x = 1e300; }},
      {"absurd radius", "absurd", [](ObstacleTrack& t) { t.radii.x = 1e7; }},
      {"radius of an atom", "absurd", [](ObstacleTrack& t) { t.radii.x = 1e-10; }},
      {"absurd exponent", "absurd", [](ObstacleTrack& t) { t.exponents.x = 1e4; }},
      {"absurd sigma", "absurd", [](ObstacleTrack& t) { t.position_sigma = 1e300; }},
      {"repeated id", "twice", [](ObstacleTrack& t) { t.id = 1; }},
  };
  for (const BadTrack& bad : table) {
    std::vector<ObstacleTrack> tracks = {toMessage(someBody(1)), toMessage(someBody(42)), toMessage(someBody(3))};
    bad.spoil(tracks[1]);
    const TrackBatch batch = convert(arrayOf(tracks));
    ASSERT_EQ(batch.tracks.size(), 2U) << bad.what;
    EXPECT_EQ(batch.tracks[0].shape.id(), 1) << bad.what;
    EXPECT_EQ(batch.tracks[1].shape.id(), 3) << bad.what;
    ASSERT_EQ(batch.faults.size(), 1U) << bad.what;
    EXPECT_NE(batch.faults[0].find(bad.message), std::string::npos) << bad.what << ": " << batch.faults[0];
    const std::string name = "track " + std::to_string(tracks[1].id);
    EXPECT_NE(batch.faults[0].find(name), std::string::npos) << bad.what << ": " << batch.faults[0];
  }
}

TEST_F(TrackConversion, NamesAFewOfManyBadTracksAndCountsAll) {
  ObstacleTrack bad = toMessage(someBody(1));
  bad.center.x = 1e300;
  const TrackBatch batch = convert(arrayOf(std::vector<ObstacleTrack>(100000, bad)));
  EXPECT_TRUE(batch.tracks.empty());
  EXPECT_EQ(batch.faults.size(), TrackBatch::kMostSentences);
  EXPECT_EQ(batch.dropped.of(InputFault::kAbsurd), 100000U);
}

TEST_F(TrackConversion, DropsAMessageOfAnotherTimeOrFrame) {
  ObstacleTrackArray future = arrayOf({toMessage(someBody(1))});
  future.header.stamp = ros::Time(kNow + 1.0);
  ObstacleTrackArray old = arrayOf({toMessage(someBody(1))});
  old.header.stamp = ros::Time(kNow - 3.0);
  ObstacleTrackArray lost = arrayOf({toMessage(someBody(1))});
  lost.header.frame_id = "nowhere";
  for (const ObstacleTrackArray& message : {future, old, lost}) {
    const TrackBatch batch = convert(message);
    EXPECT_TRUE(batch.tracks.empty());
    EXPECT_EQ(batch.faults.size(), 1U);
  }
}

}  // namespace
}  // namespace swarm_planner
