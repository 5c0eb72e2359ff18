// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// What is kept of one UAV from cycle to cycle.
struct UavRecord {
  std::string name;
  MovingTarget reference;
  bool reference_pending = true;  ///< its time zero is the next epoch
  bool on_reference = false;      ///< progress holds
  double progress = 0.0;          ///< arc length of the foot of the last start [m]
  int plans = 0;                  ///< how many of committed, previous hold
  Trajectory committed;
  Trajectory previous;
  KinematicState start;  ///< of the plan in work, at its epoch
  ActiveRows active;     ///< of the last QP, at `active_epoch`
  double active_epoch = 0.0;

  void setReference(const std::vector<Vector3>& path, double arc_length, double speed);
  /// Forgets all plans; the reference starts anew.
  void reset();
  /// Whether the newest plan reaches to time `t` [s]; a UAV whose plan has ended rests.
  bool isFlyingPlanAt(double t) const { return plans > 0 && t <= committed.epoch + committed.duration(); }
  /// Predicts where the UAV will be at `epoch`, from its plan and `measurement`.
  void predictStart(const UavMeasurement& measurement, double epoch, double tracking_time);
  /// The negative control: takes position and velocity at `epoch` to be those of `measurement`, however old it is.
  void startAsMeasured(const UavMeasurement& measurement, double epoch);
};

/// Plans for one UAV at a time: poses its problem, solves it, commits the plan, reports. Holds the memory that this
/// takes, so that every thread needs one of its own.
class UavPlanner {
 public:
  /// `tables`: of makeQpModels(parameters). At most `max_bodies` obstacles and UAVs before memory has to grow.
  /// `parameters` must outlive this.
  UavPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
             std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies);

  /// A plan for `epoch` from record.start on. `uav`: its index in `surroundings`, which learns of the new plan.
  void plan(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);

 private:
  /// What was active in the last plan's QP, moved on to `epoch`.
  void guessActiveRows(double epoch, UavRecord& record) const;
  void poseProblem(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);

  const Parameters& parameters_;
  UavProblem problem_;
  SqpSolver sqp_;
  Trajectory plan_;  ///< in work
};

}  // namespace swarm_planner
