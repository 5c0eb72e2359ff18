// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Hand-made motions whose figures are known. If these fail, it is wrong how long UAVs needed, how far they flew, or
// which of them were left behind without a reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "swarm_planner/simulation/run_monitor.hpp"

namespace swarm_planner {
namespace {

constexpr double kPeriod = 0.01;

using Motion = std::function<Vector3(double)>;

/// One UAV on a reference along x for `length` [m], its target at 3 m/s, until `duration` [s].
Mission along(double length, double duration) {
  Mission mission;
  ScenarioUav uav;
  uav.reference = {Vector3::Zero(), Vector3(length, 0.0, 0.0)};
  uav.target.speed = 3.0;
  mission.scenario.uavs = {uav};
  mission.scenario.end.duration = duration;
  return mission;
}

/// What the first UAV did; the others stand where they start.
UavFlight flown(const Mission& mission, const Motion& motion, const std::vector<Superellipsoid>& obstacles = {}) {
  RunMonitor monitor(mission);
  std::vector<UavSample> samples(mission.scenario.uavs.size());
  for (std::size_t i = 1; i < samples.size(); ++i) samples[i].p = mission.scenario.uavs[i].start;
  for (int step = 0; !monitor.ended(); ++step) {
    const double t = step * kPeriod;
    samples[0].p = motion(t);
    samples[0].v = (motion(t + 1e-6) - motion(t - 1e-6)) / 2e-6;
    std::vector<Superellipsoid> moved;
    for (const Superellipsoid& obstacle : obstacles) moved.push_back(obstacle.movedBy(t));
    monitor.observe(t, samples, moved);
  }
  return monitor.summary().flights.at(0);
}

Superellipsoid sphereAt(double x, double speed = 0.0) {
  return Superellipsoid(1, Vector3(x, 0.0, 0.0), Vector3::Constant(6.0), Vector3::Constant(2.0), 0.0,
                        Vector3(speed, 0.0, 0.0));
}

TEST(FlightWatch, ArrivalIsWhereTheUavStays) {
  // There at 5 s, blown away from 8 to 12 s, and back.
  const UavFlight flight = flown(along(10.0, 20.0), [](double t) {
    if (t < 5.0) return Vector3(2.0 * t, 0.0, 0.0);
    const double off = t < 8.0 || t > 12.0 ? 0.0 : 2.0 - std::abs(t - 10.0);
    return Vector3(10.0, off, 0.0);
  });
  EXPECT_TRUE(flight.arrived);
  ASSERT_TRUE(flight.arrival_time);
  EXPECT_NEAR(*flight.arrival_time, 11.8, 2.0 * kPeriod);
  EXPECT_NEAR(flight.path_length, 10.0 + 2.0 + 1.8, 0.05);
  EXPECT_NEAR(flight.remaining, 0.2, 0.02);
}

TEST(FlightWatch, WhoDoesNotArriveHasFlownToTheEnd) {
  const UavFlight flight = flown(along(10.0, 20.0), [](double t) { return Vector3(std::min(t, 7.0), 0.0, 0.0); });
  EXPECT_FALSE(flight.arrived);
  EXPECT_FALSE(flight.arrival_time);
  EXPECT_NEAR(flight.path_length, 7.0, 1e-6);
  EXPECT_NEAR(flight.remaining, 3.0, 1e-6);
  EXPECT_NEAR(flight.lag, 3.0, 1e-6);
  EXPECT_FALSE(flight.stuck) << "a lag of 20 m is allowed where no goal ends the run";
}

TEST(FlightWatch, ParkedByAnOccupiedEndCountsFromThenOn) {
  Mission mission = along(10.0, 30.0);
  mission.scenario.uavs.push_back(mission.scenario.uavs.front());
  mission.scenario.uavs[1].start = Vector3(10.0, 0.0, 0.0);
  const UavFlight flight = flown(mission, [](double t) { return Vector3(std::min(t, 7.9), 0.0, 0.0); });
  EXPECT_TRUE(flight.arrived);
  EXPECT_NEAR(*flight.arrival_time, 7.9, 2.0 * kPeriod);
  EXPECT_NEAR(flight.remaining, 2.1, 0.02);
}

TEST(FlightWatch, BehindIsMeasuredFromTheTargetsPlane) {
  // The target is at x = 60 m after 20 s; how far to the side a UAV is does not matter.
  const auto behind = [](const Vector3& at) { return flown(along(1000.0, 20.0), [at](double) { return at; }); };
  EXPECT_NEAR(behind({35.0, 50.0, 0.0}).behind_target, 25.0, 1e-9);
  EXPECT_TRUE(behind({35.0, 50.0, 0.0}).strayed());
  EXPECT_FALSE(behind({41.0, 50.0, 0.0}).strayed());
  EXPECT_TRUE(behind({81.0, 0.0, 0.0}).strayed()) << "ahead is as bad";
  EXPECT_FALSE(behind({41.0, 0.0, 0.0}).strayedWithReason());
}

TEST(FlightWatch, ATargetInsideAnObstacleIsAReason) {
  const Motion standing = [](double) { return Vector3::Zero(); };
  const UavFlight flight = flown(along(1000.0, 20.0), standing, {sphereAt(62.0)});
  EXPECT_TRUE(flight.target_inside);
  EXPECT_FALSE(flight.strayed());
  EXPECT_TRUE(flight.strayedWithReason());
  const UavFlight beside = flown(along(1000.0, 20.0), standing, {sphereAt(67.0)});
  EXPECT_FALSE(beside.target_inside);
  EXPECT_TRUE(beside.strayed());
}

TEST(FlightWatch, HavingLeftAnObstacleIsAReasonForHalfAMinute) {
  // The target leaves the sphere at x = 36 m, after 12 s.
  const Motion standing = [](double) { return Vector3::Zero(); };
  const UavFlight soon = flown(along(1000.0, 40.0), standing, {sphereAt(30.0)});
  EXPECT_FALSE(soon.target_inside);
  ASSERT_TRUE(soon.target_inside_ago);
  EXPECT_NEAR(*soon.target_inside_ago, 28.0, 2.0 * kPeriod);
  EXPECT_TRUE(soon.strayedWithReason());
  const UavFlight later = flown(along(1000.0, 43.0), standing, {sphereAt(30.0)});
  EXPECT_FALSE(later.strayedWithReason());
  EXPECT_TRUE(later.strayed());
}

TEST(FlightWatch, ObstaclesCountWhereTheyAreAtThatTime) {
  // It moves with the target, which is inside all the time though not where the sphere began.
  const UavFlight flight = flown(along(1000.0, 20.0), [](double) { return Vector3::Zero(); }, {sphereAt(3.0, 3.0)});
  EXPECT_TRUE(flight.target_inside);
}

}  // namespace
}  // namespace swarm_planner
