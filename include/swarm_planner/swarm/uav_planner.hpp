// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/mapped_space.hpp"
#include "swarm_planner/swarm/plan_check.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {

/// Changes of the active set per UAV and QP: where a crowd leaves no way, hundreds would go into rows that stay
/// violated. The step as far as it has come is judged by the merit, and the next QP goes on from its active rows.
constexpr int kMostQpChanges = 60;

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

  /// For a UAV whose turn does not come any more: its motion goes on if that still passes the check. Otherwise it
  /// brakes, or flies what falls short least.
  void goOn(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);

  /// For a UAV that is not seen: its motion goes on if that still passes the check. Otherwise a plan to where it was to
  /// rest, from where its motion has it, or what flies without a plan. report.planned only if it has a new motion.
  void keepClear(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);

  // plan() in steps, for a solver that plans for several UAVs at once, each with a UavPlanner of its own.

  /// Looks at what there is to keep clear of. False if the UAV rests and needs no plan: that is reported.
  bool begin(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);
  /// Poses the problem without the bodies of the UAVs that are solved with it, and a plan to start from.
  void pose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
            const std::vector<bool>& solved_together, Trajectory& start_plan);
  const UavProblem& problem() const { return problem_; }
  /// Another plan to start from: where the guide alone would lead.
  SqpResult leadAlongGuide(UavRecord& record, Trajectory& start_plan);
  /// The motion of the solver's plan with the stop that suits what there was to keep clear of at begin().
  const CommittedMotion& draft(std::size_t uav, const Trajectory& plan, const UavRecord& record,
                               const Surroundings& surroundings);
  /// Whether the draft as it is passes the check among what the surroundings hold now.
  bool passesAsDrafted(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings);
  /// Whether it does with the stop that suits what they hold now.
  bool passes(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings);
  /// Commits the draft, which has passed.
  void commitDraft(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                   const SqpResult& result, UavReport& report);
  /// Plans as plan() does instead of flying the draft, which has not passed. `result`: in vain, but to be reported.
  void planAnew(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, const SqpResult& result,
                UavReport& report);

 private:
  /// What all of the above begin with.
  void survey(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings);
  void publish(std::size_t uav, double epoch, const UavRecord& record, Surroundings& surroundings) const;
  /// Solves for a rest at `place`, with all that propose() does. True if a plan is committed.
  bool goTo(const Vector3& place, std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
            UavReport& report);
  /// Goes to beside the way of the obstacle that will come to where `kept_` rests. True if a plan is committed.
  bool giveWay(const CheckVerdict& verdict, std::size_t uav, double epoch, UavRecord& record,
               const Surroundings& surroundings, UavReport& report);
  /// Tells the surroundings and the operator what the UAV does.
  void conclude(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);
  /// A new plan, or what flies without one; the reason why it does.
  Reason flyOn(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings, UavReport& report);
  /// Goes on with the quickest stop from the motion flown, or with the rest on the ground, while that is clear. False
  /// if it is not, or there is none: a plan is needed then.
  bool rest(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);
  /// Solves from record.start and leaves the motion of the longest step towards the solution that passes the check.
  CheckVerdict propose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                       UavReport& report);
  /// The plan to start from: that of the motion flown, moved on.
  void startFromFlown(double epoch, UavRecord& record);
  void takeResult(const SqpResult& result, UavRecord& record, UavReport& report) const;
  /// Leaves the motion of the longest step towards the plan in work that passes the check.
  CheckVerdict decide(std::size_t uav, UavRecord& record, const Surroundings& surroundings, const SqpResult& result,
                      UavReport& report);
  /// To `along_`, without anything to keep clear of but the map, in a corridor that is about the path at first. Leaves
  /// the one about the answer.
  SqpResult solveGuideAlone(UavRecord& record);
  /// Solves once more, from where the guide alone would lead: the better of the two solutions stays.
  void solveAlongGuide(UavRecord& record, SqpResult& result);
  /// The QP has no rows for the jerk: a plan that asks for too much of it is shortened towards the motion flown.
  void keepJerkLimit(const KinematicState& start);
  /// Leaves the plan's motion: with the quickest stop or, if an obstacle comes to where that ends, with one beside the
  /// obstacle's way, if that passes.
  CheckVerdict judge(std::size_t uav, const Surroundings& surroundings, const Trajectory& plan);
  /// The stop of a plan that was refused with `verdict` for where it rests. True if its motion passes the check: it is
  /// left then.
  bool stopBeside(const CheckVerdict& verdict, const Trajectory& plan);
  /// The workspace for this cycle: down to the ground for landing; for a UAV that is outside no farther than the motion
  /// flown takes it anyway, so that it may come back.
  void setWorkspace(const UavRecord& record);
  /// Without a plan that passed: what flies, and why.
  Reason fallBack(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                  UavReport& report);
  /// Braking at once if that passes the check. Otherwise what falls short least: `kept` is the verdict on `kept_`.
  Reason brake(const CheckVerdict& kept, std::size_t uav, double epoch, UavRecord& record,
               const Surroundings& surroundings);
  void fillReport(double epoch, const UavRecord& record, UavReport& report);

  /// What was active in the last plan's QP, moved on to `epoch`.
  void guessActiveRows(double epoch, UavRecord& record) const;
  void poseProblem(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);

  const Parameters& parameters_;
  CheckLimits limits_;
  const Workspace workspace_;  ///< of the scenario, unbounded if it has none [m]
  UavProblem problem_;
  MappedSpace mapped_;
  SqpSolver sqp_;
  CheckSurroundings check_;
  double lag_ = 0.0;                     ///< of the start behind the target, along the path [m]
  Vector3 committed_ = Vector3::Zero();  ///< where the motion flown is at the epoch [m]

  Trajectory plan_;     ///< in work
  Trajectory shifted_;  ///< the motion flown, from the start in work on
  Trajectory step_;     ///< a part of the plan
  Trajectory along_;    ///< solved from where the guide alone leads
  ActiveRows along_active_;
  std::vector<MovingBody> no_bodies_;
  CommittedMotion motion_;         ///< of the plan that is checked
  CommittedMotion beside_;         ///< the same with another stop
  bool keeps_bounds_ = false;      ///< the draft does
  CommittedMotion proposed_;       ///< of the solver's own plan, if it was refused
  bool flies_whole_plan_ = false;  ///< the solver's plan passed as it is
  bool has_proposal_ = false;
  double proposal_conflict_ = 0.0;  ///< when it was refused for what happens at its rest [s]
  CommittedMotion kept_;
  CommittedMotion stop_;
  MovingTarget detour_;  ///< a place to rest at instead of what the UAV is to follow
  bool on_detour_ = false;
};

}  // namespace swarm_planner
