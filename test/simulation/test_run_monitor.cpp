// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Hand-made motions whose figures are known. If these fail, published numbers of collisions, clearance, lag or stuck
// UAVs are wrong, and every comparison that is built on them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "swarm_planner/obstacles/robustness.hpp"
#include "swarm_planner/simulation/run_monitor.hpp"

namespace swarm_planner {
namespace {

constexpr double kPeriod = 0.01;

using Motion = std::function<Vector3(double)>;

ScenarioUav uavOn(const std::vector<Vector3>& reference, double start, double speed) {
  ScenarioUav uav;
  uav.start = reference.front();
  uav.reference = reference;
  uav.target = {start, speed};
  return uav;
}

/// A mission of `uavs` that lasts `duration` [s].
Mission lasting(double duration, std::vector<ScenarioUav> uavs) {
  Mission mission;
  mission.scenario.end.duration = duration;
  mission.scenario.uavs = std::move(uavs);
  return mission;
}

Mission untilAllAtGoal(double timeout, double tolerance, std::vector<ScenarioUav> uavs) {
  Mission mission = lasting(0.0, std::move(uavs));
  mission.scenario.end = EndCondition{};
  mission.scenario.end.all_at_goal = true;
  mission.scenario.end.timeout = timeout;
  mission.scenario.end.tolerance = tolerance;
  return mission;
}

const std::vector<Vector3> kAlongX = {Vector3::Zero(), Vector3(1000.0, 0.0, 0.0)};

/// Lets the UAVs move as given, obstacles with their velocity, until the run's end.
RunSummary watch(const Mission& mission, const std::vector<Motion>& motions,
                 const std::vector<Superellipsoid>& obstacles = {}) {
  RunMonitor monitor(mission);
  std::vector<UavSample> samples(motions.size());
  std::vector<Superellipsoid> moved = obstacles;
  for (int step = 0; !monitor.ended(); ++step) {
    const double t = step * kPeriod;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      samples[i].p = motions[i](t);
      samples[i].v = (motions[i](t + 1e-6) - motions[i](t - 1e-6)) / 2e-6;
    }
    for (std::size_t i = 0; i < obstacles.size(); ++i) moved[i] = obstacles[i].movedBy(t);
    monitor.observe(t, samples, moved);
  }
  return monitor.summary();
}

Motion standing(const Vector3& p) {
  return [p](double) { return p; };
}

Motion flying(const Vector3& from, const Vector3& v) {
  return [from, v](double t) { return Vector3(from + t * v); };
}

Superellipsoid sphere(const Vector3& center, double radius, const Vector3& velocity = Vector3::Zero()) {
  return Superellipsoid(1, center, Vector3::Constant(radius), Vector3::Constant(2.0), 0.0, velocity);
}

TEST(RunMonitor, OneUavAloneHasNoDistances) {
  const RunSummary run = watch(lasting(1.0, {uavOn(kAlongX, 0.0, 0.0)}), {standing(Vector3::Zero())});
  EXPECT_FALSE(run.min_uav_distance);
  EXPECT_FALSE(run.min_obstacle_clearance);
  EXPECT_TRUE(run.collisions.empty());
  EXPECT_DOUBLE_EQ(run.mission_time, 1.0);
}

TEST(RunMonitor, TwoPassesOfAPairAreTwoCollisions) {
  // One stands; the other swings by at 1.5 m, inside the pair distance of 2 m, twice.
  const Motion swinging = [](double t) { return Vector3(10.0 * std::cos(M_PI * t / 10.0), 1.5, 0.0); };
  const RunSummary run =
      watch(lasting(20.0, {uavOn(kAlongX, 0.0, 0.0), uavOn(kAlongX, 0.0, 0.0)}), {standing(Vector3::Zero()), swinging});
  ASSERT_EQ(run.collisions.size(), 2u);
  EXPECT_FALSE(run.collisions[0].with_obstacle);
  EXPECT_EQ(run.collisions[0].uav, 0u);
  EXPECT_EQ(run.collisions[0].partner, 1u);
  EXPECT_NEAR(run.collisions[0].time, 10.0 / M_PI * std::acos(std::sqrt(4.0 - 2.25) / 10.0), kPeriod);
  EXPECT_NEAR(*run.min_uav_distance, 1.5, 1e-3);
}

TEST(RunMonitor, NoCollisionIsSeenWherePairsKeepTheirDistance) {
  const Motion swinging = [](double t) { return Vector3(10.0 * std::cos(M_PI * t / 10.0), 2.01, 0.0); };
  const RunSummary run =
      watch(lasting(20.0, {uavOn(kAlongX, 0.0, 0.0), uavOn(kAlongX, 0.0, 0.0)}), {standing(Vector3::Zero()), swinging});
  EXPECT_TRUE(run.collisions.empty());
  EXPECT_NEAR(*run.min_uav_distance, 2.01, 1e-3);
}

TEST(RunMonitor, ThePairEllipsoidHasItsOwnHeight) {
  Mission mission = lasting(1.0, {uavOn(kAlongX, 0.0, 0.0), uavOn(kAlongX, 0.0, 0.0)});
  mission.parameters.limits.pair_distance = 1.0;
  mission.parameters.limits.pair_distance_vertical = 4.0;
  const Motion low = standing(Vector3::Zero());
  EXPECT_EQ(watch(mission, {low, standing(Vector3(0.0, 0.0, 3.5))}).collisions.size(), 1u);
  EXPECT_EQ(watch(mission, {low, standing(Vector3(0.0, 0.0, 4.5))}).collisions.size(), 0u);
  EXPECT_EQ(watch(mission, {low, standing(Vector3(1.5, 0.0, 0.0))}).collisions.size(), 0u);
  EXPECT_EQ(watch(mission, {low, standing(Vector3(0.8, 0.0, 3.0))}).collisions.size(), 0u);
  EXPECT_EQ(watch(mission, {low, standing(Vector3(0.5, 0.0, 3.0))}).collisions.size(), 1u);
}

TEST(RunMonitor, ClearanceIsFromTheSurfaceLessTheUavsRadius) {
  const Mission mission = lasting(20.0, {uavOn(kAlongX, 0.0, 0.0)});
  const Motion passing = flying(Vector3(-10.0, 3.0, 0.0), Vector3(1.0, 0.0, 0.0));
  const RunSummary clear = watch(mission, {passing}, {sphere(Vector3::Zero(), 2.5)});
  EXPECT_NEAR(*clear.min_obstacle_clearance, 3.0 - 2.5 - 0.3, 1e-6);
  EXPECT_TRUE(clear.collisions.empty());
  const RunSummary grazing =
      watch(mission, {passing}, {sphere(Vector3(900.0, 0.0, 0.0), 1.0), sphere(Vector3::Zero(), 2.8)});
  EXPECT_NEAR(*grazing.min_obstacle_clearance, 3.0 - 2.8 - 0.3, 1e-6);
  ASSERT_EQ(grazing.collisions.size(), 1u);
  EXPECT_TRUE(grazing.collisions[0].with_obstacle);
  EXPECT_EQ(grazing.collisions[0].partner, 1u);
}

TEST(RunMonitor, AnObstacleThatComesToAStandingUavIsSeen) {
  const Mission mission = lasting(30.0, {uavOn(kAlongX, 0.0, 0.0), uavOn(kAlongX, 0.0, 0.0)});
  const RunSummary run = watch(mission, {standing(Vector3::Zero()), standing(Vector3(0.0, 50.0, 0.0))},
                               {sphere(Vector3(-50.0, 0.0, 0.0), 2.0, Vector3(5.0, 0.0, 0.0))});
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, (50.0 - 2.3) / 5.0, kPeriod);
}

