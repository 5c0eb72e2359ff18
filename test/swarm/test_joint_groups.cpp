// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Who is planned for at once in a large swarm. If these fail, groups are too large to be solved, or depend on how many
// threads there are, or UAVs that fly by groups collide.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "perfect_flight.hpp"
#include "swarm_planner/swarm/joint_groups.hpp"

namespace swarm_planner {
namespace {

constexpr double kRoundingOfGauge = 1e-6;

/// UAVs that rest, and the groups that they make.
class Resting {
 public:
  explicit Resting(const std::vector<Vector3>& places) : surroundings_(parameters_, places.size(), 0) {
    surroundings_.setEpoch(0.0);
    motions_.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      motions_[i].assignRest(0.0, places[i]);
      surroundings_.setMotions(i, motions_[i], nullptr);
      surroundings_.setPlanning(i, {places[i], Vector3::Zero(), Vector3::Zero()});
      candidates.push_back({true, places[i] + Vector3(0.0, 0.0, 100.0 * static_cast<double>(i))});
    }
    surroundings_.findNeighbours();
  }
  JointGroups groups(std::size_t threads = 1) {
    JointGroups groups(candidates.size());
    ThreadTeam team(threads);
    groups.build(candidates, surroundings_, team);
    return groups;
  }
  JointGroups groupOfAll() {
    JointGroups groups(candidates.size());
    groups.buildOne(candidates, surroundings_);
    return groups;
  }
  /// Distance that two UAVs keep from each other, the margin included [m].
  double distance() const { return surroundings_.pairDistances().horizontal; }

  std::vector<JointGroups::Candidate> candidates;

 private:
  const Parameters parameters_;
  Surroundings surroundings_;
  std::vector<CommittedMotion> motions_;
};

/// Every UAV is in one group, which says so.
void expectPartition(const JointGroups& groups, std::size_t uavs) {
  std::vector<int> seen(uavs);
  for (std::size_t group = 0; group < groups.count(); ++group) {
    EXPECT_LE(groups.size(group), kMostJointUavs);
    for (std::size_t i = 0; i < groups.size(group); ++i) {
      const std::size_t uav = groups.begin(group)[i];
      if (i > 0) {
        EXPECT_LT(groups.begin(group)[i - 1], uav);
      }
      EXPECT_EQ(groups.groupOf(uav), group);
      ++seen[uav];
    }
  }
  EXPECT_EQ(seen, std::vector<int>(uavs, 1));
}

TEST(JointGroups, JoinsThoseThatComeClose) {
  const double close = 0.99 * JointGroups::kStrong, far = 1.01 * JointGroups::kStrong;
  const double d = Resting({Vector3::Zero()}).distance();
  Resting swarm({Vector3(0, 0, 9), Vector3(50, 0, 9), Vector3(close * d, 0, 9), Vector3(50, far * d, 9)});
  const JointGroups groups = swarm.groups();
  expectPartition(groups, 4);
  EXPECT_EQ(groups.count(), 3U);
  EXPECT_EQ(groups.groupOf(0), groups.groupOf(2));
  EXPECT_NE(groups.groupOf(1), groups.groupOf(3));
}

TEST(JointGroups, LeavesOutWhoMayNotBeGroupedAndWhoseEndsAreOne) {
  Resting swarm({Vector3(0, 0, 9), Vector3(2, 0, 9), Vector3(0, 2, 9)});
  EXPECT_EQ(swarm.groups().count(), 1U);
  swarm.candidates[1].may_be_grouped = false;
  EXPECT_EQ(swarm.groups().count(), 2U);
  swarm.candidates[2].end = swarm.candidates[0].end;
  EXPECT_EQ(swarm.groups().count(), 3U);
}

TEST(JointGroups, OneOfAllLeavesOutWhoseEndIsTaken) {
  Resting swarm({Vector3(0, 0, 9), Vector3(20, 0, 9), Vector3(40, 0, 9), Vector3(60, 0, 9), Vector3(80, 0, 9)});
  EXPECT_EQ(swarm.groupOfAll().count(), 1U);
  swarm.candidates[0].may_be_grouped = false;
  swarm.candidates[3].end = swarm.candidates[1].end + Vector3(1, 0, 0);
  const JointGroups groups = swarm.groupOfAll();
  expectPartition(groups, 5);
  EXPECT_EQ(groups.count(), 3U);
  EXPECT_EQ(groups.groupOf(2), groups.groupOf(1));
  EXPECT_EQ(groups.groupOf(4), groups.groupOf(1));
}

TEST(JointGroups, CrowdsBecomeGroupsThatCanBeSolvedForAnyNumberOfThreads) {
  std::vector<Vector3> places;
  for (int i = 0; i < 60; ++i) places.emplace_back(2.1 * (i % 10) + 0.01 * i, 2.3 * (i / 10), 9.0);
  Resting swarm(places);
  const JointGroups groups = swarm.groups(1), threaded = swarm.groups(3);
  expectPartition(groups, places.size());
  EXPECT_LT(groups.count(), places.size() / 2);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(groups.groupOf(i), threaded.groupOf(i));
}

/// UAVs on a circle that change places with their opposites.
Mission swap(int uavs, double radius, int threads) {
  std::vector<Vector3> starts, ends;
  for (int i = 0; i < uavs; ++i) {
    const double angle = 2.0 * M_PI * i / uavs + 0.002 * i * i;
    starts.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 10.0);
    ends.emplace_back(-starts.back().x(), -starts.back().y(), 10.0);
  }
  Mission mission = makeTestMission(starts, ends, 2.0);
  mission.parameters.compute.threads = threads;
  return mission;
}

