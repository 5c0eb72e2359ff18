// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/model/trajectory.hpp"
#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// Replaces what `plan` does from knot `stage` on by the shortest stop within `bounds`, and rest. False, and nothing
/// done, if there is no such stop that ends within the plan. Takes no heap.
bool stopEarly(int stage, const FlightBounds& bounds, Trajectory& plan);

/// What may fly of a plan that was refused, in the order in which it is to be tried:
///  1. the plan itself up to an earlier stop, before the conflict. Most plans that are refused in a crowd are so for
///     their stop, which the solver does not know: it would meet somebody seconds from now, when the plan has long been
///     replaced. What flies until then is what the solver wants.
///  2. steps from the motion flown before towards the plan: the half, a quarter, none of the way.
class PlanParts {
 public:
  /// `conflict`: when the plan was found to fail, after its epoch; 0: there is no part of it to be kept [s]. `shifted`:
  /// the motion flown before, from the plan's start. All must outlive this.
  PlanParts(const Trajectory& plan, const Trajectory& shifted, double conflict, const FlightBounds& bounds);

  /// Writes the next one to `part`. False after the last.
  bool next(Trajectory& part);

  /// Whether the last part begins as the plan does.
  bool stopsEarly() const { return stops_early_; }
  /// Whether the last part is the motion flown before, with nothing of the plan.
  bool stays() const { return stays_; }

 private:
  const Trajectory& plan_;
  const Trajectory& shifted_;
  const double conflict_;
  const FlightBounds& bounds_;
  std::size_t next_stop_ = 0;
  std::size_t next_step_ = 0;
  bool stops_early_ = false;
  bool stays_ = false;
};

}  // namespace swarm_planner
