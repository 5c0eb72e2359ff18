// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/plan_check.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {

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

  // The same in steps, for a solver that plans for several UAVs at once, each with a UavPlanner of its own.

  /// Looks at what there is to keep clear of. False if the UAV rests and needs no plan: that is reported.
  bool begin(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);
  /// Poses the problem without the bodies of the UAVs that are solved with it, and a plan to start from.
  void pose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
            const std::vector<bool>& solved_together, Trajectory& start_plan);
  const UavProblem& problem() const { return problem_; }
  /// The motion of the solver's plan, its stop included; not checked.
  const CommittedMotion& draft(const Trajectory& plan);
  /// Whether the draft passes the check among what the surroundings hold now.
  bool passes(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings);
  /// Commits the draft, which has passed.
  void commitDraft(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings,
                   const SqpResult& result, UavReport& report);
  /// Goes on from the solver's plan as plan() does from its own.
  void complete(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, const SqpResult& result,
                UavReport& report);

 private:
  void lookAround(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings);
  /// A new plan, or what flies without one; the reason why it does. `joint`: how the plan at hand was found, if it was.
  Reason flyOn(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
               const SqpResult* joint, UavReport& report);
  /// Tells the surroundings and the operator what the UAV does.
  void conclude(std::size_t uav, double epoch, UavRecord& record, Surroundings& surroundings, UavReport& report);
  /// The plan to start from: that of the motion flown, moved on.
  void shift(double epoch, UavRecord& record);
  /// Goes on with the quickest stop from the motion flown, or with the rest on the ground, while that is clear. False
  /// if it is not, or there is none: a plan is needed then.
  bool rest(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings);
  /// Solves from record.start and leaves the motion of the longest step towards the solution that passes the check.
  CheckVerdict propose(std::size_t uav, double epoch, UavRecord& record, const Surroundings& surroundings,
                       UavReport& report);
  static void takeResult(const SqpResult& result, UavReport& report);
  /// Leaves the motion of the longest step towards plan_ that passes the check.
  CheckVerdict decide(std::size_t uav, double epoch, const UavRecord& record, const Surroundings& surroundings,
                      const SqpResult& result, UavReport& report);
  CheckVerdict judge(std::size_t uav, const Surroundings& surroundings, const Trajectory& plan);
  /// The workspace for this cycle: down to the ground for landing; for a UAV that is outside no farther than the motion
  /// flown takes it anyway, so that it may come back.
  void setWorkspace(const UavRecord& record);
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
  const Workspace workspace_;  ///< of the scenario, unbounded if it has none [m]
  UavProblem problem_;
  SqpSolver sqp_;
  CheckSurroundings check_;
  double lag_ = 0.0;                     ///< of the start behind the target, along the path [m]
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
