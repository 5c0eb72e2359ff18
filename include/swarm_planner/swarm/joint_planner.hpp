// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "swarm_planner/sqp/joint_sqp_solver.hpp"
#include "swarm_planner/swarm/planning_time.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/uav_planner.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {

/// What is kept of a joint problem from cycle to cycle: rows of pairs that may be active again.
struct JointGuess {
  std::vector<std::size_t> members;  ///< the UAVs that were solved
  double epoch = 0.0;                ///< [s]
  std::vector<ActiveRow> rows;       ///< as many as it has room for

  JointGuess();
};

/// Plans for several UAVs as one problem. What comes out is checked as any plan: if every one passes against all
/// others' new and old ones, all are committed. Otherwise they are checked one after the other against what is
/// committed by then, and UAVs whose plans do not pass, or all where there is no answer, are planned for one by one.
/// Holds the memory that this takes, so that every thread needs one of its own.
class JointPlanner {
 public:
  /// As UavPlanner's; of a swarm of `uavs`.
  JointPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
               const std::shared_ptr<const GeneratedTables>& tables, std::size_t max_bodies, std::size_t uavs);

  /// Plans for `count` <= kMostJointUavs UAVs, whose indices are in order. Once the time is spent no further QP is
  /// solved for them: they get what there is by then. `guess`: of the same UAVs as a rule; whose it is changes the
  /// time, not the plans.
  void plan(const std::size_t* group, std::size_t count, double epoch, const PlanningTime& time, JointGuess& guess,
            std::vector<UavRecord>& records, Surroundings& surroundings, std::vector<UavReport>& reports);

 private:
  void pose(double epoch, std::vector<UavRecord>& records, const Surroundings& surroundings);
  void posePairs(const Surroundings& surroundings);
  void takeGuess(double epoch, const JointGuess& guess);
  void storeGuess(double epoch, JointGuess& guess) const;
  void solve(const PlanningTime& time, std::vector<UavRecord>& records);
  /// Solves once more, from where the guides of those that need it alone would lead: the better solution stays.
  void solveAlongGuides(const PlanningTime& time, std::vector<UavRecord>& records);
  /// Whether all drafts pass among each other; leaves the surroundings as they were.
  bool agree(double epoch, std::vector<UavRecord>& records, Surroundings& surroundings);

  const Parameters& parameters_;
  std::vector<UavPlanner> planners_;  ///< of each member
  JointSqpSolver sqp_;
  std::vector<std::size_t> members_;  ///< UAVs that need a plan
  std::vector<bool> is_member_;       ///< of each UAV of the swarm
  JointProblem problem_;
  JointPlans plans_, along_;  ///< in work; from where guides lead
  std::vector<SqpResult> results_;
  std::vector<const CommittedMotion*> drafts_;  ///< of the members
};

}  // namespace swarm_planner
