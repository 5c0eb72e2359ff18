// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/experiments/processor_clock.hpp"
#include "swarm_planner/swarm/flight_memory.hpp"
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
  /// Goes on as a new process would that knows the mission, and with `record` what the one before had committed. A
  /// planner that remembers nothing has nothing to forget.
  virtual void restart(bool /*record*/) {}
  /// Processor time of this thread that the last cycle took [s]; 0 where nobody measures it.
  virtual double processorTime() const { return 0.0; }
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
    const ProcessorClock clock;
    const CycleReport& report = planner_.plan(snapshot, epoch);
    processor_time_ = clock.elapsed();
    remember(planner_, snapshot.obstacles.size(), memory_);
    return report;
  }
  const CommittedMotion& committed(std::size_t uav) const override { return planner_.committed(uav); }
  void restart(bool record) override {
    const bool in_flight = planner_.report().started;
    planner_ = SwarmPlanner(mission_, mode_);
    if (record && in_flight) planner_.takeOver(memory_);
  }
  double processorTime() const override { return processor_time_; }

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
  FlightMemory memory_;
  double processor_time_ = 0.0;
};

/// Problem 2.
class IterativePlanner : public SwarmCyclePlanner {
 public:
  explicit IterativePlanner(const Mission& mission) : SwarmCyclePlanner(mission, PlanningMode::kIterative) {}
};

}  // namespace swarm_planner
