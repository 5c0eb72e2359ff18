// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planning_budget.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

// Two cycles are not closer than this [s]; it keeps the pace finite.
constexpr double kLeastWallTime = 1e-6;

}  // namespace

void PlanningBudget::noteCycle(double now, double wall) {
  if (last_) pace_ = std::max(1.0, (now - last_->now) / std::max(wall - last_->wall, kLeastWallTime));
  last_ = Instant{now, wall};
}

double PlanningBudget::forPlansDueIn(double left) const { return std::max(0.0, share_ * left / pace_); }

}  // namespace swarm_planner
