// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Swarms in which UAVs block each other's ways, in closed loop. If these fail, some wait for good; each flight has its
// negative control without the rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "perfect_flight.hpp"
#include "support/random.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "tight_places.hpp"

namespace swarm_planner {
namespace {

constexpr double kArrived = 0.2;  // [m]
constexpr double kCell = 2.6;     // [m]

Mission without(Mission mission) {
  mission.parameters.limits.right_of_way = false;
  return mission;
}

int arrivedOf(const PerfectFlight& flight, const Mission& mission) {
  int count = 0;
  for (std::size_t i = 0; i < mission.scenario.uavs.size(); ++i) {
    count += (flight.vehicle(i).p - mission.scenario.uavs[i].reference.back()).norm() <= kArrived ? 1 : 0;
  }
  return count;
}

/// Flies up to `seconds` until all have arrived.
int arrivedAfter(const Mission& mission, double seconds) {
  PerfectFlight flight(mission);
  const int all = static_cast<int>(mission.scenario.uavs.size());
  for (double t = 0.0; t < seconds && arrivedOf(flight, mission) < all; t += mission.parameters.time.cycle_period) {
    flight.cycle();
  }
  EXPECT_GE(flight.leastPairGauge(), 1.0);
  EXPECT_GE(flight.leastObstacleDistance(), mission.parameters.limits.uav_radius);
  return arrivedOf(flight, mission);
}

/// Guides would lead round what blocks by themselves: without them it is the rule alone that is tested.
Mission unguided(Mission mission) {
  mission.parameters.limits.guide = false;
  return mission;
}

/// Places in a square room, `side` in a row, that have a little more room than UAVs need.
std::vector<Vector3> roomCells(int side) {
  std::vector<Vector3> cells;
  for (int i = 0; i < side * side; ++i) cells.emplace_back(kCell * (i % side), kCell * (i / side), 5.0);
  return cells;
}

Workspace roomAround(int side) {
  const double end = kCell * (side - 1) + 1.5;
  return {Vector3(-1.5, -1.5, 4.2), Vector3(end, end, 5.8)};
}

void shuffle(std::vector<Vector3>& cells, Random& random) {
  for (std::size_t i = cells.size() - 1; i > 0; --i) {
    std::swap(cells[i], cells[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
  }
}

/// Whether some UAV gives way to one that gives way, and so on, to itself: none of them would ever be past.
bool givesWayInACircle(const CycleReport& report) {
  for (std::size_t i = 0; i < report.uavs.size(); ++i) {
    std::size_t next = i;
    for (std::size_t steps = 0; report.uavs[next].reason == Reason::kGivesWay && steps < report.uavs.size(); ++steps) {
      next = report.uavs[next].partner;
      if (next == i) return true;
    }
  }
  return false;
}

TEST(RightOfWay, ThroughAnOpeningThatFitsOneBothWays) {
  EXPECT_EQ(arrivedAfter(throughTheOpening(6), 40.0), 6);
  EXPECT_LT(arrivedAfter(without(throughTheOpening(6)), 40.0), 6);
}

TEST(RightOfWay, HeadOnInALaneOneBacksOut) {
  EXPECT_EQ(arrivedAfter(headOnInALane(), 90.0), 2);
  EXPECT_EQ(arrivedAfter(without(headOnInALane()), 90.0), 0);
}

// Nobody is nearer than the others, and nobody can get any nearer.
TEST(RightOfWay, OfSeveralSentToOnePlaceOneGetsThereAndTheOthersParkBesideIt) {
  constexpr int kUavs = 8;
  std::vector<Vector3> starts;
  for (int i = 0; i < kUavs; ++i) {
    starts.emplace_back(10.0 * std::cos(2.0 * M_PI * i / kUavs), 10.0 * std::sin(2.0 * M_PI * i / kUavs), 10.0);
  }
  const Mission mission = unguided(makeTestMission(starts, std::vector<Vector3>(kUavs, Vector3(0, 0, 10)), 4.0));
  PerfectFlight flight(mission);
  flight.cycles(100);
  EXPECT_EQ(arrivedOf(flight, mission), 1);
  int parked = 0;
  for (const UavReport& uav : flight.planner().report().uavs) {
    if (uav.reason != Reason::kParked) continue;
    ++parked;
    EXPECT_EQ(uav.state, UavState::kTracking);
    EXPECT_LT((flight.vehicle(uav.partner).p - Vector3(0, 0, 10)).norm(), 2.5);
  }
  EXPECT_EQ(parked, kUavs - 1);
  // Calm.
  std::vector<Vector3> places;
  for (std::size_t i = 0; i < kUavs; ++i) places.push_back(flight.vehicle(i).p);
  flight.cycles(60);
  for (std::size_t i = 0; i < kUavs; ++i) EXPECT_LT((flight.vehicle(i).p - places[i]).norm(), 0.1) << i;

  PerfectFlight heedless(without(mission));
  heedless.cycles(100);
  for (const UavReport& uav : heedless.planner().report().uavs) EXPECT_NE(uav.reason, Reason::kParked);
}

TEST(RightOfWay, AUavThatHasArrivedMovesAsideAndComesBack) {
  Mission mission = headOnInALane();
  mission.scenario.uavs[1].start = Vector3(11.0, 0, 5);
  mission.scenario.uavs[1].reference = {Vector3(11.0, 0, 5)};
  PerfectFlight flight(mission);
  bool gave_way = false;
  bool was_past = false;
  for (int cycle = 0; cycle < 200; ++cycle) {
    const UavReport& parked = flight.cycle().uavs[1];
    gave_way = gave_way || (parked.reason == Reason::kGivesWay && parked.partner == 0);
    was_past = was_past || flight.vehicle(0).p.x() > 15.0;
  }
  EXPECT_TRUE(gave_way);
  EXPECT_TRUE(was_past);
  EXPECT_EQ(arrivedOf(flight, mission), 2);
  EXPECT_EQ(arrivedAfter(without(mission), 60.0), 1);
}

// A command goes before the rule.
TEST(RightOfWay, AUavOnHoldStaysAndTheOtherSaysBehindWhomItWaits) {
  Mission mission = headOnInALane();
  mission.scenario.uavs[1].start = Vector3(6.0, 0, 5);
  mission.scenario.uavs[1].reference = {Vector3(6.0, 0, 5)};
  PerfectFlight flight(mission);
  flight.cycles(5);
  flight.planner().command(1, FlightCommand::kHold);
  flight.cycles(60);
  EXPECT_LT((flight.vehicle(1).p - Vector3(6.0, 0, 5)).norm(), 0.3);
  const UavReport& waiting = flight.planner().report().uavs[0];
  EXPECT_EQ(waiting.reason, Reason::kWaits);
  EXPECT_EQ(waiting.partner, 1U);
  EXPECT_EQ(waiting.state, UavState::kTracking);
}

// Two targets in one box: the UAVs wait outside of it, and not for each other.
TEST(RightOfWay, ATargetInsideAnObstacleIsNoDeadlock) {
  Mission mission =
      makeTestMission({Vector3(-12, 0, 10), Vector3(12, 0, 10)}, {Vector3(-1, 0, 10), Vector3(1, 0, 10)}, 3.0);
  mission.scenario.obstacles.push_back(box(Vector3(0, 0, 10), Vector3::Constant(3.0)));
  PerfectFlight flight(mission);
  flight.cycles(40);
  const std::array<Vector3, 2> places{flight.vehicle(0).p, flight.vehicle(1).p};
  for (int cycle = 0; cycle < 100; ++cycle) {
    for (const UavReport& uav : flight.cycle().uavs) EXPECT_FALSE(isTraffic(uav.reason));
  }
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((flight.vehicle(i).p - places[i]).norm(), 0.1) << i;
}

// They stand exactly symmetrically around the point through which all want to go, as a restart may find them.
TEST(RightOfWay, ASymmetricRingDissolves) {
  for (const int uavs : {4, 6, 8}) {
    std::vector<Vector3> starts;
    std::vector<Vector3> ends;
    const double radius = 1.15 / std::sin(M_PI / uavs);
    for (int i = 0; i < uavs; ++i) {
      const Vector3 unit(std::cos(2.0 * M_PI * i / uavs), std::sin(2.0 * M_PI * i / uavs), 0.0);
      starts.push_back(radius * unit + Vector3(0, 0, 10));
      ends.push_back(-20.0 * unit + Vector3(0, 0, 10));
    }
    EXPECT_EQ(arrivedAfter(makeTestMission(starts, ends, 3.0), 60.0), uavs);
  }
}

// Where nobody is held up for long nothing changes, bit by bit.
TEST(RightOfWay, LeavesFlightsAloneThatGetOn) {
  const Mission mission = makeMission(circleSwap(6, 8.0, 1), {}, "circle_swap");
  PerfectFlight with(mission);
  PerfectFlight heedless(without(mission));
  for (int cycle = 0; cycle < 40; ++cycle) {
    with.cycle();
    heedless.cycle();
    for (std::size_t i = 0; i < 6; ++i) {
      ASSERT_TRUE(identical(with.planner().committed(i), heedless.planner().committed(i))) << cycle << " " << i;
    }
  }
}

TEST(RightOfWay, IsTheSameForAnyNumberOfThreads) {
  Mission mission = unguided(throughTheOpening(5));
  PerfectFlight alone(mission);
  mission.parameters.compute.threads = 3;
  PerfectFlight team(mission);
  int gave_way = 0;
  for (int cycle = 0; cycle < 110; ++cycle) {
    for (const UavReport& uav : alone.cycle().uavs) gave_way += uav.reason == Reason::kGivesWay ? 1 : 0;
    team.cycle();
    for (std::size_t i = 0; i < 5; ++i) {
      ASSERT_TRUE(identical(alone.planner().committed(i), team.planner().committed(i))) << cycle << " " << i;
    }
  }
  EXPECT_GT(gave_way, 5) << "nobody gives way: this shows nothing";
}

// Everybody is sent somewhere else in a room that is hardly larger than they are, again and again.
TEST(RightOfWay, NobodyStarvesInACrowdedRoom) {
  constexpr int kUavs = 9;
  Random random(7);
  std::vector<Vector3> cells = roomCells(4);
  shuffle(cells, random);
  Mission mission =
      makeTestMission({cells.begin(), cells.begin() + kUavs}, {cells.begin(), cells.begin() + kUavs}, 3.0);
  mission.scenario.workspace = roomAround(4);
  PerfectFlight flight(mission);
  flight.cycle();
  for (int round = 0; round < 12; ++round) {
    shuffle(cells, random);
    for (std::size_t i = 0; i < kUavs; ++i) {
      flight.planner().setReference(i, {flight.vehicle(i).p, cells[i]}, 0.0, 3.0);
      mission.scenario.uavs[i].reference = {cells[i]};
    }
    for (int cycle = 0; cycle < 400 && arrivedOf(flight, mission) < kUavs; ++cycle) flight.cycle();
    EXPECT_EQ(arrivedOf(flight, mission), kUavs) << "round " << round;
  }
  EXPECT_GE(flight.leastPairGauge(), 1.0);
}

// A UAV that is past, asked by one that still gives way to it, or one that lets out whoever gives way to it: both would
// wait until their patience ends.
TEST(RightOfWay, NobodyGivesWayInACircle) {
  for (const auto& [side, seed] : {std::pair(5, 1U), std::pair(7, 13U)}) {
    Random random(seed);
    std::vector<Vector3> starts = roomCells(side);
    shuffle(starts, random);
    std::vector<Vector3> ends = starts;
    shuffle(ends, random);
    const auto uavs = static_cast<std::ptrdiff_t>(0.6 * static_cast<double>(starts.size()));
    Mission mission =
        makeTestMission({starts.begin(), starts.begin() + uavs}, {ends.begin(), ends.begin() + uavs}, 3.0);
    mission.scenario.workspace = roomAround(side);
    PerfectFlight flight(mission);
    std::ptrdiff_t gave_way = 0;
    for (int cycle = 0; cycle < 100; ++cycle) {
      const CycleReport& report = flight.cycle();
      ASSERT_FALSE(givesWayInACircle(report)) << side << " " << cycle;
      gave_way += std::count_if(report.uavs.begin(), report.uavs.end(),
                                [](const UavReport& uav) { return uav.reason == Reason::kGivesWay; });
    }
    EXPECT_GT(gave_way, 100) << "hardly anybody gives way: this shows nothing";
  }
}

}  // namespace
}  // namespace swarm_planner
