// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Flown paths are measured against the shortest ones: a reference that is too long would flatter the planner, one that
// leads through an obstacle would blame it for nothing. Lengths are compared with geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "swarm_planner/experiments/flight_bounds.hpp"
#include "swarm_planner/experiments/shortest_path.hpp"

namespace swarm_planner {
namespace {

constexpr double kRadius = 0.3;
constexpr double kCell = 0.15;
const Workspace kBox{{-8.0, -8.0, 0.0}, {8.0, 8.0, 4.0}};

Superellipsoid column(double x, double y, double radius) {
  return Superellipsoid(1, Vector3(x, y, 2.0), Vector3(radius, radius, 20.0), Vector3(2.0, 2.0, 8.0), 0.0,
                        Vector3::Zero());
}

Superellipsoid box(const Vector3& center, const Vector3& radii) {
  return Superellipsoid(2, center, radii, Vector3::Constant(40.0), 0.0, Vector3::Zero());
}

double shortest(const FreeSpace& space, const Vector3& start, const Vector3& goal) {
  ShortestPath search(space, kCell);
  const std::vector<Vector3> path = search.find(start, goal);
  if (path.empty()) return std::numeric_limits<double>::infinity();
  EXPECT_EQ(path.front(), start);
  EXPECT_EQ(path.back(), goal);
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (double t = 0.0; t <= 1.0; t += 0.02)
      EXPECT_GT(space.clearance(path[i - 1] + t * (path[i] - path[i - 1])), -1e-3);
  }
  return lengthOf(path);
}

TEST(ShortestPath, IsStraightWhereNothingIsInTheWay) {
  const FreeSpace space({column(0.0, 3.0, 1.0)}, kRadius, kBox);
  EXPECT_DOUBLE_EQ(shortest(space, {-5.0, 0.0, 2.0}, {5.0, 0.0, 2.0}), 10.0);
}

TEST(ShortestPath, WindsRoundAColumn) {
  const FreeSpace space({column(0.0, 0.0, 1.0)}, kRadius, kBox);
  const double reach = 1.0 + kRadius, far = 5.0;
  const double expected = 2.0 * std::sqrt(far * far - reach * reach) + reach * (M_PI - 2.0 * std::acos(reach / far));
  const double length = shortest(space, {-far, 0.0, 2.0}, {far, 0.0, 2.0});
  EXPECT_GT(length, expected - 1e-3);
  EXPECT_LT(length, 1.001 * expected);
}

TEST(ShortestPath, GoesOverWhatIsTooBroad) {
  const FreeSpace space({box({0.0, 0.0, 0.0}, {0.5, 20.0, 2.0})}, kRadius, kBox);
  // Up and down over a wall with its top at 2 m: tangents to the rounded edges 0.5 m before and behind its middle.
  const double length = shortest(space, {-5.0, 0.0, 1.0}, {5.0, 0.0, 1.0});
  const double outside = 2.0 * std::hypot(4.5, 1.3) + 1.0, inside = 2.0 * std::hypot(4.5, 1.0) + 1.0;
  EXPECT_LT(length, outside);
  EXPECT_GT(length, inside);
}

TEST(ShortestPath, TakesTheShorterSideEvenIfItLooksWorseAtFirst) {
  // The wall's middle is at y = 1: round its lower end it is shorter, though the upper one is not much farther.
  const FreeSpace space({box({0.0, 1.0, 2.0}, {0.2, 3.0, 20.0})}, kRadius, kBox);
  const double length = shortest(space, {-5.0, 0.0, 2.0}, {5.0, 0.0, 2.0});
  EXPECT_LT(length, 2.0 * std::hypot(4.5, 2.0 + kRadius) + 1.0);
  EXPECT_GT(length, 2.0 * std::hypot(5.0, 2.0));
}

TEST(ShortestPath, LeadsOutOfADeadEnd) {
  const FreeSpace space({box({2.0, 0.0, 2.0}, {0.2, 3.0, 20.0}), box({0.0, 3.0, 2.0}, {2.0, 0.2, 20.0}),
                         box({0.0, -3.0, 2.0}, {2.0, 0.2, 20.0})},
                        kRadius, kBox);
  const double length = shortest(space, {0.0, 0.0, 2.0}, {5.0, 0.0, 2.0});
  const double out = std::hypot(2.0, 3.2), along = 4.2, back = std::hypot(2.8, 3.2);
  EXPECT_GT(length, out + along + back - 0.3);
  EXPECT_LT(length, out + along + back + 1.0);
}

TEST(ShortestPath, FitsThroughAGapThatJustLeavesRoom) {
  const double half_gap = kRadius + 0.1;
  const FreeSpace space(
      {box({0.0, 8.0 + half_gap, 2.0}, {0.5, 8.0, 20.0}), box({0.0, -8.0 - half_gap, 2.0}, {0.5, 8.0, 20.0})}, kRadius,
      kBox);
  EXPECT_LT(shortest(space, {-5.0, 3.0, 2.0}, {5.0, 3.0, 2.0}), 2.0 * std::hypot(4.5, 3.0) + 1.0);
  const FreeSpace closed({box({0.0, 8.0 + 0.29, 2.0}, {0.5, 8.0, 20.0}), box({0.0, -8.29, 2.0}, {0.5, 8.0, 20.0})},
                         kRadius, kBox);
  EXPECT_TRUE(std::isinf(shortest(closed, {-5.0, 3.0, 2.0}, {5.0, 3.0, 2.0})));
}

TEST(ShortestPath, StaysInTheBoxAndNeedsFreeEnds) {
  // The column reaches to the box's sides but for a UAV's width on one of them.
  const FreeSpace closed({column(0.0, 0.0, 7.8)}, kRadius, kBox);
  EXPECT_TRUE(std::isinf(shortest(closed, {-7.0, -7.0, 2.0}, {7.0, 7.0, 2.0})));
  const FreeSpace space({column(0.0, 0.0, 1.0)}, kRadius, kBox);
  EXPECT_TRUE(std::isinf(shortest(space, {-5.0, 0.0, 2.0}, {0.5, 0.0, 2.0})));
  EXPECT_TRUE(std::isinf(shortest(space, {-9.0, 0.0, 2.0}, {5.0, 0.0, 2.0})));
}

TEST(LeastTime, IsThatOfTheTrapezoidOfSpeed) {
  Parameters parameters;
  parameters.limits.max_speed = 5.0;
  parameters.limits.max_acceleration = 10.0;
  EXPECT_DOUBLE_EQ(leastTime(Vector3(20.0, 0.0, 0.0), parameters), 20.0 / 5.0 + 5.0 / 10.0);
  EXPECT_DOUBLE_EQ(leastTime(Vector3(0.0, 0.9, 0.0), parameters), 2.0 * std::sqrt(0.9 / 10.0));
  EXPECT_EQ(leastTime(Vector3::Zero(), parameters), 0.0);
}

TEST(LeastTime, IsLimitedByThrustWhereNoAccelerationIs) {
  Parameters parameters;
  parameters.limits.max_speed = 5.0;
  parameters.limits.max_thrust_ratio = 2.0;
  const double gravity = parameters.vehicle.gravity;
  const double across = gravity * std::sqrt(3.0);
  EXPECT_NEAR(leastTime(Vector3(20.0, 0.0, 0.0), parameters), 4.0 + 5.0 / across, 1e-12);
  // Upwards one g is left, against it three: gravity helps to stop.
  EXPECT_NEAR(leastTime(Vector3(0.0, 0.0, 20.0), parameters), 4.0 + 2.5 / gravity + 2.5 / (3.0 * gravity), 1e-12);
}

Mission missionPast(const Vector3& obstacle_velocity, const std::vector<Vector3>& reference) {
  Mission mission;
  mission.scenario.uavs.resize(1);
  mission.scenario.uavs[0].start = reference.front();
  mission.scenario.uavs[0].reference = reference;
  ScenarioObstacle obstacle;
  obstacle.velocity = obstacle_velocity;
  mission.scenario.obstacles = {obstacle};
  mission.scenario.workspace = Workspace{{-4.0, -4.0, -4.0}, {4.0, 4.0, 4.0}};
  mission.parameters.limits.uav_radius = kRadius;
  return mission;
}

TEST(FlightBounds, LeadRoundWhatStandsAndNotRoundWhatMoves) {
  const std::vector<Vector3> through = {{-3.0, 0.0, 0.0}, {3.0, 0.0, 0.0}};
  EXPECT_GT(*flightBounds(missionPast(Vector3::Zero(), through), true)[0].shortest_path, 6.2);
  EXPECT_DOUBLE_EQ(*flightBounds(missionPast(Vector3(0.0, 1.0, 0.0), through), true)[0].shortest_path, 6.0);
  EXPECT_FALSE(flightBounds(missionPast(Vector3::Zero(), through), false)[0].shortest_path);
}

TEST(FlightBounds, FollowTheCornersOfTheReferenceThatAUavCanReach) {
  const std::vector<Vector3> round = {{-3.0, 0.0, 0.0}, {-3.0, 3.0, 0.0}, {3.0, 3.0, 0.0}};
  EXPECT_DOUBLE_EQ(*flightBounds(missionPast(Vector3::Zero(), round), true)[0].shortest_path, 9.0);
  const std::vector<Vector3> inside = {{-3.0, 0.0, 0.0}, {0.0, 0.5, 0.0}, {-3.0, 3.0, 0.0}};
  EXPECT_DOUBLE_EQ(*flightBounds(missionPast(Vector3::Zero(), inside), true)[0].shortest_path, 3.0);
  const std::vector<Vector3> ends_inside = {{-3.0, 0.0, 0.0}, {0.0, 0.5, 0.0}};
  EXPECT_FALSE(flightBounds(missionPast(Vector3::Zero(), ends_inside), true)[0].shortest_path);
}

}  // namespace
}  // namespace swarm_planner
