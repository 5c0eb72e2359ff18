// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A vehicle that does not do what it is told, or that is where it may not be. If these fail others fly into it, or it
// never comes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "perfect_flight.hpp"

namespace swarm_planner {
namespace {

/// The least distance [m] of a UAV that passes from one that hovers where it started: its motions leave, over and over
/// again, its odometry trembles a little. `told`: false for the negative control, odometry that claims what was
/// planned.
double leastDistanceFromTheOneThatHovers(bool told) {
  const Vector3 place(0, 0, 10);
  const Mission mission = makeTestMission({place, Vector3(-14, 0, 10)}, {Vector3(0, 60, 10), Vector3(14, 0, 10)}, 3.0);
  PerfectFlight flight(mission);
  double least = 1e9;
  double tremble = 0.01;
  for (int i = 0; i < 40; ++i) {
    flight.cycle([&](Snapshot& snapshot) {
      if (!told) return;
      snapshot.uavs[0].p = place + Vector3(0, 0, tremble = -tremble);
      snapshot.uavs[0].v.setZero();
    });
    for (double t = flight.now(); t < flight.now() + 0.3; t += 0.05) {
      least = std::min(least, (flight.vehicle(1, t).p - place).norm());
    }
  }
  EXPECT_GT(flight.vehicle(1).p.x(), 5.0) << "it does not get past";
  return least;
}

TEST(StrayingUav, ThatHoversInsteadOfFlyingIsKeptClearOf) {
  EXPECT_GT(leastDistanceFromTheOneThatHovers(true), Parameters().limits.pair_distance);
}

TEST(StrayingUav, ThatNobodyMeasuresIsFlownInto) { EXPECT_LT(leastDistanceFromTheOneThatHovers(false), 1.0); }

/// UAV 0 flies ahead along x and, at x = 9 m, brakes on its own with 3 m/s^2 and hovers; its odometry tells. UAV 1
/// flies in `column` along x behind it, or crosses its way. Returns how close they come, less the pair distance.
double leastRoomBesideAStop(bool column, double noise) {
  const Vector3 start = column ? Vector3(-9, 0, 10) : Vector3(10.5, -20, 10);
  const Vector3 end = column ? Vector3(51, 0, 10) : Vector3(10.5, 40, 10);
  Mission mission = makeTestMission({Vector3(0, 0, 10), start}, {Vector3(60, 0, 10), end}, 3.0);
  mission.parameters.input.odometry_noise = noise;
  PerfectFlight flight(mission);
  std::optional<KinematicState> stop;
  double since = 0.0;
  const auto place = [&](double t) {
    if (!stop) return flight.vehicle(0, t);
    const double left = std::max(stop->v.norm() - 3.0 * (t - since), 0.0);  // of its speed
    const Vector3 heading = stop->v.normalized();
    const double way = (stop->v.squaredNorm() - left * left) / 6.0;
    return KinematicState{stop->p + way * heading, left * heading, Vector3::Zero()};
  };
  double least = 1e9;
  double tremble = 0.001;
  for (int i = 0; i < 40; ++i) {
    if (!stop && flight.vehicle(0).p.x() > 9.0) {
      stop = flight.vehicle(0);
      since = flight.now();
    }
    flight.cycle([&](Snapshot& snapshot) {
      const KinematicState x = place(snapshot.now);
      snapshot.uavs[0].p = x.p + Vector3(0, 0, stop ? tremble = -tremble : 0.0);
      snapshot.uavs[0].v = x.v + Vector3(0, 0, tremble);
    });
    for (double t = flight.now(); t < flight.now() + 0.3; t += 0.05) {
      least = std::min(least, (flight.vehicle(1, t).p - place(t).p).norm());
    }
  }
  EXPECT_TRUE(stop);
  return least - mission.parameters.limits.pair_distance;
}

TEST(StrayingUav, ThatStopsOnItsOwnIsKeptClearOf) {
  for (const bool column : {false, true}) EXPECT_GT(leastRoomBesideAStop(column, 0.15), 0.0) << column;
}

TEST(StrayingUav, IsFlownIntoWhereNoiseMayBeSoLargeThatItDoesNotShow) {
  EXPECT_LT(std::min(leastRoomBesideAStop(false, 20.0), leastRoomBesideAStop(true, 20.0)), 0.0);
}

TEST(StrayingUav, IsToldOfAndItsPlansBeginWhereItIs) {
  PerfectFlight flight(makeTestMission({Vector3(0, 0, 10)}, {Vector3(60, 0, 10)}, 3.0));
  flight.cycles(10);
  const Vector3 place = flight.vehicle(0).p;
  double tremble = 0.001;
  int told = 0;
  for (int i = 0; i < 20; ++i) {
    const CycleReport& report = flight.cycle([&](Snapshot& snapshot) {
      snapshot.uavs[0].p = place + Vector3(0, 0, tremble = -tremble);
      snapshot.uavs[0].v = Vector3(0, 0, tremble);
    });
    told += report.uavs[0].reason == Reason::kNotFollowing ? 1 : 0;
    if (i < 3) continue;
    // Should it fly again, what it is told must not be elsewhere.
    EXPECT_LT((flight.planner().committed(0).at(flight.now()).p - place).norm(), 0.7) << i;
  }
  EXPECT_GT(told, 15);
  flight.cycles(10);
  EXPECT_EQ(flight.planner().report().uavs[0].reason, Reason::kNone) << "it flies again";
}

TEST(StrayingUav, ThatWasPushedIsToldOfAtOnce) {
  PerfectFlight flight(makeTestMission({Vector3(0, 0, 10)}, {Vector3(60, 0, 10)}, 3.0));
  flight.cycles(10);
  const auto pushed = [&flight](double speed) {
    return flight.cycle([speed](Snapshot& snapshot) { snapshot.uavs[0].v.y() += speed; }).uavs[0];
  };
  EXPECT_EQ(pushed(0.3).reason, Reason::kNone) << "that may be noise";
  flight.cycles(5);
  const UavReport report = pushed(1.0);
  EXPECT_EQ(report.reason, Reason::kOffMotion);
  EXPECT_EQ(report.state, UavState::kTracking);
  flight.cycles(2);
  EXPECT_EQ(flight.planner().report().uavs[0].reason, Reason::kNone);
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