TEST(RunMonitor, ManyUavsAndObstaclesAreMeasuredAsIfEveryPairWereLookedAt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-20.0, 20.0), speed(-5.0, 5.0), radius(1.0, 6.0);
  const auto vector = [&random](auto& x) { return Vector3(x(random), x(random), x(random)); };
  constexpr std::size_t kUavs = 60;
  std::vector<Motion> motions;
  std::vector<Superellipsoid> obstacles;
  for (std::size_t i = 0; i < kUavs; ++i) motions.push_back(flying(vector(place), vector(speed)));
  for (int i = 0; i < 12; ++i) {
    obstacles.emplace_back(i, vector(place), vector(radius), Vector3(2.0, 4.0, 8.0), 0.3 * i, vector(speed));
  }
  const Mission mission = lasting(10.0, std::vector<ScenarioUav>(kUavs, uavOn(kAlongX, 0.0, 0.0)));
  const RunSummary run = watch(mission, motions, obstacles);

  double distance = std::numeric_limits<double>::infinity();
  double clearance = std::numeric_limits<double>::infinity();
  std::size_t episodes = 0;
  std::vector<std::vector<bool>> pair_inside(kUavs, std::vector<bool>(kUavs)), touching(kUavs, std::vector<bool>(12));
  for (int step = 0; step <= 1000; ++step) {
    const double t = step * kPeriod;
    for (std::size_t i = 0; i < kUavs; ++i) {
      for (std::size_t j = i + 1; j < kUavs; ++j) {
        const double apart = (motions[i](t) - motions[j](t)).norm();
        distance = std::min(distance, apart);
        episodes += apart < 2.0 && !pair_inside[i][j] ? 1 : 0;
        pair_inside[i][j] = apart < 2.0;
      }
      for (std::size_t k = 0; k < obstacles.size(); ++k) {
        const double clear = obstacles[k].movedBy(t).signedDistance(motions[i](t)) - 0.3;
        clearance = std::min(clearance, clear);
        episodes += clear < 0.0 && !touching[i][k] ? 1 : 0;
        touching[i][k] = clear < 0.0;
      }
    }
  }
  EXPECT_GT(episodes, 5u);
  EXPECT_EQ(run.collisions.size(), episodes);
  EXPECT_NEAR(*run.min_uav_distance, distance, 1e-12);
  EXPECT_NEAR(*run.min_obstacle_clearance, clearance, 1e-12);
}

