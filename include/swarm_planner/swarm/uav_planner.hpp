// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/motion_memory.hpp"
#include "swarm_planner/swarm/plan_check.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"
#include "swarm_planner/swarm/takeover.hpp"

namespace swarm_planner {

/// What is kept of one UAV from cycle to cycle.
struct UavRecord {
  std::string name;
  MovingTarget reference;
  double given_start = 0.0;       ///< of the reference, as set [m]
  bool reference_pending = true;  ///< its time zero is the next epoch
  bool on_reference = false;      ///< progress holds
  double progress = 0.0;          ///< arc length of the foot of the last start [m]
  MotionMemory motions;           ///< a rest where it was measured before its first plan
  bool planned = false;           ///< the newest motion comes from a plan
  Beginning beginning;            ///< how it comes to be planned for
  KinematicState start;           ///< of the plan in work, at its epoch
  /// From what it is to fly, as measured; the mean over some cycles, in which noise is averaged [m].
  Vector3 deviation = Vector3::Zero();
  ActiveRows active;  ///< of the last QP, at `active_epoch`
  double active_epoch = 0.0;

  void setReference(const std::vector<Vector3>& path, double arc_length, double speed);
  /// Forgets all motions; the reference starts anew.
  void reset();
  /// Takes the measurement in: what the UAV flies, and where it will be at `epoch`.
  void predictStart(const UavMeasurement& measurement, double epoch, const Parameters& parameters);
};

/// Plans for one UAV at a time: poses its problem, solves it, has the plan checked, commits it or falls back, reports.
/// Holds the memory that this takes, so that every thread needs one of its own.
class UavPlanner {
 public:
  /// `tables`: of makeQpModels(parameters). At most `max_bodies` obstacles and UAVs before memory has to grow.
  /// `parameters` must outlive this.
  UavPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
             std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies);

  /// A motion for `epoch` from record.start on. `uav`: its index in `surroundings`, which learns of the new motion.
  void plan(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);

 private:
  /// Solves from record.start and leaves the motion of the longest step towards the solution that passes the check.
  CheckVerdict propose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                       UavReport& report);
  CheckVerdict judge(std::size_t uav, const Surroundings& surroundings, const Trajectory& plan);
  /// Without a plan that passed: what flies, and why.
  Reason fallBack(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);
  void fillReport(double epoch, const UavRecord& record, UavReport& report);

  /// What was active in the last plan's QP, moved on to `epoch`.
  void guessActiveRows(double epoch, UavRecord& record) const;
  void poseProblem(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);

  const Parameters& parameters_;
  CheckLimits limits_;
  UavProblem problem_;
  SqpSolver sqp_;
  CheckSurroundings check_;
  Vector3 committed_ = Vector3::Zero();  ///< where the motion flown is at the epoch [m]

  Trajectory plan_;                ///< in work
  Trajectory shifted_;             ///< the motion flown, from the start in work on
  Trajectory step_;                ///< between the two
  CommittedMotion motion_;         ///< of the plan that is checked
  CommittedMotion proposed_;       ///< of the solver's own plan, if it was refused
  bool flies_whole_plan_ = false;  ///< the solver's plan passed as it is
  bool has_proposal_ = false;
  double proposal_conflict_ = 0.0;  ///< when it was refused for what happens at its rest [s]
  CommittedMotion kept_;
  CommittedMotion stop_;
};

}  // namespace swarm_planner
