// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The loop around the planner, with a planner whose every answer is known. If these fail, an experiment does not fly
// what the ROS system would: wrong epochs, odometry or obstacles of another instant, miscounted cycles.
#include <gtest/gtest.h>

#include <cmath>

#include "support/flight_problem.hpp"
#include "swarm_planner/experiments/closed_loop_run.hpp"

namespace swarm_planner {
namespace {

constexpr double kSpeed = 2.0;  // [m/s], along x

/// Plans a flight along x at constant speed from where each UAV is measured, a stop after it, and keeps what it was
/// given.
class StraightPlanner : public CyclePlanner {
 public:
  explicit StraightPlanner(std::size_t uavs) : motions_(uavs) { report_.uavs.resize(uavs); }

  const CycleReport& plan(const Snapshot& snapshot, double epoch) override {
    snapshots.push_back(snapshot);
    epochs.push_back(epoch);
    ++report_.cycle;
    report_.cycle_time = cycle_time;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      KinematicState start;
      start.p = snapshot.uavs[i].p + (epoch - snapshot.now) * snapshot.uavs[i].v;
      start.v = speed * Vector3::UnitX();
      const Trajectory plan = straightPlan(start.p, start.v, epoch, 0.3);
      StopManoeuvre stop;
      rollOutStop(plan.knots.back(), 10, plan.dt, stop);
      motions_[i].assign(plan, stop);
      report_.uavs[i] = uav_report;
      report_.uavs[i].planned = i != not_planned;
    }
    return report_;
  }
  const CommittedMotion& committed(std::size_t uav) const override { return motions_[uav]; }

  UavReport uav_report;
  double cycle_time = 0.001;
  double speed = kSpeed;
  std::size_t not_planned = 1000;
  std::vector<Snapshot> snapshots;
  std::vector<double> epochs;

 private:
  CycleReport report_;
  std::vector<CommittedMotion> motions_;
};

class Recorder : public RunObserver {
 public:
  void onSample(double t, const std::vector<QuadSimulator>& vehicles,
                const std::vector<Superellipsoid>& obstacles) override {
    times.push_back(t);
    positions.push_back(vehicles[0].state().p);
    if (!obstacles.empty()) obstacle_positions.push_back(obstacles[0].center());
  }
  void onCycle(double epoch, const CycleReport&) override { epochs.push_back(epoch); }

