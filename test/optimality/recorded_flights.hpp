// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>

#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// A program that a UAV meets in flight, and the plan that its solver begins with.
struct MetProgram {
  const UavProblem& problem;
  const Trajectory& guess;
  std::size_t uav = 0;
  double epoch = 0.0;  ///< [s]
};

/// Flies a mission closed loop and shows `visit` every UAV's program of every `stride`-th cycle, as it stands before
/// the cycle's first UAV is planned for. UAVs that follow a guide or rest are left out.
void visitPrograms(const Mission& mission, int stride, const std::function<void(const MetProgram&)>& visit);

}  // namespace swarm_planner
