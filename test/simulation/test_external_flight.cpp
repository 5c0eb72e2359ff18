// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A simulated aircraft of another system that does not fly where its scenario says rehearses nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "swarm_planner/simulation/external_flight.hpp"
#include "swarm_planner/simulation/quad_simulator.hpp"

namespace swarm_planner {
namespace {

ScenarioUav uavAlong(const std::vector<Vector3>& reference, double start, double speed) {
  ScenarioUav uav;
  uav.start = reference.front();
  uav.reference = reference;
  uav.target.start = start;
  uav.target.speed = speed;
  uav.external = true;
  return uav;
}

TEST(ExternalFlight, CommandsTheTargetItself) {
  ExternalFlight flight(uavAlong({Vector3(0, 0, 5), Vector3(20, 0, 5)}, 4.0, 2.0));
  const SetpointTrajectory& setpoints = flight.setpoints(103.0, 100.0);
  EXPECT_EQ(setpoints.epoch, 103.0);
  ASSERT_FALSE(setpoints.points.empty());
  EXPECT_NEAR(setpoints.points.back().time_from_start, ExternalFlight::kHorizon, 1e-9);
  for (const Setpoint& point : setpoints.points) {
    EXPECT_LT((point.p - Vector3(10.0 + 2.0 * point.time_from_start, 0, 5)).norm(), 1e-9);
    EXPECT_LT((point.v - Vector3(2, 0, 0)).norm(), 1e-9);
  }
  EXPECT_LT((flight.setpoints(90.0, 100.0).points.front().p - Vector3(4, 0, 5)).norm(), 1e-9) << "before the start";
}

TEST(ExternalFlight, IsFlownToTheReferencesEnd) {
  ExternalFlight flight(uavAlong({Vector3(0, 0, 5), Vector3(10, 0, 5), Vector3(10, 6, 5)}, 0.0, 2.0));
  QuadSimulator vehicle(Parameters(), Vector3(0, 0, 5), 0);
  vehicle.advanceTo(0.0);
  double farthest = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double now = 0.2 * i;
    ASSERT_TRUE(vehicle.receive(flight.setpoints(now, 0.0)));
    vehicle.advanceTo(now + 0.2);
    farthest = std::max(farthest, vehicle.trackingError());
  }
  EXPECT_LT((vehicle.state().p - Vector3(10, 6, 5)).norm(), 0.01);
  EXPECT_LT(vehicle.state().v.norm(), 0.01);
  EXPECT_LT(farthest, 1.0);
}

}  // namespace
}  // namespace swarm_planner
