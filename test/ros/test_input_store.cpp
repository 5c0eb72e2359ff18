// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: planning from inputs that are old, forgotten too early, or of another time.
#include <gtest/gtest.h>

#include <cmath>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/input_store.hpp"

namespace swarm_planner {
namespace {

constexpr double kTrackTimeout = 1.0;
constexpr std::size_t kMaxTracks = 4;

OdometrySample sampleAt(double stamp, double x, double yaw = 0.0) {
  OdometrySample sample;
  sample.stamp = stamp;
  sample.p = Vector3(x, 0, 0);
  sample.orientation = yawRotation(yaw);
  return sample;
}

TrackBatch trackAt(double stamp, int id, double x) {
  TrackBatch batch;
  batch.tracks.emplace_back();
  batch.tracks[0].stamp = stamp;
  batch.tracks[0].shape =
      Superellipsoid(id, Vector3(x, 0, 0), Vector3::Ones(), Vector3::Constant(2), 0.0, Vector3::Zero());
  return batch;
}

class InputStoreTest : public ::testing::Test {
 protected:
  const Snapshot& snapshot(double now) {
    store_.fill(now, snapshot_);
    return snapshot_;
  }
  InputStore store_{2, kTrackTimeout, kMaxTracks};
  Snapshot snapshot_;
};

TEST_F(InputStoreTest, GivesTheNewestSampleOfEachUav) {
  store_.accept(1, sampleAt(10.0, 1.0));
  store_.accept(1, sampleAt(10.2, 2.0));
  store_.accept(1, sampleAt(10.1, 3.0));
  const Snapshot& seen = snapshot(10.3);
  ASSERT_EQ(seen.uavs.size(), 2U);
  EXPECT_FALSE(seen.uavs[0].received);
  ASSERT_TRUE(seen.uavs[1].received);
  EXPECT_EQ(seen.uavs[1].stamp, 10.2);
  EXPECT_EQ(seen.uavs[1].p.x(), 2.0);
}

TEST_F(InputStoreTest, CountsWhatComesOutOfOrder) {
  store_.accept(0, sampleAt(10.2, 2.0));
  store_.accept(0, sampleAt(10.1, 3.0));
  EXPECT_EQ(store_.uavs()[0].accepted, 1U);
  EXPECT_EQ(store_.uavs()[0].dropped.of(InputFault::kOutOfOrder), 1U);
  store_.accept(0, sampleAt(10.2, 4.0));
  EXPECT_EQ(store_.uavs()[0].accepted, 2U) << "again is not out of order";
}

// A cloud comes after its UAV has flown on: what is cut out of it is to be where the UAV was.
TEST_F(InputStoreTest, KnowsWhereUavsWere) {
  EXPECT_TRUE(store_.placesAt(10.0).empty());
  for (int i = 0; i <= 100; ++i) {
    OdometrySample sample = sampleAt(10.0 + 0.02 * i, 3.0 * 0.02 * i);
    sample.v = Vector3(3, 0, 0);
    store_.accept(1, sample);
  }
  for (const double t : {10.313, 11.0, 11.99, 12.1}) {
    ASSERT_EQ(store_.placesAt(t).size(), 1U);
    EXPECT_NEAR(store_.placesAt(t)[0].x(), 3.0 * (t - 10.0), 1e-6) << t;
  }
  EXPECT_NEAR(store_.placesAt(20.0)[0].x(), 6.0 + 3.0 * PlaceHistory::kMostAhead, 1e-6);
  EXPECT_NEAR(store_.placesAt(5.0)[0].x(), 0.0, 1e-6) << "what was first";
  store_.clear();
  EXPECT_TRUE(store_.placesAt(11.0).empty());
}

TEST_F(InputStoreTest, ManyMeasurementsDoNotCrowdOutThePast) {
  for (int i = 0; i <= 20000; ++i) store_.accept(0, sampleAt(10.0 + 1e-4 * i, 1e-4 * i));
  EXPECT_NEAR(store_.placesAt(10.2)[0].x(), 0.2, 1e-6);
  EXPECT_NEAR(store_.placesAt(12.0)[0].x(), 2.0, 1e-6);
}

// Ids that a tracker invents anew in every message, near the UAV and far from it.
TEST_F(InputStoreTest, KeepsTheTracksNearestToTheUavs) {
  store_.accept(0, sampleAt(10.0, 100.0));
  for (int i = 0; i < 20; ++i) store_.accept(trackAt(10.0, i, 10.0 * i));
  EXPECT_EQ(store_.tracks().known, kMaxTracks);
  EXPECT_EQ(store_.tracks().dropped.of(InputFault::kTooMany), 20U - kMaxTracks);
  EXPECT_GT(store_.tracks().crowded, 0U);
  for (const TrackedObstacle& track : snapshot(10.1).obstacles) {
    EXPECT_LE(std::abs(track.shape.center().x() - 100.0), 20.0);
  }
  EXPECT_EQ(store_.uavs()[0].dropped.total(), 0U);
}

TEST_F(InputStoreTest, RejectedMessageChangesNothingButIsKnown) {
  store_.accept(0, sampleAt(10.0, 1.0));
  store_.reject(0, InputFault::kNotFinite, "position is not finite");
  EXPECT_EQ(snapshot(10.1).uavs[0].p.x(), 1.0);
  EXPECT_EQ(store_.uavs()[0].fault, "position is not finite");
  EXPECT_EQ(store_.uavs()[0].dropped.of(InputFault::kNotFinite), 1U);
  store_.accept(0, sampleAt(10.2, 1.5));
  EXPECT_TRUE(store_.uavs()[0].fault.empty());
}

TEST_F(InputStoreTest, SnapshotIsNeverOlderThanItsNewestSample) {
  store_.accept(0, sampleAt(10.04, 1.0));
  EXPECT_EQ(snapshot(10.0).now, 10.04);
  EXPECT_EQ(snapshot(10.5).now, 10.5);
}

// Or the planner would take the track for one from the future.
TEST_F(InputStoreTest, SnapshotIsNeverOlderThanItsNewestTrack) {
  store_.accept(trackAt(10.08, 1, 5.0));
  EXPECT_EQ(snapshot(10.0).now, 10.08);
  EXPECT_EQ(snapshot(10.0).obstacles.size(), 1U);
  EXPECT_EQ(snapshot(10.5).now, 10.5);
}

TEST_F(InputStoreTest, KeepsTheYawOfTheStart) {
  store_.accept(0, sampleAt(10.0, 0.0, 0.4));
  store_.accept(0, sampleAt(10.1, 0.0, 0.9));
  EXPECT_NEAR(store_.uavs()[0].start_yaw, 0.4, 1e-12);
}

TEST_F(InputStoreTest, NewerTracksReplaceOlderOfTheSameId) {
  store_.accept(trackAt(10.0, 1, 5.0));
  store_.accept(trackAt(10.1, 2, 6.0));
  store_.accept(trackAt(10.2, 1, 7.0));
  store_.accept(trackAt(10.1, 1, 8.0));
  const Snapshot& seen = snapshot(10.3);
  ASSERT_EQ(seen.obstacles.size(), 2U);
  EXPECT_EQ(seen.obstacles[0].shape.center().x(), 7.0);
  EXPECT_EQ(seen.obstacles[1].shape.center().x(), 6.0);
}

TEST_F(InputStoreTest, ForgetsTracksAfterTheirTimeout) {
  store_.accept(trackAt(10.0, 1, 5.0));
  store_.accept(trackAt(10.5, 2, 6.0));
  EXPECT_EQ(snapshot(10.9).obstacles.size(), 2U);
  EXPECT_EQ(snapshot(11.2).obstacles.size(), 1U);
  EXPECT_EQ(snapshot(11.6).obstacles.size(), 0U);
  EXPECT_EQ(store_.tracks().known, 0U);
}

TEST_F(InputStoreTest, ClearForgetsInputsOfTheTimeBefore) {
  store_.accept(0, sampleAt(1000.0, 1.0, 0.4));
  store_.accept(trackAt(1000.0, 1, 5.0));
  store_.clear();
  EXPECT_FALSE(snapshot(5.0).uavs[0].received);
  EXPECT_TRUE(snapshot(5.0).obstacles.empty());
  EXPECT_EQ(snapshot(5.0).now, 5.0);
  store_.accept(0, sampleAt(5.1, 2.0, 0.7));
  EXPECT_EQ(snapshot(5.2).uavs[0].p.x(), 2.0);
  EXPECT_NEAR(store_.uavs()[0].start_yaw, 0.7, 1e-12);
}

}  // namespace
}  // namespace swarm_planner
