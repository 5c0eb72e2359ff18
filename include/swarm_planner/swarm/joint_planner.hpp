// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "swarm_planner/sqp/joint_sqp_solver.hpp"
#include "swarm_planner/swarm/planning_mode.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/uav_planner.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {

/// Plans for all UAVs of a small swarm as one problem. What comes out is checked as any plan: if every one passes
/// against all others' new and old ones, all are committed. Otherwise they are checked one after the other against what
/// is committed, and fall back as ever. Where the joint problem has no answer, UAVs are planned for one by one.
class JointPlanner {
 public:
  /// As UavPlanner's. Throws std::invalid_argument with planningModeFault() for too many UAVs.
  JointPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
               std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies, std::size_t uavs);

  /// Plans for the UAVs for which `is_to_plan` holds.
  void plan(double epoch, const std::function<bool(std::size_t)>& is_to_plan, std::vector<UavRecord>& records,
            Surroundings& surroundings, std::vector<UavReport>& reports);

 private:
  void pose(double epoch, std::vector<UavRecord>& records, const Surroundings& surroundings);
  void posePairs(const Surroundings& surroundings);
  /// Whether all drafts pass among each other; leaves the surroundings as they were.
  bool agree(double epoch, std::vector<UavRecord>& records, Surroundings& surroundings);

  const Parameters& parameters_;
  std::vector<UavPlanner> planners_;  ///< of each UAV
  JointSqpSolver sqp_;
  std::vector<std::size_t> members_;  ///< UAVs that need a plan
  std::vector<bool> is_member_;       ///< of each UAV
  std::vector<std::size_t> solved_;   ///< members of the last problem, to whom the guess belongs
  double guess_epoch_ = 0.0;          ///< [s]
  JointProblem problem_;
  std::vector<const CommittedMotion*> drafts_;  ///< of the members
  JointPlans plans_;
};

}  // namespace swarm_planner