TEST(RunMonitor, LagIsMeasuredAlongTheReference) {
  const RunSummary run = watch(lasting(10.0, {uavOn(kAlongX, 20.0, 3.0), uavOn(kAlongX, 0.0, 3.0)}),
                               {flying(Vector3(0.0, 7.0, 2.0), Vector3(3.0, 0.0, 0.0)),
                                flying(Vector3(0.0, -7.0, 2.0), Vector3(4.0, 0.0, 0.0))});
  EXPECT_NEAR(run.final_lag.max, 20.0, 1e-9);
  EXPECT_NEAR(run.final_lag.mean, 0.5 * (20.0 - 10.0), 1e-9);  // one is ahead of its target
}

TEST(RunMonitor, LagDoesNotJumpWhereAReferenceCrossesItself) {
  // Along x, back in a loop, across the first leg at (50, 0), which is at arc lengths 50 and 250.
  const std::vector<Vector3> loop = {Vector3::Zero(), Vector3(100.0, 0.0, 0.0), Vector3(100.0, 50.0, 0.0),
                                     Vector3(50.0, 50.0, 0.0), Vector3(50.0, -50.0, 0.0)};
  RunMonitor monitor(lasting(60.0, {uavOn(loop, 0.0, 0.0)}));
  const ReferencePath path(loop);
  double worst = 0.0;
  for (int step = 0; step <= 6000; ++step) {
    const double arc_length = std::min(5.0 * step * kPeriod, path.length());
    UavSample sample;
    sample.p = path.at(arc_length).position + Vector3(0.0, 0.0, 0.5);
    monitor.observe(step * kPeriod, {sample}, {});
    worst = std::max(worst, std::abs(monitor.lag(0) + arc_length));
  }
  EXPECT_LT(worst, 1.0);
}

TEST(RunMonitor, AClosedReferenceBeginsAtItsBeginning) {
  const std::vector<Vector3> square = {Vector3::Zero(), Vector3(30.0, 0.0, 0.0), Vector3(30.0, 30.0, 0.0),
                                       Vector3(0.0, 30.0, 0.0), Vector3::Zero()};
  RunMonitor monitor(lasting(1.0, {uavOn(square, 0.0, 0.0)}));
  monitor.observe(0.0, {UavSample{}}, {});
  EXPECT_DOUBLE_EQ(monitor.lag(0), 0.0);
}

TEST(RunMonitor, AUavThatStandsBehindItsTargetIsStuck) {
  const Motion stops = [](double t) { return Vector3(std::min(3.0 * t, 60.0), 0.0, 0.0); };
  const auto stuck_after = [&](double duration, const Motion& motion) {
    return watch(lasting(duration, {uavOn(kAlongX, 0.0, 3.0)}), {motion}).stuck_uavs;
  };
  EXPECT_EQ(stuck_after(45.0, stops), 1);
  EXPECT_EQ(stuck_after(39.0, stops), 0);                                            // still moving 20 s earlier
  EXPECT_EQ(stuck_after(45.0, flying(Vector3::Zero(), Vector3(1.0, 0.0, 0.0))), 0);  // slow, not stuck
  EXPECT_EQ(stuck_after(45.0, flying(Vector3::Zero(), Vector3(0.0, 1.0, 0.0))), 0);  // no progress, but on its way
  EXPECT_EQ(watch(lasting(45.0, {uavOn(kAlongX, 19.0, 0.0)}), {standing(Vector3::Zero())}).stuck_uavs, 0);
}

