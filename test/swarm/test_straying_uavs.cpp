// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A vehicle that does not do what it is told, or that is where it may not be. If these fail others fly into it, or it
// never comes back.
#include <gtest/gtest.h>

#include <algorithm>

#include "perfect_flight.hpp"

namespace swarm_planner {
namespace {

// Its motions leave, over and over again; it hovers, and its odometry trembles a little. The other comes by when that
// has shown: what happens in the first cycles of it is not covered (doc/safety.md), and some distances of its start
// collide.
TEST(StrayingUav, ThatHoversInsteadOfFlyingIsKeptClearOf) {
  const Vector3 place(0, 0, 10);
  const Mission mission = makeTestMission({place, Vector3(-16, 0, 10)}, {Vector3(0, 60, 10), Vector3(14, 0, 10)}, 3.0);
  PerfectFlight flight(mission);
  double least = 1e9;
  double tremble = 0.01;
  for (int i = 0; i < 40; ++i) {
    flight.cycle([&](Snapshot& snapshot) {
      snapshot.uavs[0].p = place + Vector3(0, 0, tremble = -tremble);
      snapshot.uavs[0].v.setZero();
    });
    for (double t = flight.now(); t < flight.now() + 0.3; t += 0.05) {
      least = std::min(least, (flight.vehicle(1, t).p - place).norm());
    }
  }
  EXPECT_GT(least, mission.parameters.limits.pair_distance);
  EXPECT_GT(flight.vehicle(1).p.x(), 5.0) << "it does not get past";
}

// Blown out of the workspace: it may not go farther, and has to be able to come back.
TEST(StrayingUav, OutsideTheWorkspaceComesBack) {
  Mission mission = makeTestMission({Vector3(0, 0, 10)}, {Vector3(60, 0, 10)}, 3.0);
  mission.scenario.workspace = Workspace{Vector3(-5, -5, 2), Vector3(70, 5, 20)};
  PerfectFlight flight(mission);
  flight.cycles(10);
  for (int i = 0; i < 5; ++i) flight.cycle([](Snapshot& snapshot) { snapshot.uavs[0].received = false; });
  const CycleReport& report = flight.cycle([](Snapshot& snapshot) {
    snapshot.uavs[0].p.y() = 9.0;
    snapshot.uavs[0].v.y() = 3.0;
  });
  EXPECT_FALSE(isAlarm(report.uavs[0].reason));
  double farthest = 0.0;
  for (int i = 0; i < 30; ++i) {
    flight.cycle();
    farthest = std::max(farthest, flight.vehicle(0).p.y());
  }
  EXPECT_LT(farthest, 9.0 + 3.0 * 0.3 + 3.0) << "it goes on outwards";
  EXPECT_LT(flight.vehicle(0).p.y(), 5.0);
  EXPECT_EQ(report.uavs[0].state, UavState::kTracking);
}

}  // namespace
}  // namespace swarm_planner
