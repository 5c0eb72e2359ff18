// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What is forgotten here too early is flown through; what is remembered too long blocks the way; one bad track that is
// taken over spoils the plans of all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "support/random.hpp"
#include "swarm_planner/obstacles/track_memory.hpp"

namespace swarm_planner {
namespace {

constexpr double kTimeout = 1.0;

/// A unit sphere at (x, 0, 0); x tells tracks of one id apart.
TrackedObstacle trackOf(int id, double stamp, double x = 0.0) {
  TrackedObstacle track;
  track.shape =
      Superellipsoid(id, Vector3(x, 0, 0), Vector3::Ones(), Vector3::Constant(2.0), 0.0, Vector3(1.0, 0.0, 0.0));
  track.stamp = stamp;
  return track;
}

class TrackMemoryTest : public ::testing::Test {
 protected:
  /// Position of the obstacle's track, NaN if it is not known.
  double positionOf(int id) const {
    for (const TrackedObstacle& track : memory_.tracks()) {
      if (track.shape.id() == id) return track.shape.center().x();
    }
    return std::nan("");
  }
  bool knows(int id) const { return !std::isnan(positionOf(id)); }

  TrackMemory memory_{kTimeout, 8};
};

TEST_F(TrackMemoryTest, RemembersATrackThatIsNotReportedAnyMoreUntilItIsTooOld) {
  memory_.update({trackOf(1, 10.0), trackOf(2, 10.0)}, 10.1);
  memory_.update({trackOf(2, 10.4)}, 10.5);
  EXPECT_TRUE(knows(1));
  memory_.update({}, 10.99);
  EXPECT_TRUE(knows(1));
  memory_.update({}, 11.01);
  EXPECT_FALSE(knows(1));
  EXPECT_TRUE(knows(2)) << "it was seen later";
  memory_.forget(11.41);
  EXPECT_TRUE(memory_.tracks().empty());
}

TEST_F(TrackMemoryTest, ForgetsATrackThatIsReportedForTooLong) {
  const std::vector<TrackedObstacle> frozen{trackOf(1, 10.0)};
  memory_.update(frozen, 10.9);
  EXPECT_TRUE(knows(1));
  memory_.update(frozen, 11.1);
  EXPECT_FALSE(knows(1));
  memory_.update({trackOf(1, 11.2)}, 11.3);
  EXPECT_TRUE(knows(1)) << "a track that comes back counts again";
}

TEST_F(TrackMemoryTest, KeepsTheLatestStampOfAnId) {
  memory_.update({trackOf(1, 10.0, 5.0)}, 10.0);
  memory_.update({trackOf(1, 10.2, 6.0)}, 10.3);
  EXPECT_EQ(positionOf(1), 6.0);
  memory_.update({trackOf(1, 10.1, 7.0)}, 10.4);
  EXPECT_EQ(positionOf(1), 6.0) << "an overtaken message";
  memory_.update({trackOf(1, 10.2, 8.0)}, 10.5);
  EXPECT_EQ(positionOf(1), 6.0) << "the same message again";
  EXPECT_EQ(memory_.tracks().size(), 1U);
  EXPECT_EQ(memory_.refused(), 0U);
}

TEST_F(TrackMemoryTest, TakesTheLatestOfAnIdThatComesTwiceAtOnce) {
  memory_.update({trackOf(1, 10.1, 5.0), trackOf(1, 10.2, 6.0), trackOf(1, 10.0, 7.0)}, 10.2);
  EXPECT_EQ(positionOf(1), 6.0);
  memory_.update({trackOf(2, 10.2, 8.0), trackOf(2, 10.2, 9.0)}, 10.2);
  EXPECT_EQ(positionOf(2), 8.0) << "the first of equal stamps";
  EXPECT_EQ(memory_.tracks().size(), 2U);
}

TEST_F(TrackMemoryTest, RefusesWhatIsNotFiniteAndKeepsTheOlder) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  memory_.update({trackOf(1, 10.0, 5.0)}, 10.0);
  std::vector<TrackedObstacle> bad(9, trackOf(1, 10.1, 6.0));
  bad[0].stamp = kNan;
  bad[1].stamp = -kInfinity;
  bad[2].stamp = kInfinity;
  bad[3].shape = bad[3].shape.movedBy(kInfinity);
  bad[4].shape = bad[4].shape.movedBy(kNan);
  bad[5].position_sigma = kNan;
  bad[6].position_sigma = -0.1;
  bad[7].velocity_sigma = kInfinity;
  bad[8].velocity_sigma = -0.1;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    memory_.update({bad[i]}, 10.1);
    EXPECT_EQ(memory_.refused(), 1U) << i;
    ASSERT_EQ(memory_.tracks().size(), 1U) << i;
    EXPECT_EQ(positionOf(1), 5.0) << i;
  }
  bad.push_back(trackOf(2, 10.1, 7.0));
  memory_.update(bad, 10.1);
  EXPECT_EQ(memory_.refused(), 9U);
  EXPECT_EQ(positionOf(2), 7.0) << "the good one beside bad ones counts";
  memory_.update({trackOf(1, 10.1, 8.0)}, 10.1);
  EXPECT_EQ(memory_.refused(), 0U);
  EXPECT_EQ(positionOf(1), 8.0) << "a good one follows";
}

