// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/swarm/committed_motion.hpp"
#include "swarm_planner/swarm/cycle_report.hpp"
#include "swarm_planner/swarm/flight_commands.hpp"
#include "swarm_planner/swarm/flight_memory.hpp"
#include "swarm_planner/swarm/mission.hpp"
#include "swarm_planner/swarm/planning_mode.hpp"
#include "swarm_planner/swarm/snapshot.hpp"

namespace swarm_planner {

/// Plans for every UAV: Problem 2, one after the other with the other UAVs' plans held fixed, or Problem 1, all at
/// once. Nothing in plan() throws, or allocates on the heap unless a snapshot has more obstacles than max_tracks.
class SwarmPlanner {
 public:
  /// Throws std::invalid_argument with planningModeFault() for what the mode cannot plan for.
  explicit SwarmPlanner(const Mission& mission, PlanningMode mode = PlanningMode::kIterative);
  ~SwarmPlanner();
  SwarmPlanner(SwarmPlanner&&) noexcept;
  SwarmPlanner& operator=(SwarmPlanner&&) noexcept;

  std::size_t uavCount() const;
  const std::string& uavName(std::size_t uav) const;

  /// One cycle: new plans that start at `epoch` >= snapshot.now, given in the snapshot's time base. UAVs whose turn has
  /// not come after `budget` seconds of wall clock go on with their committed motions, and are the first in the next
  /// cycle.
  const CycleReport& plan(const Snapshot& snapshot, double epoch,
                          double budget = std::numeric_limits<double>::infinity());
  /// Searches ways round what blocks references, as the last cycle left it to be done; without it UAVs fly without
  /// guides. To be called after each plan(), on any thread: a cycle meanwhile neither waits nor is disturbed, and one
  /// after it uses what was found. Calls one at a time. Called between cycles it makes runs that can be repeated. False
  /// if there was nothing to do.
  bool searchGuides();
  const CycleReport& report() const;

  /// What a UAV is to fly, its stop included; meaningful where report().uavs[uav].planned.
  const CommittedMotion& committed(std::size_t uav) const;
  /// Where the UAV's target is at time `t`; before t = 0 of the run at its start.
  TargetState target(std::size_t uav, double t) const;
  const MovingTarget& reference(std::size_t uav) const;

  /// What the UAV flies along in place of its reference because that is blocked; null if there is nothing like that.
  const ReferencePath* guide(std::size_t uav) const;

  /// Replaces a UAV's reference; its time zero is the next epoch. `path` of 1 to kMostPathPoints plausible
  /// points, start >= 0 finite, 0 <= speed <= kMostSpeed; throws std::invalid_argument with the reason otherwise. Call
  /// it between cycles. While the UAV does not fly its mission, the time zero waits until it does.
  void setReference(std::size_t uav, const std::vector<Vector3>& path, double start, double speed);

  /// What a UAV is to do from the next cycle on. Any command in any state; call it between cycles.
  CommandAnswer command(std::size_t uav, FlightCommand command);
  FlightMode mode(std::size_t uav) const;

  /// Whether another system flies a UAV (at first: what the scenario says). Nobody plans for it then, it is not waited
  /// for at the start, and the others avoid it from its odometry; what it was to fly here they keep clear of until
  /// odometry shows it elsewhere. One that comes back is planned for from the next cycle on, from where it is measured.
  /// Call it between cycles. Throws std::invalid_argument if there is no such UAV. The same as the commands to leave
  /// and to join.
  void setForeign(std::size_t uav, bool foreign);
  bool isForeign(std::size_t uav) const;

  /// Arc length of the foot of the newest start on the UAV's reference [m].
  double progress(std::size_t uav) const;

  /// Goes on with the run of a planner that is gone, instead of starting one. Before the first cycle.
  void takeOver(const FlightMemory& memory);
  /// The mode in which a planner that is gone has left a UAV. Before the first cycle.
  void restoreMode(std::size_t uav, FlightMode mode);

  /// Forgets plans, tracks and time zero (a backward jump of time). References stay as given, also those set later, and
  /// so do the UAVs' modes.
  void reset();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swarm_planner
