// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/flight_task.hpp"
#include "swarm_planner/swarm/motion_doubt.hpp"
#include "swarm_planner/swarm/motion_memory.hpp"
#include "swarm_planner/swarm/odometry_monitor.hpp"
#include "swarm_planner/swarm/plan_check.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"
#include "swarm_planner/swarm/takeover.hpp"

namespace swarm_planner {

/// What is kept of one UAV from cycle to cycle.
struct UavRecord {
  std::string name;
  MovingTarget reference;
  double given_start = 0.0;       ///< of the reference as it was given: pauses move reference.start on [m]
  bool reference_pending = true;  ///< its time zero is the next epoch
  bool on_reference = false;      ///< progress holds
  double progress = 0.0;          ///< arc length of the foot of the last start [m]
  MotionMemory motions;           ///< a rest where it was measured before its first plan
  bool planned = false;           ///< the newest motion comes from a plan
  Beginning beginning;            ///< how it comes to be planned for
  KinematicState start;           ///< of the plan in work, at its epoch
  /// From what it is to fly, as measured; the mean over some cycles, in which noise is averaged [m].
  Vector3 deviation = Vector3::Zero();
  FlightTask task;    ///< what it is to do, as commands left it
  ActiveRows active;  ///< of the last QP, at `active_epoch`
  double active_epoch = 0.0;
  OdometryMonitor monitor;
  bool foreign = false;  ///< another system flies it
  bool unseen = false;   ///< its odometry could not be planned from in the last cycle, or it has joined since
  std::optional<Vector3> last_place;  ///< while unseen: where it was seen last, if that was not on its motion [m]
  bool off_plan = false;              ///< planned for anew in this cycle: it was far off its motion for long
  double off_plan_distance = 0.0;     ///< so far [m]

  void setReference(const std::vector<Vector3>& path, double arc_length, double speed);
  /// The target stays where it is at `t` [s], until its time zero is set anew.
  void pauseReference(double t) {
    if (!reference_pending) reference.start = reference.at(t).arc_length;
    reference_pending = true;
  }
  /// Forgets all motions, and with them what it holds at; the reference starts anew. Its mode stays.
  void reset();
  /// Takes the measurement in: what the UAV flies, and where it will be at `epoch`. Where it is not on its motion, its
  /// plan starts from the measurement, and until there is one it is to brake. `bounds`: that a stop should keep.
  void predictStart(const UavMeasurement& measurement, double epoch, const Parameters& parameters,
                    const FlightBounds& bounds);
  /// From the next cycle on another system flies it, or this one again.
  void setForeign(bool is_foreign);
  /// Whether it may still fly what it was to fly, as measured: near it, and that has not ended.
  bool isOnMotion(const UavMeasurement& measurement, const Parameters& parameters) const;
  void forgetMotions();
  /// Its odometry cannot be planned from in this cycle.
  void loseSight(const Parameters& parameters);
  /// How far it may be from its motion while it is not seen.
  MotionDoubt doubt(const InputParameters& input) const;

 private:
  void startAnew(const UavMeasurement& measurement, double epoch, const Parameters& parameters,
                 const FlightBounds& bounds);
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
  /// A new plan, or what flies without one; the reason why it does.
  Reason flyOn(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings, UavReport& report);
  /// Goes on with the quickest stop from the motion flown, or with the rest on the ground, while that is clear. False
  /// if it is not, or there is none: a plan is needed then.
  bool rest(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);
  /// Solves from record.start and leaves the motion of the longest step towards the solution that passes the check.
  CheckVerdict propose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                       UavReport& report);
  CheckVerdict judge(std::size_t uav, const Surroundings& surroundings, const Trajectory& plan);
  /// Of UAVs that are not seen, the motion flown now may already be nearer than their doubt allows: so much is demanded
  /// of a plan as that motion has.
  void limitDoubts(double epoch, const CommittedMotion& flown);
  /// Without a plan that passed: what flies, and why.
  Reason fallBack(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);
  void fillReport(double epoch, const UavRecord& record, UavReport& report);

  /// What was active in the last plan's QP, moved on to `epoch`.
  void guessActiveRows(double epoch, UavRecord& record) const;
  void poseProblem(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);

  const Parameters& parameters_;
  CheckLimits limits_;
  double workspace_floor_;  ///< [m]
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
