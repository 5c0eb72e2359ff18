// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// A mission of UAVs that fly from `starts[i]` to `ends[i]` behind a target of `speed` [m/s]. Not checked: tests start
/// UAVs where no scenario may.
Mission makeTestMission(const std::vector<Vector3>& starts, const std::vector<Vector3>& ends, double speed);

/// Two UAVs on parallel lines along x, 10 m apart.
Mission twoAbreast();

/// Two UAVs that would meet at (0, 0, 10) at a right angle.
Mission crossingPair();

/// Every UAV at rest at its start.
Snapshot snapshotOf(const Mission& mission, double now);

/// Whether two motions are the same, bit by bit.
bool identical(const CommittedMotion& a, const CommittedMotion& b);

/// Flies a mission in closed loop by vehicles that follow their motions perfectly, as a lossless link would have it. A
/// vehicle that gets no new one flies the last one to its end and rests there.
class PerfectFlight {
 public:
  explicit PerfectFlight(const Mission& mission, double start_time = 0.0, PlanningMode mode = PlanningMode::kIterative);

  /// One cycle: measure, plan for the next epoch within `budget` [s], fly until then. `tamper` may spoil the snapshot
  /// before.
  const CycleReport& cycle(const std::function<void(Snapshot&)>& tamper = nullptr,
                           double budget = std::numeric_limits<double>::infinity());
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }

  SwarmPlanner& planner() { return planner_; }
  double now() const { return now_; }
  /// State of a vehicle at time `t`, at or after the last epoch.
  KinematicState vehicle(std::size_t uav, double t) const;
  KinematicState vehicle(std::size_t uav) const { return vehicle(uav, now_); }
  /// Obstacle as its track says it is at `t`.
  Superellipsoid obstacle(std::size_t index, double t) const;

  /// Least over the whole flight, sampled 20 times a cycle: pair gauge without margin (below 1: a collision) and
  /// distance of a centre from an obstacle's surface [m].
  double leastPairGauge() const { return least_pair_gauge_; }
  double leastObstacleDistance() const { return least_obstacle_distance_; }

 private:
  void measure();
  void watch(double from, double to);

  Mission mission_;
  SwarmPlanner planner_;
  Snapshot snapshot_;
  double start_time_;
  double now_;
  std::vector<std::optional<CommittedMotion>> flown_;
  double least_pair_gauge_ = std::numeric_limits<double>::infinity();
  double least_obstacle_distance_ = std::numeric_limits<double>::infinity();
};

}  // namespace swarm_planner
