// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/swarm/stopwatch.hpp"

namespace swarm_planner {

/// How long a cycle may plan.
struct PlanningTime {
  const Stopwatch& stopwatch;  ///< runs since the snapshot was taken in
  double budget = 0.0;         ///< [s]

  bool isSpent() const { return stopwatch.elapsed() > budget; }
};

}  // namespace swarm_planner
