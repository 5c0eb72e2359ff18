// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/simulation/closed_loop_cost.hpp"
#include "swarm_planner/simulation/flight_watch.hpp"
#include "swarm_planner/simulation/map_watch.hpp"
#include "swarm_planner/simulation/obstacle_watch.hpp"
#include "swarm_planner/simulation/pair_watch.hpp"
#include "swarm_planner/simulation/progress_watch.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// Truth about one vehicle at one instant.
struct UavSample {
  Vector3 p = Vector3::Zero();     ///< [m]
  Vector3 v = Vector3::Zero();     ///< [m/s]
  double tracking_error = 0.0;     ///< distance from its setpoint [m]
  Vector3 jerk = Vector3::Zero();  ///< rate of the control, that of its setpoint [m/s^3]
};

/// Mean and maximum of a quantity.
struct MeanMax {
  double mean = 0.0;
  double max = 0.0;
};

/// Stands for the map in place of an obstacle's index.
constexpr std::size_t kMapPartner = std::numeric_limits<std::size_t>::max();

/// A UAV came too close to something: one entry however long it lasted.
struct Collision {
  double time = 0.0;    ///< when it began [s]
  std::size_t uav = 0;  ///< index
  bool with_obstacle = false;
  std::size_t partner = 0;  ///< index of the other UAV or of the obstacle, or kMapPartner
};

/// What a run did, measured on the simulated vehicles. Empty: there was no partner to measure against.
struct RunSummary {
  std::optional<double> min_uav_distance;  ///< centre to centre [m]
  /// Centre to surface S = 1, or to an occupied voxel of the map, minus uav_radius [m].
  std::optional<double> min_obstacle_clearance;
  std::vector<Collision> collisions;  ///< in the order in which they began
  MeanMax final_lag;                  ///< over the UAVs, see ProgressWatch [m]
  int stuck_uavs = 0;
  int arrived_uavs = 0;
  double mission_time = 0.0;       ///< of the last sample [s]
  double path_length = 0.0;        ///< flown by all UAVs together [m]
  MeanMax tracking_error;          ///< over UAVs and samples [m]
  int workspace_violations = 0;    ///< episodes of a UAV outside the workspace
  double cost = 0.0;               ///< (15): the integral of (16) along the flown motion, over all UAVs
  bool timed_out = false;          ///< all_at_goal was not reached
  std::vector<UavFlight> flights;  ///< of each UAV
};

/// Measures a run as INTERFACES "Experiment program" defines it. Feed it every 10 ms or finer.
class RunMonitor {
 public:
  explicit RunMonitor(const Mission& mission);

  /// What is mapped has changed, from the next instant on; null: nothing is.
  void setMap(const std::shared_ptr<const VoxelMap>& map);

  /// One instant: `t` [s] since t = 0 of the run, not earlier than the last; the vehicles in the scenario's order and
  /// the obstacles where they truly are (any fixed order and number). Throws std::invalid_argument if the number of
  /// vehicles is not the scenario's.
  void observe(double t, const std::vector<UavSample>& uavs, const std::vector<Superellipsoid>& obstacles);

  /// True from the sample on at which the scenario's end condition held.
  bool ended() const { return ended_; }

  /// Lag of a UAV at the last sample [m].
  double lag(std::size_t uav) const { return progress_.lag(uav); }

  /// Everything up to the last sample.
  RunSummary summary() const;

 private:
  void watchWorkspace();
  void integrateCost(const std::vector<UavSample>& uavs, const std::vector<Superellipsoid>& obstacles);
  bool endConditionHolds();

  Scenario scenario_;
  double time_ = 0.0;
  std::size_t samples_ = 0;
  bool ended_ = false;
  bool timed_out_ = false;
  std::vector<Vector3> positions_;
  std::vector<Vector3> velocities_;
  std::vector<bool> outside_;
  int workspace_violations_ = 0;
  double path_length_ = 0.0;
  double tracking_error_sum_ = 0.0;
  double tracking_error_max_ = 0.0;
  std::vector<Collision> collisions_;
  PairWatch pairs_;
  ObstacleWatch obstacles_;
  MapWatch map_;
  ProgressWatch progress_;
  FlightWatch flights_;
  ClosedLoopCost cost_;
};

}  // namespace swarm_planner
