// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/ros/input_store.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// What happened around a cycle that the planner itself cannot know.
struct CycleContext {
  double stamp = 0.0;  ///< when the cycle began [s]
  std::string frame;   ///< planning frame
  bool deadline_missed = false;
  std::uint32_t deadline_misses = 0;
  std::uint32_t rejected_plans = 0;
};

/// A UAV's reason in words for operators: that of the planner, made concrete by what its input knows (the fault of the
/// newest message, the topic that stays silent, who is waited for) and by why the check refused the plan. Empty if all
/// is well.
std::string describeReason(const SwarmPlanner& planner, std::size_t uav, const std::vector<UavInput>& inputs,
                           const std::string& odometry_topic);

/// The last cycle's report as a message; `reasons` one per UAV. Reuses the memory of `message`.
void toMessage(const SwarmPlanner& planner, const CycleContext& context, const std::vector<std::string>& reasons,
               PlannerStatus& message);

}  // namespace swarm_planner
