// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: an obstacle in the way that is forgotten for the sake of a thousand far ones.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "swarm_planner/obstacles/nearest_tracks.hpp"
#include "swarm_planner/obstacles/track_memory.hpp"

namespace swarm_planner {
namespace {

TrackedObstacle sphere(int id, const Vector3& center, double radius = 1.0, const Vector3& velocity = Vector3::Zero()) {
  TrackedObstacle track;
  track.shape = Superellipsoid(id, center, Vector3::Constant(radius), Vector3::Constant(2.0), 0.0, velocity);
  track.stamp = 10.0;
  return track;
}

std::vector<int> idsOf(const std::vector<TrackedObstacle>& tracks) {
  std::vector<int> ids;
  for (const TrackedObstacle& track : tracks) ids.push_back(track.shape.id());
  return ids;
}

TEST(NearestTracks, KeepsTheNearestToAnyPlaceInTheirOrder) {
  std::vector<TrackedObstacle> tracks{sphere(1, Vector3(50, 0, 0)), sphere(2, Vector3(101, 0, 0)),
                                      sphere(3, Vector3(-3, 0, 0)), sphere(4, Vector3(0, 30, 0))};
  NearestTracks nearest(2, 4);
  EXPECT_EQ(nearest.keep(2, {Vector3::Zero(), Vector3(100, 0, 0)}, tracks), 2U);
  EXPECT_EQ(idsOf(tracks), (std::vector<int>{2, 3}));
  EXPECT_EQ(nearest.keep(2, {Vector3::Zero()}, tracks), 0U) << "no more than may stay";
}

TEST(NearestTracks, LargeAndFastOnesCountByWhatTheyReach) {
  std::vector<TrackedObstacle> tracks{sphere(1, Vector3(20, 0, 0)), sphere(2, Vector3(30, 0, 0), 15.0),
                                      sphere(3, Vector3(0, 40, 0), 1.0, Vector3(0, -5, 0))};
  NearestTracks nearest(1, 3);
  EXPECT_EQ(nearest.keep(2, {Vector3::Zero()}, tracks), 1U);
  EXPECT_EQ(idsOf(tracks), (std::vector<int>{2, 3}));
}

TEST(NearestTracks, WithoutAPlaceTheFirstStay) {
  std::vector<TrackedObstacle> tracks{sphere(7, Vector3(90, 0, 0)), sphere(3, Vector3::Zero()),
                                      sphere(5, Vector3::Zero())};
  NearestTracks nearest(0, 3);
  EXPECT_EQ(nearest.keep(1, {}, tracks), 2U);
  EXPECT_EQ(idsOf(tracks), (std::vector<int>{7}));
}

TEST(NearestTracks, FindsTheNearestPlaceAsComparingAllDoes) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vector3> places;
    for (int i = 0; i < 40; ++i) places.push_back(random.vector(-100.0, 100.0));
    std::vector<TrackedObstacle> tracks;
    for (int i = 0; i < 30; ++i) tracks.push_back(sphere(i, random.vector(-150.0, 150.0)));
    std::vector<std::pair<double, int>> expected;
    for (const TrackedObstacle& track : tracks) {
      double least = 1e9;
      for (const Vector3& place : places) least = std::min(least, (track.shape.center() - place).norm());
      expected.emplace_back(least, track.shape.id());
    }
    std::sort(expected.begin(), expected.end());
    std::vector<int> ids;
    for (int i = 0; i < 10; ++i) ids.push_back(expected[static_cast<std::size_t>(i)].second);
    std::sort(ids.begin(), ids.end());
    NearestTracks nearest(places.size(), tracks.size());
    EXPECT_EQ(nearest.keep(10, places, tracks), 20U);
    EXPECT_EQ(idsOf(tracks), ids);
  }
}

// A tracker that gives every detection a new id.
TEST(NearestTracks, MemoryOfTracksStaysBounded) {
  constexpr std::size_t kCapacity = 8;
  TrackMemory memory(1.0, kCapacity, 1);
  for (int i = 0; i < 1000; ++i) {
    memory.update({sphere(i, Vector3(5.0 + i, 0, 0)), sphere(100000, Vector3(2, 0, 0))}, 10.0);
    memory.keepNearest({Vector3::Zero()});
    ASSERT_LE(memory.tracks().size(), kCapacity);
  }
  EXPECT_EQ(idsOf(memory.tracks()), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 100000}));
}

}  // namespace
}  // namespace swarm_planner
