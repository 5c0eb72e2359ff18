// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Trackers lose obstacles, find them late and are never sure where they are. If these fail UAVs fly into what a camera
// did not see for a moment, or into what it saw in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "perfect_flight.hpp"
#include "support/flight_problem.hpp"
#include "swarm_planner/obstacles/track_memory.hpp"

namespace swarm_planner {
namespace {

/// One UAV along x at 3 m/s.
Mission alongX() { return makeTestMission({Vector3(0, 0, 10)}, {Vector3(100, 0, 10)}, 3.0); }

/// The same with a sphere of 2 m in the way.
Mission blockedAlongX() {
  Mission mission = alongX();
  ScenarioObstacle obstacle;
  obstacle.id = 7;
  obstacle.center = Vector3(20.0, 0.5, 10.0);
  obstacle.radii = Vector3::Constant(2.0);
  mission.scenario.obstacles.push_back(obstacle);
  return mission;
}

void loseTracks(Snapshot& snapshot) { snapshot.obstacles.clear(); }

/// Least distance of a motion's curve from where the track says the obstacle is, less `kept` at that age [m].
template <class Kept>
double leastClearance(const CommittedMotion& motion, const TrackedObstacle& track, const Kept& kept) {
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0.0; t <= motion.duration(); t += 0.01) {
    const double age = motion.epoch() + t - track.stamp;
    least = std::min(least, track.shape.movedBy(age).signedDistance(motion.after(t).p) - kept(age));
  }
  return least;
}
double leastDistance(const CommittedMotion& motion, const TrackedObstacle& track) {
  return leastClearance(motion, track, [](double) { return 0.0; });
}

TEST(LostTrack, IsAvoidedAsIfItWereSeen) {
  PerfectFlight seen(blockedAlongX());
  PerfectFlight lost(blockedAlongX());
  for (int cycle = 0; cycle < 40; ++cycle) {
    seen.cycle();
    // The camera sees it in one cycle of four: the track is then up to 0.9 s old.
    lost.cycle(cycle % 4 == 0 ? nullptr : loseTracks);
    ASSERT_TRUE(identical(seen.planner().committed(0), lost.planner().committed(0))) << cycle;
  }
  EXPECT_GT(seen.vehicle(0).p.x(), 25.0) << "it never came to the obstacle";
  EXPECT_GT(lost.leastObstacleDistance(), Parameters().limits.uav_radius);
}

TEST(LostTrack, IsGivenUpWhenItIsTooOld) {
  PerfectFlight flight(blockedAlongX());
  flight.cycles(12);
  const TrackedObstacle track{flight.obstacle(0, flight.now()), flight.now(), 0.0, 0.0};
  EXPECT_GT(leastDistance(flight.planner().committed(0), track), 0.3);
  // The last track came with the last of these cycles, 0.3 s before the next.
  for (int cycle = 0; cycle < 3; ++cycle) {
    flight.cycle(loseTracks);
    EXPECT_GT(leastDistance(flight.planner().committed(0), track), 0.3) << cycle;
  }
  flight.cycle(loseTracks);
  EXPECT_EQ(flight.planner().report().uavs[0].obstacle_clearance, std::numeric_limits<double>::infinity());
  for (int cycle = 0; cycle < 3; ++cycle) flight.cycle(loseTracks);
  EXPECT_LT(leastDistance(flight.planner().committed(0), track), 0.3) << "it still flies round where nothing is";
}

TEST(LostTrack, OfAnArrayThatDoesNotRepeatEveryObstacle) {
  Mission mission = blockedAlongX();
  mission.scenario.obstacles.push_back(mission.scenario.obstacles[0]);
  mission.scenario.obstacles[1].id = 3;
  mission.scenario.obstacles[1].center = Vector3(28.0, -1.0, 10.0);
  PerfectFlight all(mission);
  PerfectFlight alternating(mission);
  all.cycle();
  alternating.cycle();
  for (int cycle = 0; cycle < 40; ++cycle) {
    all.cycle();
    alternating.cycle(
        [cycle](Snapshot& snapshot) { snapshot.obstacles.erase(snapshot.obstacles.begin() + cycle % 2); });
    ASSERT_TRUE(identical(all.planner().committed(0), alternating.planner().committed(0))) << cycle;
  }
  EXPECT_GT(all.vehicle(0).p.x(), 31.0) << "it never came to the obstacles";
}

TEST(LostTrack, OfTheTimeBeforeAResetIsForgotten) {
  PerfectFlight flight(blockedAlongX());
  flight.cycles(10);
  flight.planner().reset();
  flight.cycle(loseTracks);
  EXPECT_EQ(flight.planner().report().uavs[0].obstacle_clearance, std::numeric_limits<double>::infinity());
}

TEST(BadTrack, IsRefusedAndToldAndTheOlderOneStays) {
  PerfectFlight seen(blockedAlongX());
  PerfectFlight spoilt(blockedAlongX());
  seen.cycles(10);
  spoilt.cycles(10);
  EXPECT_EQ(spoilt.planner().report().refused_tracks, 0U);
  for (int cycle = 0; cycle < 3; ++cycle) {
    seen.cycle();
    spoilt.cycle([cycle](Snapshot& snapshot) {
      TrackedObstacle& track = snapshot.obstacles[0];
      if (cycle == 0) track.shape = track.shape.movedBy(std::nan(""));
      if (cycle == 1) track.stamp += 1.0;
      if (cycle == 2) track.position_sigma = std::nan("");
      if (cycle == 2) snapshot.obstacles.push_back(track);
    });
    EXPECT_EQ(spoilt.planner().report().refused_tracks, cycle == 2 ? 2U : 1U);
    // Moved by nothing but time at no velocity: the older one says the same.
    ASSERT_TRUE(identical(seen.planner().committed(0), spoilt.planner().committed(0))) << cycle;
  }
}

TEST(NewTrack, OnTopOfAPlanIsAvoidedInThePlanOfThatCycle) {
  PerfectFlight flight(alongX());
  flight.cycles(15);
  const CommittedMotion before = flight.planner().committed(0);
  TrackedObstacle track;
  track.shape = Superellipsoid(7, before.after(2.1).p + Vector3(0, 0.2, 0), Vector3::Constant(1.0),
                               Vector3::Constant(2.0), 0.0, Vector3::Zero());
  track.stamp = flight.now();
  ASSERT_LT(leastDistance(before, track), 0.0);
  const CycleReport& report = flight.cycle([&track](Snapshot& snapshot) { snapshot.obstacles.push_back(track); });
  ASSERT_TRUE(report.uavs[0].planned);
  EXPECT_EQ(report.uavs[0].reason, Reason::kNone);
  EXPECT_GE(leastDistance(flight.planner().committed(0), track), Parameters().limits.uav_radius);
}

TEST(NewTrack, OnTopOfAUavIsLeftInThePlanOfThatCycleAndTold) {
  PerfectFlight flight(alongX());
  flight.cycles(15);
  TrackedObstacle track;
  const double epoch = flight.now() + Parameters().time.cycle_period;
  track.shape = Superellipsoid(7, flight.vehicle(0, epoch).p + Vector3(0, 0.2, 0), Vector3::Constant(1.0),
                               Vector3::Constant(2.0), 0.0, Vector3::Zero());
  track.stamp = flight.now();
  const CycleReport& report = flight.cycle([&track](Snapshot& snapshot) { snapshot.obstacles.push_back(track); });
  ASSERT_TRUE(report.uavs[0].planned);
  EXPECT_EQ(report.uavs[0].state, UavState::kFallback);
  EXPECT_EQ(report.uavs[0].reason, Reason::kNoSafePlan);
  const CommittedMotion& plan = flight.planner().committed(0);
  for (double t = 1.5; t <= plan.duration(); t += 0.05) {
    EXPECT_GE(track.shape.signedDistance(plan.after(t).p), Parameters().limits.uav_radius) << t;
  }
}

/// Flies past the obstacle with tracks of a standard deviation [m]; returns the least distance from its surface.
double distanceFlownWith(double position_sigma) {
  Mission mission = blockedAlongX();
  mission.parameters.cost.robustness_gain = 0.0;  // the distance demanded alone keeps the UAV off
  PerfectFlight flight(mission);
  for (int cycle = 0; cycle < 60; ++cycle) {
    flight.cycle([position_sigma](Snapshot& snapshot) { snapshot.obstacles[0].position_sigma = position_sigma; });
  }
  EXPECT_GT(flight.vehicle(0).p.x(), 30.0) << "it never passed the obstacle";
  return flight.leastObstacleDistance();
}

TEST(DoubtfulTrack, IsPassedThreeStandardDeviationsFartherOff) {
  const double certain = distanceFlownWith(0.0);
  const double doubtful = distanceFlownWith(0.5);
  const LimitParameters limits = Parameters().limits;
  EXPECT_GE(certain, limits.uav_radius + limits.tracking_margin - 0.01);
  EXPECT_GE(doubtful, limits.uav_radius + limits.tracking_margin + 1.5 - 0.01);
  EXPECT_NEAR(doubtful - certain, 1.5, 0.1);
}

TEST(DoubtfulTrack, IsKeptOffFartherTheLaterAlongAPlan) {
  Mission mission = blockedAlongX();
  mission.scenario.obstacles[0].velocity = Vector3(-0.5, 0.2, 0.0);
  mission.parameters.limits.guide = false;  // guides keep more than is demanded
  PerfectFlight flight(mission);
  const InputParameters& input = mission.parameters.input;
  const double kept = mission.parameters.limits.uav_radius;
  double least_without_growth = std::numeric_limits<double>::infinity();
  for (int cycle = 0; cycle < 60; ++cycle) {
    TrackedObstacle track;
    const CycleReport& report = flight.cycle([&track](Snapshot& snapshot) {
      snapshot.obstacles[0].velocity_sigma = 0.2;
      track = snapshot.obstacles[0];
    });
    if (report.uavs[0].max_slack > 1e-3) continue;
    const TrackInflation inflation = inflationOf(track, input);
    const CommittedMotion& plan = flight.planner().committed(0);
    const double least = leastClearance(plan, track, [&](double age) { return kept + inflation.at(age); });
    EXPECT_GE(least, 0.0) << cycle;
    least_without_growth = std::min(least_without_growth, leastDistance(plan, track) - kept);
  }
  EXPECT_GT(least_without_growth, 0.2);
  EXPECT_LT(least_without_growth, 1.4) << "the flight never came near";
}

}  // namespace
}  // namespace swarm_planner