  std::vector<double> times, epochs;
  std::vector<Vector3> positions, obstacle_positions;
};

Mission twoUavs(double duration) {
  Mission mission;
  mission.scenario.name = "two";
  mission.scenario.end.duration = duration;
  for (int i = 0; i < 2; ++i) {
    ScenarioUav uav;
    uav.name = "uav" + std::to_string(i + 1);
    uav.start = Vector3(0.0, 10.0 * i, 5.0);
    uav.reference = {uav.start, uav.start + Vector3(100.0, 0.0, 0.0)};
    uav.target = {0.0, kSpeed};
    mission.scenario.uavs.push_back(uav);
  }
  ScenarioObstacle obstacle;
  obstacle.id = 7;
  obstacle.center = Vector3(50.0, 50.0, 5.0);
  obstacle.velocity = Vector3(0.0, -3.0, 0.0);
  mission.scenario.obstacles.push_back(obstacle);
  return mission;
}

TEST(ClosedLoopRun, PlansOneCycleAheadFromThePresentInstant) {
  const Mission mission = twoUavs(3.0);
  StraightPlanner planner(2);
  ClosedLoopRun(mission, planner, 0).fly();
  ASSERT_GE(planner.epochs.size(), 3u);
  for (std::size_t n = 0; n < planner.epochs.size(); ++n) {
    const Snapshot& snapshot = planner.snapshots[n];
    const double now = 0.3 * (static_cast<double>(n) - 1.0);
    EXPECT_NEAR(snapshot.now, now, 1e-12);
    EXPECT_NEAR(planner.epochs[n], now + 0.3, 1e-12);
    ASSERT_EQ(snapshot.uavs.size(), 2u);
    EXPECT_TRUE(snapshot.uavs[1].received);
    EXPECT_DOUBLE_EQ(snapshot.uavs[1].stamp, snapshot.now);
    ASSERT_EQ(snapshot.obstacles.size(), 1u);
    EXPECT_DOUBLE_EQ(snapshot.obstacles[0].stamp, snapshot.now);
    EXPECT_EQ(snapshot.obstacles[0].shape.id(), 7);
    EXPECT_NEAR(snapshot.obstacles[0].shape.center().y(), 50.0 - 3.0 * now, 1e-9);
  }
}

TEST(ClosedLoopRun, TheFirstPlanIsFlownFromTimeZeroOn) {
  const Mission mission = twoUavs(3.0);
  StraightPlanner planner(2);
  Recorder recorder;
  const RunResult result = ClosedLoopRun(mission, planner, 0).fly({&recorder});
  ASSERT_EQ(recorder.times.size(), 301u);
  for (std::size_t i = 0; i < recorder.times.size(); ++i) {
    EXPECT_NEAR(recorder.times[i], 0.01 * static_cast<double>(i), 1e-12);
  }
  EXPECT_EQ(recorder.positions.front(), mission.scenario.uavs[0].start);
  EXPECT_EQ(recorder.obstacle_positions.front(), mission.scenario.obstacles[0].center);
  EXPECT_NEAR(recorder.obstacle_positions.back().y(), 50.0 - 9.0, 1e-9);
  EXPECT_GT(recorder.positions.back().x(), 0.7 * kSpeed * 3.0);
  EXPECT_EQ(result.cycles, recorder.epochs.size());
  EXPECT_EQ(result.cycles, 11u);  // epochs 0, 0.3 .. 3.0
  EXPECT_DOUBLE_EQ(recorder.epochs.front(), 0.0);
}

TEST(ClosedLoopRun, ACyclePeriodThatIsNoMultipleOfTheEvaluationIsKept) {
  Mission mission = twoUavs(1.0);
  mission.parameters.time.cycle_period = 0.125;
  StraightPlanner planner(2);
  Recorder recorder;
  ClosedLoopRun(mission, planner, 0).fly({&recorder});
  for (std::size_t n = 0; n < planner.epochs.size(); ++n) {
    EXPECT_NEAR(planner.epochs[n], 0.125 * static_cast<double>(n), 1e-12);
  }
  EXPECT_EQ(recorder.times.size(), 101u);
}

TEST(ClosedLoopRun, AUavWithoutAPlanHovers) {
  const Mission mission = twoUavs(3.0);
  StraightPlanner planner(2);
  planner.not_planned = 0;
  Recorder recorder;
  ClosedLoopRun(mission, planner, 0).fly({&recorder});
  EXPECT_LT((recorder.positions.back() - mission.scenario.uavs[0].start).norm(), 1e-9);
}

TEST(ClosedLoopRun, APlanThatCannotBeFlownIsCountedAndNotFlown) {
  const Mission mission = twoUavs(2.6);
  StraightPlanner planner(2);
  planner.speed = std::nan("");
  Recorder recorder;
  const RunResult result = ClosedLoopRun(mission, planner, 0).fly({&recorder});
  EXPECT_EQ(result.fallbacks.at("the vehicle refused the trajectory"), 20u);
  EXPECT_LT((recorder.positions.back() - mission.scenario.uavs[0].start).norm(), 1e-9);
}

TEST(ClosedLoopRun, CountsWhatThePlannerReports) {
  const Mission mission = twoUavs(2.6);
  StraightPlanner planner(2);
  planner.cycle_time = 0.4;
  planner.uav_report.solve_time = 0.002;
  planner.uav_report.sqp_iterations = 3;
  planner.uav_report.qp_iterations = 20;
  planner.uav_report.state = UavState::kFallback;
  planner.uav_report.reason = Reason::kPlanRefused;
  const RunResult result = ClosedLoopRun(mission, planner, 5).fly();
  EXPECT_EQ(result.scenario, "two");
  EXPECT_EQ(result.seed, 5u);
  EXPECT_EQ(result.uavs, 2u);
  EXPECT_EQ(result.cycles, 10u);
  EXPECT_EQ(result.deadline_misses, 10u);
  EXPECT_NEAR(result.cycle_ms.median, 400.0, 1e-9);
  EXPECT_NEAR(result.uav_ms.max, 2.0, 1e-9);
  EXPECT_NEAR(result.sqp_iterations.mean, 3.0, 1e-9);
  EXPECT_NEAR(result.qp_iterations.max, 20.0, 1e-9);
  ASSERT_EQ(result.fallbacks.size(), 1u);
  EXPECT_EQ(result.fallbacks.at(reasonText(Reason::kPlanRefused)), 20u);
}

TEST(ClosedLoopRun, NoiseReachesThePlannerAndFollowsTheSeed) {
  Mission mission = twoUavs(0.9);
  mission.parameters.simulation.position_noise = 0.05;
  const auto first_measurement = [&mission](std::uint64_t seed, std::size_t uav) {
    StraightPlanner planner(2);
    ClosedLoopRun(mission, planner, seed).fly();
    return Vector3(planner.snapshots[0].uavs[uav].p - mission.scenario.uavs[uav].start);
  };
  EXPECT_GT(first_measurement(1, 0).norm(), 0.001);
  EXPECT_LT(first_measurement(1, 0).norm(), 0.3);
  EXPECT_EQ(first_measurement(1, 0), first_measurement(1, 0));
  EXPECT_NE(first_measurement(1, 0), first_measurement(2, 0));
  EXPECT_NE(first_measurement(1, 0), first_measurement(1, 1));
}

/// The snapshots of a run in which every UAV stays where it starts.
std::vector<Snapshot> hoveringSnapshots(const Mission& mission, std::uint64_t seed) {
  StraightPlanner planner(2);
  planner.speed = 0.0;
  ClosedLoopRun(mission, planner, seed).fly();
  return planner.snapshots;
}

TEST(ClosedLoopRun, LatencyDelaysWhatThePlannerSeesByExactlyThatMuch) {
  for (const double latency : {0.1, 0.123, 0.3, 0.75}) {
    Mission mission = twoUavs(3.0);
    mission.parameters.simulation.latency = latency;
    StraightPlanner planner(2);
    Recorder recorder;
    ClosedLoopRun(mission, planner, 0).fly({&recorder});
    ASSERT_EQ(planner.snapshots.size(), 11u);
    for (const Snapshot& snapshot : planner.snapshots) {
      const double stamp = snapshot.now - latency;
      for (const UavMeasurement& measurement : snapshot.uavs) {
        ASSERT_TRUE(measurement.received);
        EXPECT_NEAR(measurement.stamp, stamp, 1e-9);
      }
      ASSERT_EQ(snapshot.obstacles.size(), 1u);
      EXPECT_NEAR(snapshot.obstacles[0].stamp, stamp, 1e-9);
      EXPECT_NEAR(snapshot.obstacles[0].shape.center().y(), 50.0 - 3.0 * stamp, 1e-6);
      // Where the vehicle truly was then, between two samples.
      const double sample = std::max(0.0, stamp / 0.01);
      const auto before = static_cast<std::size_t>(sample);
      const Vector3 truth =
          recorder.positions[before] +
          (sample - std::floor(sample)) * (recorder.positions[before + 1] - recorder.positions[before]);
      EXPECT_LT((snapshot.uavs[0].p - truth).norm(), 1e-3);
    }
  }
}

TEST(ClosedLoopRun, SetpointsReachTheVehicleLate) {
  Mission mission = twoUavs(3.0);
  mission.parameters.simulation.latency = 0.5;
  StraightPlanner planner(2);
  Recorder recorder;
  ClosedLoopRun(mission, planner, 0).fly({&recorder});
  // The first plans are made at -0.3 s, begin at 0 and arrive at 0.2 s.
  EXPECT_EQ(recorder.positions[20], mission.scenario.uavs[0].start);
  EXPECT_GT(recorder.positions[26].x(), 1e-5);
}

TEST(ClosedLoopRun, WhatIsLostNeverArrives) {
  Mission mission = twoUavs(1.0);
  mission.parameters.simulation.drop = 1.0;
  StraightPlanner planner(2);
  Recorder recorder;
  ClosedLoopRun(mission, planner, 0).fly({&recorder});
  for (const Snapshot& snapshot : planner.snapshots) {
    EXPECT_FALSE(snapshot.uavs[0].received);
    EXPECT_TRUE(snapshot.obstacles.empty());
  }
  EXPECT_EQ(recorder.positions.back(), mission.scenario.uavs[0].start);
}

TEST(ClosedLoopRun, RepeatedTrajectoriesGetThroughWhereMessagesAreLost) {
  constexpr int kFlights = 400;
  const auto lost = [](int repeats) {
    Mission mission = twoUavs(0.2);  // one cycle's trajectory alone is due by then
    mission.parameters.simulation.drop = 0.5;
    mission.parameters.input.setpoint_repeats = repeats;
    int waiting = 0;
    for (std::uint64_t seed = 0; seed < kFlights; ++seed) {
      StraightPlanner planner(2);
      Recorder recorder;
      ClosedLoopRun(mission, planner, seed).fly({&recorder});
      waiting += recorder.positions.back() == mission.scenario.uavs[0].start ? 1 : 0;
    }
    return static_cast<double>(waiting) / kFlights;
  };
  // Four standard deviations of the share of so many flights.
  EXPECT_NEAR(lost(0), 0.5, 0.1);
  EXPECT_NEAR(lost(1), 0.25, 0.09);
  EXPECT_NEAR(lost(3), 0.0625, 0.05);
}

TEST(ClosedLoopRun, LossesAndJitterMakeTheNewestMessageOlder) {
  Mission mission = twoUavs(60.0);
  mission.parameters.simulation.latency = 0.1;
  mission.parameters.simulation.drop = 0.5;
  double oldest = 0.0, mean = 0.0, difference = 0.0;
  const std::vector<Snapshot> snapshots = hoveringSnapshots(mission, 1);
  for (const Snapshot& snapshot : snapshots) {
    const double age = snapshot.now - snapshot.uavs[0].stamp;
    EXPECT_GT(age, 0.1 - 1e-9);
    oldest = std::max(oldest, age);
    mean += age / static_cast<double>(snapshots.size());
    difference = std::max(difference, std::abs(snapshot.uavs[0].stamp - snapshot.uavs[1].stamp));
  }
  // A message every 0.02 s: the newest that arrives is on average one older, and now and then several.
  EXPECT_NEAR(mean, 0.12, 4.0 * 0.02 * std::sqrt(2.0 / static_cast<double>(snapshots.size())));
  EXPECT_GT(oldest, 0.159);
  EXPECT_GT(difference, 0.0);  // every UAV has its own losses

  mission.parameters.simulation.drop = 0.0;
  mission.parameters.simulation.jitter = 0.2;
  double last = -1e9;
  for (const Snapshot& snapshot : hoveringSnapshots(mission, 1)) {
    EXPECT_GE(snapshot.uavs[0].stamp, last);
    EXPECT_LT(snapshot.now - snapshot.uavs[0].stamp, 0.3 + 0.02 + 1e-9);
    last = snapshot.uavs[0].stamp;
  }
}

TEST(ClosedLoopRun, LossesAndLatencyLeaveTheNoiseOfEachMessageAlone) {
  Mission mission = twoUavs(3.0);
  mission.parameters.simulation.position_noise = 0.05;
  const std::vector<Snapshot> all = hoveringSnapshots(mission, 1);
  mission.parameters.simulation.drop = 0.05;
  const std::vector<Snapshot> some = hoveringSnapshots(mission, 1);
  mission.parameters.simulation.drop = 0.0;
  mission.parameters.simulation.latency = 0.2;
  const std::vector<Snapshot> late = hoveringSnapshots(mission, 1);
  // The vehicles hover: odometry is their start plus noise.
  ASSERT_EQ(some.size(), all.size());
  ASSERT_EQ(late.size(), all.size());
  int same = 0;
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_LT((late[n].uavs[0].p - all[n].uavs[0].p).norm(), 1e-9);
    for (std::size_t uav = 0; uav < 2; ++uav) {
      if (some[n].uavs[uav].stamp != all[n].uavs[uav].stamp) continue;
      EXPECT_EQ(some[n].uavs[uav].p, all[n].uavs[uav].p);
      ++same;
    }
  }
  EXPECT_GT(same, 0);
}

}  // namespace
}  // namespace swarm_planner
