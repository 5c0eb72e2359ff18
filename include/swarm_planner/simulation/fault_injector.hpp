// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swarm_planner/simulation/quad_simulator.hpp"
#include "swarm_planner/simulation/random_stream.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// Makes things go wrong in a simulation, at the times that a scenario or a service says.
///
/// The simulation tells the time by advanceTo() and asks what is left of its messages; without faults everything passes
/// as it is. Faults of one UAV may overlap: offsets and winds add up, and what is lost is lost. Directions are
/// horizontal and, like the tracks that are missing, random from the seed.
class FaultInjector {
 public:
  /// Nothing is scheduled. `seed` is that of the run.
  FaultInjector(const Mission& mission, std::uint64_t seed);

  /// The scenario's faults, with t = 0 of the run at `time_zero` [s]; replaces those of an earlier time zero.
  void scheduleScenario(double time_zero);
  /// fault.at counts from `now` [s]. Throws std::invalid_argument if there is no such UAV.
  void schedule(const FaultInjection& fault, double now);
  /// Forgets every fault (time has jumped).
  void clear();

  /// What follows is as at `t` [s], not before the last one.
  void advanceTo(double t);

  /// What is left of an odometry message; false: it is lost. `state` is the attitude that the message bears.
  bool spoilOdometry(std::size_t uav, UavMeasurement& measurement, QuadState& state);
  /// Whether setpoints that arrive now get through to the vehicle, and are flown.
  bool setpointsReach(std::size_t uav) const;
  /// Kicks, blows at or stops the vehicle. Call it after every advanceTo().
  void disturb(std::size_t uav, QuadSimulator& vehicle);
  /// Whether a message of obstacle tracks gets through.
  bool tracksArrive() const;
  /// Whether one track is in a message. Each call draws anew while tracks flicker.
  bool trackIsSeen();
  bool plannerLives() const;

 private:
  struct Fault {
    FaultKind kind = FaultKind::kOdometryLost;
    std::size_t uav = 0;
    double begin = 0.0, end = 0.0;  ///< [s]
    double magnitude = 0.0;
    Vector3 direction = Vector3::Zero();
    bool of_scenario = false;
    bool done = false;  ///< what is done once, at the beginning
    UavMeasurement frozen;
    QuadState frozen_state;
  };

  void schedule(const FaultInjection& fault, double now, bool of_scenario);
  bool isActive(FaultKind kind) const;
  bool isActive(FaultKind kind, std::size_t uav) const;

  std::vector<FaultInjection> scenario_faults_;
  std::vector<std::string> names_;
  Vector3 drag_over_mass_;  ///< [1/s]
  RandomStream directions_, flicker_;
  std::vector<Fault> pending_;  ///< by beginning, the next one last
  std::vector<Fault> active_;
  std::vector<Vector3> wind_;  ///< that blows at each UAV [m/s]
  double time_ = 0.0;          ///< [s]
};

}  // namespace swarm_planner