TEST(RunMonitor, WhoIsShortOfTheGoalForGoodIsStuckHoweverNear) {
  const std::vector<Vector3> reference = {Vector3::Zero(), Vector3(10.0, 0.0, 0.0)};
  const RunSummary run = watch(untilAllAtGoal(30.0, 0.2, {uavOn(reference, 0.0, 3.0)}),
                               {[](double t) { return Vector3(std::min(3.0 * t, 9.5), 0.0, 0.0); }});
  EXPECT_EQ(run.stuck_uavs, 1);
  EXPECT_EQ(run.arrived_uavs, 0);
  EXPECT_TRUE(run.timed_out);
  EXPECT_DOUBLE_EQ(run.mission_time, 30.0);
}

TEST(RunMonitor, ARunEndsOnceAllAreAtTheirGoals) {
  const std::vector<Vector3> reference = {Vector3::Zero(), Vector3(10.0, 0.0, 0.0)};
  const RunSummary run = watch(untilAllAtGoal(30.0, 0.2, {uavOn(reference, 0.0, 3.0), uavOn(reference, 0.0, 3.0)}),
                               {[](double t) { return Vector3(std::min(2.0 * t, 10.0), 0.0, 0.0); },
                                [](double t) { return Vector3(std::min(1.0 * t, 10.0), 0.1, 0.0); }});
  EXPECT_FALSE(run.timed_out);
  EXPECT_EQ(run.arrived_uavs, 2);
  EXPECT_EQ(run.stuck_uavs, 0);
  EXPECT_NEAR(run.mission_time, 10.0 - std::sqrt(0.04 - 0.01), 2.0 * kPeriod);
}

TEST(RunMonitor, ParkedAroundAnOccupiedEndHasArrived) {
  const std::vector<Vector3> reference = {Vector3::Zero(), Vector3(10.0, 0.0, 0.0)};
  const Mission mission = untilAllAtGoal(25.0, 0.2, {uavOn(reference, 0.0, 3.0), uavOn(reference, 0.0, 3.0)});
  const Motion at_end = standing(Vector3(10.0, 0.0, 0.0));
  const auto arrived = [&](const Motion& first, const Motion& second) {
    const RunSummary run = watch(mission, {first, second});
    EXPECT_EQ(run.arrived_uavs + run.stuck_uavs, 2);
    return run.arrived_uavs;
  };
  EXPECT_EQ(arrived(at_end, standing(Vector3(7.9, 0.0, 0.0))), 2);
  EXPECT_EQ(arrived(at_end, standing(Vector3(6.0, 0.0, 0.0))), 1);  // farther off than it must be
  EXPECT_EQ(arrived(standing(Vector3(9.0, 0.0, 0.0)), standing(Vector3(7.0, 0.0, 0.0))), 0);  // the end is free
}

// More are sent to one place than fit around it.
TEST(RunMonitor, ParkedBehindTwoThatHaveArrivedHasArrived) {
  const std::vector<Vector3> reference = {Vector3::Zero(), Vector3(10.0, 0.0, 0.0)};
  const Mission mission = untilAllAtGoal(25.0, 0.2, std::vector<ScenarioUav>(4, uavOn(reference, 0.0, 3.0)));
  const auto arrived = [&](const Vector3& last) {
    return watch(mission, {standing(Vector3(10.0, 0.0, 0.0)), standing(Vector3(8.2, 1.1, 0.0)),
                           standing(Vector3(8.2, -1.1, 0.0)), standing(last)})
        .arrived_uavs;
  };
  EXPECT_EQ(arrived(Vector3(6.4, 0.0, 0.0)), 4);
  EXPECT_EQ(arrived(Vector3(6.1, 1.1, 0.0)), 3);  // it touches one of them alone: there is room nearer to the end
  EXPECT_EQ(arrived(Vector3(5.0, 0.0, 0.0)), 3);
}

TEST(RunMonitor, ARunTowardsAPlaneEndsWithTheLastTarget) {
  Mission mission = lasting(1.0, {uavOn(kAlongX, 20.0, 3.0), uavOn(kAlongX, 10.0, 4.0)});
  mission.scenario.end = EndCondition{};
  mission.scenario.end.target_x = 80.0;
  const RunSummary run = watch(mission, {standing(Vector3::Zero()), standing(Vector3(0.0, 5.0, 0.0))});
  EXPECT_NEAR(run.mission_time, 20.0, 1.5 * kPeriod);
}

