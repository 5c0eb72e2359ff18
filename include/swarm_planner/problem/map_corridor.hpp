// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "swarm_planner/problem/free_polyhedron.hpp"
#include "swarm_planner/problem/moving_body.hpp"

namespace swarm_planner {

/// A half-space n . p >= offset that keeps a segment the distance clear of what lies behind it.
struct CorridorPlane {
  HalfSpace half_space;        ///< of positions in the planning frame
  std::uint32_t identity = 0;  ///< the same from cycle to cycle, as long as the same voxel is behind it; 30 bits
};

/// Where one segment may go. Outside of the window nothing is known.
struct CorridorSegment {
  std::array<CorridorPlane, FreePolyhedron::kMostPlanes> planes;
  std::size_t count = 0;
  Box window;  ///< [m]
};

/// Convex parts of a map's free space, one for each segment of a plan.
struct MapCorridor {
  bool active = false;  ///< false: nothing is mapped
  std::array<CorridorSegment, kHorizon> segments;
};

struct UavProblem;

/// What a corridor is made for.
struct CorridorRequest {
  const VoxelMap* map = nullptr;
  double distance = 0.0;  ///< to keep from occupied voxels [m]
  double margin = 0.0;    ///< of it, that is waived at first where the start has less [m]
  double band = 0.0;      ///< how far beyond the plan's control points is looked [m]
};

/// Makes problem.corridor. A segment that leads through occupied space gets the free space of the one before, so that
/// a plan ends in front of what it cannot pass.
class CorridorBuilder {
 public:
  /// About `plan`, which the solver is to improve. Segments that lead through occupied space are looked for on the
  /// problem's path first.
  void buildAbout(const CorridorRequest& request, const Trajectory& plan, UavProblem& problem);
  /// About the problem's path, as the UAV can come along it: a plan that is held up behind something does not show the
  /// way round it.
  void buildAlongPath(const CorridorRequest& request, UavProblem& problem);

 private:
  /// Segments along the path from the start on, with the target or as fast as the UAV can follow.
  void findWay(const UavProblem& problem);
  /// Takes the free space about one of the two, or the last one.
  void choose(const CorridorRequest& request, const SegmentPoints& first, const SegmentPoints& second, int k,
              UavProblem& problem);
  /// Whether a segment has ample room in the free space of the one before: neighbours mostly share it.
  bool serves(const CorridorRequest& request, const SegmentPoints& segment) const;
  void assign(const CorridorRequest& request, const Vector3& start, int k, CorridorSegment& segment) const;

  PolyhedronSearch search_;
  FreePolyhedron polyhedron_;  ///< of the segment in work
  FreePolyhedron other_;
  std::array<SegmentPoints, kHorizon> way_;
};

}  // namespace swarm_planner
