// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A cycle that runs out of time must leave every UAV with a motion that is safe, and nobody without a plan for ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "perfect_flight.hpp"

namespace swarm_planner {
namespace {

TEST(Overrun, PlansForOneAndLeavesTheOthersWithTheirMotions) {
  PerfectFlight flight(crossingPair());
  flight.cycles(12);
  std::size_t skipped_before = 2;
  for (int cycle = 0; cycle < 100; ++cycle) {
    const std::vector<CommittedMotion> before{flight.planner().committed(0), flight.planner().committed(1)};
    const CycleReport& report = flight.cycle(nullptr, 0.0);
    EXPECT_TRUE(report.out_of_time);
    ASSERT_NE(report.uavs[0].reason == Reason::kOverrun, report.uavs[1].reason == Reason::kOverrun);
    const std::size_t skipped = report.uavs[0].reason == Reason::kOverrun ? 0 : 1;
    EXPECT_NE(skipped, skipped_before) << "its turn comes first in the next cycle";
    skipped_before = skipped;
    EXPECT_EQ(report.uavs[skipped].state, UavState::kFallback);
    EXPECT_TRUE(report.uavs[skipped].planned) << "its motion is to be published again";
    EXPECT_EQ(report.uavs[skipped].sqp_iterations, 0);
    const CommittedMotion& motion = flight.planner().committed(skipped);
    EXPECT_TRUE(motion.pieces() == 0 || motion.epoch() > report.epoch - motion.dt()) << "what is over is published";
    for (double ahead = 0.0; ahead < 20.0; ahead += 0.7) {
      const double t = report.epoch + ahead;
      ASSERT_LT((flight.planner().committed(skipped).at(t).p - before[skipped].at(t).p).norm(), 1e-9);
    }
  }
  EXPECT_GT(flight.leastPairGauge(), 1.0);
  const CycleReport& report = flight.cycle();
  EXPECT_FALSE(report.out_of_time);
  for (const UavReport& uav : report.uavs) {
    EXPECT_EQ(uav.state, UavState::kTracking);
    EXPECT_LT(std::abs(uav.lag), 1.0) << "planned for in every second cycle it follows its target";
  }
}

TEST(Overrun, OfTheFirstCycleLeavesNothingToPublish) {
  PerfectFlight flight(twoAbreast());
  const CycleReport& first = flight.cycle(nullptr, 0.0);
  EXPECT_TRUE(first.uavs[0].planned);
  EXPECT_EQ(first.uavs[1].reason, Reason::kOverrun);
  EXPECT_FALSE(first.uavs[1].planned);
  for (const UavReport& uav : flight.cycle().uavs) EXPECT_EQ(uav.state, UavState::kTracking);
}

TEST(Overrun, IsNotSaidOfAUavWithoutOdometryWhoseTurnGoesToAnother) {
  PerfectFlight flight(twoAbreast());
  flight.cycles(3);
  const CycleReport& report = flight.cycle([](Snapshot& snapshot) { snapshot.uavs[0].received = false; }, 0.0);
  EXPECT_EQ(report.uavs[0].reason, Reason::kWaitingForOdometry);
  EXPECT_EQ(report.uavs[1].reason, Reason::kNone);
  EXPECT_FALSE(report.out_of_time);
}

/// Pairs that hover close beside each other, far from all other pairs.
Mission hoveringPairs(int pairs) {
  std::vector<Vector3> places;
  for (int i = 0; i < 2 * pairs; ++i) places.emplace_back(100.0 * (i / 2), i % 2 == 0 ? 0.0 : 6.0, 10.0);
  return makeTestMission(places, places, 0.0);
}

// Budgets that are enough for a few UAVs only: whoever was skipped earliest in the order comes first in the next cycle.
// By that everyone has its turn, whatever the neighbourhood makes of the order.
TEST(Overrun, LetsThoseWhoWereSkippedComeFirst) {
  PerfectFlight flight(hoveringPairs(8));
  constexpr std::size_t kCount = 16;
  flight.cycles(2);
  double budget = flight.planner().report().cycle_time;
  std::size_t first = 0;
  std::vector<int> turns(kCount, 0);
  int partial = 0;
  for (int cycle = 0; cycle < 5000 && partial < 100; ++cycle) {
    const CycleReport& report = flight.cycle(nullptr, budget);
    std::vector<std::size_t> skipped;
    for (std::size_t turn = 0; turn < kCount; ++turn) {
      const std::size_t uav = (first + turn) % kCount;
      if (report.uavs[uav].reason == Reason::kOverrun) skipped.push_back(uav);
    }
    ASSERT_EQ(report.out_of_time, !skipped.empty());
    if (skipped.size() == kCount) {
      budget *= 1.3;
      continue;
    }
    ASSERT_NE(report.uavs[first].reason, Reason::kOverrun) << "UAV " << first << " was skipped twice";
    // About three of them, less than a round.
    budget *= skipped.size() < kCount - 3 ? 0.8 : 1.02;
    if (skipped.empty()) continue;
    ++partial;
    for (std::size_t i = 0; i < kCount; ++i) turns[i] += report.uavs[i].reason == Reason::kOverrun ? 0 : 1;
    first = skipped.front();
  }
  ASSERT_EQ(partial, 100) << "no budget was found that is enough for some";
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_GE(turns[i], 100 / static_cast<int>(kCount)) << "UAV " << i;
}

// What its motion was checked against is not what is seen now: it does not fly on into that.
TEST(Overrun, DoesNotKeepAUavFromBraking) {
  for (const bool appears : {true, false}) {
    Mission mission = twoAbreast();
    PerfectFlight flight(mission);
    flight.cycles(10);
    const auto see = [&](Snapshot& snapshot) {
      if (!appears) return;
      for (std::size_t i = 0; i < 2; ++i) {
        const Vector3 ahead = flight.vehicle(i).p + Vector3(9, 0, 0);
        const Vector3 two = Vector3::Constant(2.0);
        snapshot.obstacles.push_back(
            {Superellipsoid(static_cast<int>(i), ahead, two, two, 0.0, Vector3::Zero()), snapshot.now});
      }
    };
    const CycleReport& report = flight.cycle(see, 0.0);
    ASSERT_TRUE(report.out_of_time);
    const std::size_t skipped = report.uavs[0].overrun ? 0 : 1;
    ASSERT_TRUE(report.uavs[skipped].overrun);
    EXPECT_EQ(report.uavs[skipped].reason, appears ? Reason::kBraking : Reason::kOverrun);
    const CommittedMotion& motion = flight.planner().committed(skipped);
    EXPECT_EQ((motion.restingPlace() - flight.vehicle(skipped).p).norm() < 6.0, appears);
  }
}

}  // namespace
}  // namespace swarm_planner
