// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// Whatever plans for a swarm once a cycle: the ways to do so are compared in the same closed loop.
class CyclePlanner {
 public:
  virtual ~CyclePlanner() = default;

  /// New plans that start at `epoch` >= snapshot.now. The report is valid until the next call.
  virtual const CycleReport& plan(const Snapshot& snapshot, double epoch) = 0;
  /// What a UAV is to fly, its stop included; meaningful where the report says `planned`.
  virtual const CommittedMotion& committed(std::size_t uav) const = 0;
  /// Goes on as a new process would that knows the mission alone. A planner without memory has nothing to forget.
  virtual void restart() {}
};

/// Problem 2, one UAV after the other, or Problem 1, all at once.
class SwarmCyclePlanner : public CyclePlanner {
 public:
  /// `mission` must outlive the planner.
  SwarmCyclePlanner(const Mission& mission, PlanningMode mode)
      : mission_(mission), mode_(mode), planner_(mission, mode) {}

  const CycleReport& plan(const Snapshot& snapshot, double epoch) override {
    // Guides of one cycle are used in the next, whatever their search takes: a run can be repeated.
    planner_.searchGuides();
    return planner_.plan(snapshot, epoch);
  }
  const CommittedMotion& committed(std::size_t uav) const override { return planner_.committed(uav); }
  void restart() override { planner_ = SwarmPlanner(mission_, mode_); }

  /// See SwarmPlanner::setReference().
  void setReference(std::size_t uav, const std::vector<Vector3>& path, double start, double speed) {
    planner_.setReference(uav, path, start, speed);
  }
  /// See SwarmPlanner::command().
  CommandAnswer command(std::size_t uav, FlightCommand command) { return planner_.command(uav, command); }

 private:
  const Mission& mission_;
  PlanningMode mode_;
  SwarmPlanner planner_;
};

/// Problem 2.
class IterativePlanner : public SwarmCyclePlanner {
 public:
  explicit IterativePlanner(const Mission& mission) : SwarmCyclePlanner(mission, PlanningMode::kIterative) {}
};

}  // namespace swarm_planner
