// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/problem/map_corridor.hpp"
#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// What one UAV's planning makes of a map. Every map may be null: nothing is mapped. Takes no heap once made.
class MappedSpace {
 public:
  /// `parameters` must outlive this.
  explicit MappedSpace(const Parameters& parameters) : parameters_(parameters) {}

  /// Gives the problem the corridor about `plan`; `memory` is what the UAV has of its last one.
  void findCorridor(const VoxelMap* map, const Trajectory& plan, CorridorMemory& memory, UavProblem& problem);
  /// Gives it that along its path.
  void findCorridorAlongPath(const VoxelMap* map, UavProblem& problem);
  /// From the plan's knots to the nearest occupied voxel, less uav_radius [m]; infinite where none is within half a
  /// metre.
  double clearance(const VoxelMap* map, const Trajectory& plan) const;

 private:
  CorridorRequest requestFor(const VoxelMap* map, const UavProblem& problem) const;

  const Parameters& parameters_;
  CorridorBuilder builder_;
};

}  // namespace swarm_planner
