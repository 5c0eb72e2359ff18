// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "swarm_planner/problem/joint_problem.hpp"
#include "swarm_planner/solver/joint_qp.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"

namespace swarm_planner {

/// What a joint run improves, and guesses of active rows that go with it; afterwards those of the last QP.
struct JointPlans {
  std::vector<Trajectory> plans;   ///< one for each UAV, each starting at its problem's start
  std::vector<ActiveRows> active;  ///< likewise
  ActivePairRows active_pairs;
};

/// Sequential quadratic programming on JointProblem, as SqpSolver on UavProblem: one QP for all UAVs and one merit, in
/// which a pair's violation counts once. UAVs that cannot meet on the way do not shorten each other's steps, nor wait
/// for each other: each such component is done when it has no more to gain.
class JointSqpSolver {
 public:
  /// `qp_solver` has to take QPs of both makeQpModels of the problems' parameters.
  explicit JointSqpSolver(std::unique_ptr<JointQpSolver> qp_solver);

  /// Tells that the time for planning is over.
  using IsSpent = std::function<bool()>;

  /// At most kMostJointUavs UAVs. The results are those of the UAVs: with the changes of the active set of all in each,
  /// and the merit of all. Once `is_spent`, asked after each QP, the plans stay as they are by then.
  const std::vector<SqpResult>& solve(
      const JointProblem& problem, JointPlans& plans, const IsSpent& is_spent = [] { return false; });

  /// Source of a pair's rows in the guess; the same from cycle to cycle if the pair's UAVs are.
  static RowSource sourceOf(const UavPair& pair) {
    return 2 * static_cast<RowSource>(pair.first * kMostJointUavs + pair.second);
  }

 private:
  QpStatus solveQp(const JointProblem& problem, const std::vector<Trajectory>& plans, int iteration);
  /// Leaves UAVs that are done, but for those that rows connect with others that are not.
  void leaveThoseDone(const JointProblem& problem);
  void findPairPlanes(const JointProblem& problem, const std::vector<Trajectory>& plans, double band);
  void addPairRows(const JointProblem& problem);
  void predictAll(const std::vector<Trajectory>& plans);
  JointComponents findMovingComponents(const JointProblem& problem, const std::vector<Trajectory>& answer);
  static double meritOf(const JointMerit& merit, const JointProblem& problem, const JointComponents& components,
                        std::size_t component);
  /// Moves candidate_ from the plans towards the QP's answer as far as the merit decreases, each component by a length
  /// of its own.
  void findStep(const JointProblem& problem, const JointComponents& components, const std::vector<Trajectory>& plans);
  /// The merit of candidate_. Of a plan that stays it is what it was: half-spaces of a newer QP need not suit it.
  void judgeCandidate(const JointProblem& problem);
  /// Whether rows of bodies or pairs were active in the newest QP of a component.
  bool leans(const JointProblem& problem, const JointComponents& components, std::size_t component) const;
  /// Takes the step, and finds out which components are done.
  void takeStep(const JointProblem& problem, const JointComponents& components, const std::vector<Trajectory>& answer,
                std::vector<Trajectory>& plans);

  std::unique_ptr<JointQpSolver> qp_solver_;
  JointQp qp_;
  std::unique_ptr<JointQpSolution> solution_;
  JointPlanes planes_;                            ///< of the newest QP
  std::vector<std::vector<Trajectory>> answers_;  ///< of this run's QPs, to all UAVs
  std::vector<Trajectory> candidate_;
  std::vector<PredictedMotion> motions_;  ///< of the plans looked at
  std::vector<Box> areas_;                ///< between a plan and the QP's answer [m]
  JointMerit merit_, candidate_merit_;
  std::array<bool, kMostJointUavs> is_done_{};
  std::array<bool, kMostJointUavs> moves_{};  ///< whether candidate_ is not the plan that it comes from
  std::vector<ActiveRow> kept_rows_;          ///< of pairs that are left
  std::vector<SqpResult> results_;
};

}  // namespace swarm_planner
