// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/planning_mode.hpp"

#include "swarm_planner/solver/joint_qp.hpp"

namespace swarm_planner {

const char* planningModeText(PlanningMode mode) {
  switch (mode) {
    case PlanningMode::kIterative:
      return "iterative";
    case PlanningMode::kJoint:
      return "joint";
    case PlanningMode::kGroups:
      return "groups";
  }
  return "";
}

std::optional<PlanningMode> planningModeFrom(const std::string& text) {
  for (const PlanningMode mode : {PlanningMode::kIterative, PlanningMode::kJoint, PlanningMode::kGroups}) {
    if (text == planningModeText(mode)) return mode;
  }
  return {};
}

std::optional<std::string> planningModeFault(PlanningMode mode, std::size_t uavs, bool as_paper) {
  if (mode != PlanningMode::kIterative && as_paper) {
    return std::string("as_paper goes with mode iterative alone, not with ") + planningModeText(mode);
  }
  if (mode != PlanningMode::kJoint || uavs <= kMostJointUavs) return {};
  return "the joint problem is solved for at most " + std::to_string(kMostJointUavs) + " UAVs, the scenario has " +
         std::to_string(uavs);
}

}  // namespace swarm_planner
