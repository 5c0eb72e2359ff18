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

/// What is kept of a corridor from one cycle to the next: the next plan mostly leads through the same free space. Fixed
/// memory.
struct CorridorMemory {
  /// Of more the first ones are kept, and the others looked for again.
  static constexpr std::size_t kMost = 12;
  struct Part {
    FreePolyhedron polyhedron;
    SegmentPoints segment;          ///< that it was found about
    std::uint64_t fingerprint = 0;  ///< of the map in its window
  };
  std::array<Part, kMost> parts;  ///< along the plan
  std::size_t count = 0;
};

/// Makes problem.corridor. A segment that leads through occupied space gets the free space of the one before, so that
/// a plan ends in front of what it cannot pass.
class CorridorBuilder {
 public:
  /// About `plan`, which the solver is to improve. Segments that lead through occupied space are looked for on the
  /// problem's path first. Free space of the last cycle that has not changed since serves again; `memory` gets that of
  /// this one.
  void buildAbout(const CorridorRequest& request, const Trajectory& plan, CorridorMemory& memory, UavProblem& problem);
  /// About the problem's path, as the UAV can come along it: a plan that is held up behind something does not show the
  /// way round it.
  void buildAlongPath(const CorridorRequest& request, UavProblem& problem);

 private:
  using Segments = std::array<SegmentPoints, kHorizon>;

  /// Segments along the path from the start on, with the target or as fast as the UAV can follow.
  void findWay(const UavProblem& problem);
  /// Takes the free space about segment k of a line, or the last one. Where that about the segment is none,
  /// `or_at_its_end` tries the place where it ends.
  void choose(const CorridorRequest& request, const Segments& line, std::size_t k, bool or_at_its_end,
              UavProblem& problem);
  /// Takes what was found in the last cycle. False if none of that will do.
  bool recall(const CorridorRequest& request, const SegmentPoints& segment);
  void findAnew(const CorridorRequest& request, const Segments& line, std::size_t k, bool or_at_its_end);
  /// Forgets the parts that lie where the map has changed.
  static void forgetChanged(const VoxelMap& map, CorridorMemory& memory);
  void keep();
  void assign(const CorridorRequest& request, const Vector3& start, std::size_t k, CorridorSegment& segment) const;

  PolyhedronSearch search_;
  CorridorMemory::Part current_;           ///< of the segment in work
  CorridorMemory::Part other_;             ///< tried
  const CorridorMemory* known_ = nullptr;  ///< of the last cycle; null: none
  std::size_t next_known_ = 0;             ///< the first that was not taken yet
  CorridorMemory kept_;                    ///< for the next cycle
  Segments way_;
  Segments planned_;
};

}  // namespace swarm_planner