// A stamp far ahead would hold out against every later track of its id.
TEST_F(TrackMemoryTest, RefusesTheFuture) {
  memory_.update({trackOf(1, 10.0, 5.0)}, 10.0);
  memory_.update({trackOf(1, 10.1 + kClockTolerance + 0.001, 6.0)}, 10.1);
  EXPECT_EQ(memory_.refused(), 1U);
  EXPECT_EQ(positionOf(1), 5.0);
  memory_.update({trackOf(1, 10.1 + kClockTolerance - 0.001, 7.0)}, 10.1);
  EXPECT_EQ(memory_.refused(), 0U);
  EXPECT_EQ(positionOf(1), 7.0) << "clocks disagree a little";
}

TEST_F(TrackMemoryTest, ForgetsTheTimeBeforeAReset) {
  memory_.update({trackOf(1, 1000.0, 5.0)}, 1000.0);
  memory_.reset();
  EXPECT_TRUE(memory_.tracks().empty());
  memory_.update({trackOf(1, 10.0, 6.0)}, 10.0);
  EXPECT_EQ(positionOf(1), 6.0);
}

// Against the rule spelled out on a map. The order must not depend on that of arrival: the plans depend on it.
TEST_F(TrackMemoryTest, FollowsTheRuleWhateverComesInAnyOrder) {
  Random random(1);
  std::map<int, TrackedObstacle> expected;
  std::size_t most = 0;
  for (int n = 0; n < 3000; ++n) {
    const double now = 10.0 + 0.1 * n;
    std::vector<TrackedObstacle> tracks;
    for (int i = random.integer(0, 12); i > 0; --i) {
      const double stamp = now - 0.1 * random.integer(-1, 12);
      tracks.push_back(trackOf(random.integer(-20, 20), stamp, random.uniform(-1.0, 1.0)));
    }
    for (const TrackedObstacle& track : tracks) {
      if (track.stamp > now + kClockTolerance) continue;
      const auto entry = expected.try_emplace(track.shape.id(), track).first;
      if (track.stamp > entry->second.stamp) entry->second = track;
    }
    for (auto entry = expected.begin(); entry != expected.end();) {
      entry = now - entry->second.stamp > kTimeout ? expected.erase(entry) : std::next(entry);
    }
    memory_.update(tracks, now);
    ASSERT_EQ(memory_.tracks().size(), expected.size());
    auto entry = expected.begin();
    for (const TrackedObstacle& track : memory_.tracks()) {
      ASSERT_EQ(track.shape.id(), entry->first);
      ASSERT_EQ(track.stamp, entry->second.stamp);
      ASSERT_EQ(track.shape.center(), entry->second.shape.center());
      ++entry;
    }
    most = std::max(most, expected.size());
  }
  EXPECT_GT(most, 15U);
}

TEST(TrackInflation, GrowsWithTheAgeUntilItsEnd) {
  InputParameters input;
  input.track_sigmas = 3.0;
  input.track_growth_time = 2.0;
  TrackedObstacle track = trackOf(1, 10.0);
  EXPECT_EQ(inflationOf(track, input).at(5.0), 0.0) << "a track without doubt";
  track.position_sigma = 0.5;
  track.velocity_sigma = 0.1;
  const TrackInflation inflation = inflationOf(track, input);
  EXPECT_DOUBLE_EQ(inflation.at(-1.0), 1.5);
  EXPECT_DOUBLE_EQ(inflation.at(0.0), 1.5);
  EXPECT_DOUBLE_EQ(inflation.at(1.0), 1.8);
  EXPECT_DOUBLE_EQ(inflation.at(2.0), 2.1);
  EXPECT_DOUBLE_EQ(inflation.at(7.0), 2.1);
}

}  // namespace
}  // namespace swarm_planner