TEST(JointGroups, SwapPlacesWithoutACollisionTheSameWithSeveralThreads) {
  constexpr int kUavs = 12;
  PerfectFlight flight(swap(kUavs, 12.0, 1), 0.0, PlanningMode::kGroups);
  PerfectFlight threaded(swap(kUavs, 12.0, 3), 0.0, PlanningMode::kGroups);
  for (int cycle = 0; cycle < 40; ++cycle) {
    flight.cycle();
    threaded.cycle();
    for (std::size_t i = 0; i < kUavs; ++i) {
      ASSERT_TRUE(identical(flight.planner().committed(i), threaded.planner().committed(i)))
          << "UAV " << i << ", cycle " << cycle;
    }
  }
  EXPECT_GE(flight.leastPairGauge(), 1.0 - kRoundingOfGauge);
  // Negative control: where nothing is avoided the same flight collides.
  Mission unaware = swap(kUavs, 12.0, 1);
  unaware.parameters.limits.avoidance = false;
  PerfectFlight control(unaware, 0.0, PlanningMode::kGroups);
  control.cycles(40);
  EXPECT_LT(control.leastPairGauge(), 0.9);
}

TEST(JointGroups, WhoMeetsNobodyFliesAsInTurns) {
  PerfectFlight groups(twoAbreast(), 0.0, PlanningMode::kGroups), turns(twoAbreast());
  for (int cycle = 0; cycle < 20; ++cycle) {
    groups.cycle();
    turns.cycle();
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(identical(groups.planner().committed(i), turns.planner().committed(i))) << "cycle " << cycle;
    }
  }
}

TEST(JointGroups, SomebodyMakesProgressWhateverTheBudget) {
  PerfectFlight flight(swap(10, 12.0, 1), 0.0, PlanningMode::kGroups);
  flight.cycles(5);
  std::vector<int> turns(10);
  for (int cycle = 0; cycle < 40; ++cycle) {
    const CycleReport& report = flight.cycle(nullptr, 0.0);
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] += report.uavs[i].overrun ? 0 : 1;
  }
  for (std::size_t i = 0; i < turns.size(); ++i) EXPECT_GT(turns[i], 0) << "UAV " << i;
  EXPECT_GE(flight.leastPairGauge(), 1.0 - kRoundingOfGauge);
}

}  // namespace
}  // namespace swarm_planner
