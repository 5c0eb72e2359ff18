// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "swarm_planner/swarm/joint_groups.hpp"
#include "swarm_planner/swarm/joint_planner.hpp"
#include "swarm_planner/swarm/planning_mode.hpp"
#include "swarm_planner/swarm/planning_time.hpp"
#include "swarm_planner/swarm/solve_order.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/thread_team.hpp"
#include "swarm_planner/swarm/uav_planner.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {

/// What is to be done for a UAV in a cycle.
enum class Turn : std::uint8_t {
  kNone,
  kPlan,
  kKeepClear,  ///< it is not seen, but flies what was planned for it
};

/// Gives every UAV its turn in a cycle: one after the other, or groups of them at once. What cannot meet takes turns at
/// the same time, with the same result for any number of threads.
class PlanningRounds {
 public:
  /// As UavPlanner's. Throws std::invalid_argument with planningModeFault() if there is one. `team` must outlive
  /// this.
  PlanningRounds(const Parameters& parameters, const std::optional<Workspace>& workspace, PlanningMode mode,
                 std::size_t uavs, std::size_t max_obstacles, ThreadTeam& team);

  /// `turns`: of each UAV. Nothing throws or allocates. False if some UAV's turn did not come in time.
  bool plan(double epoch, const PlanningTime& time, const std::vector<Turn>& turns, std::vector<UavRecord>& records,
            Surroundings& surroundings, std::vector<UavReport>& reports);

 private:
  struct Cycle;

  void planOneByOne(const Cycle& cycle);
  void planByGroups(const Cycle& cycle);
  /// `may_skip`: somebody has made progress, whatever the budget.
  static void takeTurn(std::size_t uav, bool may_skip, UavPlanner& planner, const Cycle& cycle);
  bool noteOverrun(const std::vector<UavReport>& reports);

  ThreadTeam& team_;
  SolveOrder order_;
  PlanningMode mode_;
  std::vector<UavPlanner> planners_;  ///< one per member of the team
  std::size_t first_ = 0;             ///< the UAV whose turn comes first

  // Of modes that plan for several UAVs at once.
  std::optional<JointGroups> groups_;
  std::vector<JointPlanner> joint_planners_;  ///< one per member of the team
  std::vector<JointGuess> guesses_;           ///< of groups, by their first UAVs
  std::vector<JointGroups::Candidate> candidates_;
};

}  // namespace swarm_planner
