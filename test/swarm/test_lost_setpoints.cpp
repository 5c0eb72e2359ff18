// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A trajectory that does not arrive leaves its vehicle on the one before. If these fail, the next one begins where the
// vehicle is not, or another UAV flies into it.
#include <gtest/gtest.h>

#include <algorithm>

#include "perfect_flight.hpp"

namespace swarm_planner {
namespace {

/// UAV 0 turns a corner, so that its motions differ.
Mission roundACorner(double speed) {
  Mission mission = makeTestMission({Vector3(0, 0, 10)}, {Vector3(12, 0, 10)}, speed);
  mission.scenario.uavs[0].reference.emplace_back(12, 40, 10);
  return mission;
}

/// One UAV whose vehicle follows its motions perfectly, but for those that get lost on the way.
class LossyFlight {
 public:
  explicit LossyFlight(const Mission& mission) : mission_(mission), planner_(mission) {
    flown_.assignRest(0.0, mission.scenario.uavs[0].start);
  }

  /// `arrives`: whether the vehicle gets the new motion; `seen`: whether the planner gets odometry.
  void cycle(bool arrives, bool seen = true) {
    Snapshot snapshot;
    snapshot.now = now_;
    const KinematicState x = flown_.at(now_);
    snapshot.uavs.push_back({seen, now_, x.p, x.v});
    now_ += mission_.parameters.time.cycle_period;
    const CycleReport& report = planner_.plan(snapshot, now_);
    if (report.uavs[0].planned && arrives) flown_ = planner_.committed(0);
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle(true);
  }

  /// How far the newest motion begins from where the vehicle is then [m].
  double gap() const { return (planner_.committed(0).at(now_).p - flown_.at(now_).p).norm(); }
  const CommittedMotion& flown() const { return flown_; }
  SwarmPlanner& planner() { return planner_; }

 private:
  Mission mission_;
  SwarmPlanner planner_;
  CommittedMotion flown_;
  double now_ = 0.0;
};

TEST(LostSetpoints, LeaveNoGapWhereAllArrive) {
  LossyFlight flight(roundACorner(3.0));
  for (int cycle = 0; cycle < 30; ++cycle) {
    flight.cycle(true);
    EXPECT_LT(flight.gap(), 1e-9);
  }
}

// The vehicle flies its old motion on, to its stop; odometry is back when the two are far apart.
TEST(LostSetpoints, AreNoticedByWhereTheVehicleIs) {
  LossyFlight flight(roundACorner(4.5));
  flight.cycles(5);
  flight.cycle(false);
  for (int cycle = 0; cycle < 18; ++cycle) flight.cycle(true, false);
  ASSERT_GT(flight.gap(), 0.6) << "the two motions hardly differ: this shows nothing";
  flight.cycle(false);
  EXPECT_LT(flight.gap(), 1e-6) << "the next plan begins on the motion that was lost";
  EXPECT_EQ(flight.planner().report().uavs[0].state, UavState::kTracking);
}

// Whatever is lost in a row, the newest motion stays so near to the vehicle that others keep clear of it.
TEST(LostSetpoints, ManyInARowDoNotLeaveTheVehicleBehind) {
  double widest = 0.0;
  for (int begin = 5; begin < 20; ++begin) {
    LossyFlight flight(roundACorner(4.0));
    flight.cycles(begin);
    double worst = 0.0;
    for (int lost = 0; lost < 8; ++lost) {
      flight.cycle(false);
      worst = std::max(worst, flight.gap());
    }
    EXPECT_LT(worst, Parameters().limits.tracking_margin) << "lost from cycle " << begin << " on";
    widest = std::max(widest, worst);
  }
  EXPECT_GT(widest, 0.05) << "the motions hardly differ: this shows nothing";
}

}  // namespace
}  // namespace swarm_planner