TEST(RunMonitor, ATargetThatStopsBeforeThePlaneDoesNotKeepTheRunGoing) {
  Mission mission =
      lasting(1.0, {uavOn({Vector3::Zero(), Vector3(30.0, 0.0, 0.0)}, 0.0, 3.0), uavOn(kAlongX, 10.0, 0.0)});
  mission.scenario.end = EndCondition{};
  mission.scenario.end.target_x = 80.0;
  const RunSummary run = watch(mission, {standing(Vector3::Zero()), standing(Vector3(0.0, 5.0, 0.0))});
  EXPECT_NEAR(run.mission_time, 10.0, 1.5 * kPeriod);
}

TEST(RunMonitor, EveryExcursionFromTheWorkspaceCounts) {
  Mission mission = lasting(20.0, {uavOn(kAlongX, 0.0, 0.0)});
  mission.scenario.workspace = Workspace{Vector3(-5.0, -5.0, 0.0), Vector3(5.0, 5.0, 10.0)};
  const auto height = [](double amplitude) {
    return [amplitude](double t) { return Vector3(0.0, 0.0, 5.0 + amplitude * std::sin(2.0 * M_PI * t / 10.0)); };
  };
  EXPECT_EQ(watch(mission, {height(5.5)}).workspace_violations, 4);
  EXPECT_EQ(watch(mission, {height(4.9)}).workspace_violations, 0);
}

TEST(RunMonitor, PathLengthAndTrackingErrorAreThoseOfAllUavs) {
  RunMonitor monitor(lasting(1.0, {uavOn(kAlongX, 0.0, 0.0), uavOn(kAlongX, 0.0, 0.0)}));
  for (int step = 0; step <= 100; ++step) {
    UavSample first, second;
    first.p = Vector3(0.03 * step, 0.0, 0.0);
    first.tracking_error = step == 50 ? 0.5 : 0.1;
    second.p = Vector3(0.0, 5.0 + 0.01 * step, 0.0);
    second.tracking_error = 0.2;
    monitor.observe(step * kPeriod, {first, second}, {});
  }
  const RunSummary run = monitor.summary();
  EXPECT_NEAR(run.path_length, 4.0, 1e-9);
  EXPECT_NEAR(run.tracking_error.max, 0.5, 1e-12);
  EXPECT_NEAR(run.tracking_error.mean, (0.1 * 100 + 0.5 + 0.2 * 101) / 202.0, 1e-12);
}

TEST(RunMonitor, TheCostIsTheIntegralOfTheWeightedDeviations) {
  Mission mission = lasting(2.0, {uavOn(kAlongX, 0.0, 3.0)});
  CostParameters& weights = mission.parameters.cost;
  weights.alpha = 0.5;
  weights.beta = 0.7;
  weights.eta = 0.1;
  weights.zeta = 0.2;
  weights.velocity_time = 2.0;
  RunMonitor monitor(mission);
  for (int step = 0; step <= 200; ++step) {
    UavSample sample;
    sample.p = Vector3(3.0 * step * kPeriod - 4.0, 2.0, 1.0);
    sample.v = Vector3(2.0, 0.0, 0.0);
    sample.jerk = Vector3(0.0, 3.0, 0.0);
    monitor.observe(step * kPeriod, {sample}, {});
  }
  // The UAV's foot does not leave the path's beginning while x < 0; there the deviation along the path costs nothing.
  const double expected = 0.5 * 4.0 + 0.7 * 1.0 + 0.1 * (16.0 + 4.0 + 1.0 + 4.0 * 1.0) + 0.2 * 9.0;
  EXPECT_NEAR(monitor.summary().cost, 2.0 * expected, 1e-9);
}

TEST(RunMonitor, TheCostHoldsTheRobustnessFunctionNearObstacles) {
  Mission mission = lasting(2.0, {uavOn(kAlongX, 0.0, 0.0)});
  const Superellipsoid near = sphere(Vector3(4.0, 0.0, 0.0), 3.5), far = sphere(Vector3(400.0, 0.0, 0.0), 3.5);
  const double without = watch(mission, {standing(Vector3::Zero())}, {far}).cost;
  const double with = watch(mission, {standing(Vector3::Zero())}, {far, near}).cost;
  const CostParameters& weights = mission.parameters.cost;
  const double expected = robustness(near, Vector3::Zero(), RobustnessParameters(weights)).value;
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(with - without, 2.0 * expected, 1e-9);
}

TEST(RunMonitor, AWrongNumberOfVehiclesIsRefused) {
  RunMonitor monitor(lasting(1.0, {uavOn(kAlongX, 0.0, 0.0)}));
  EXPECT_THROW(monitor.observe(0.0, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
