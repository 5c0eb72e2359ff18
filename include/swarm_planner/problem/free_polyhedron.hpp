// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {

/// n . p >= offset; behind it lies an occupied voxel that the plane touches.
struct FreePlane {
  Vector3 n = Vector3::UnitZ();  ///< of length 1
  double offset = 0.0;           ///< [m]
  std::uint32_t voxel = 0;       ///< tells the voxels of a neighbourhood apart; 30 bits
};

/// A convex part of the free space of a map: in front of the planes and within the window no voxel is occupied.
struct FreePolyhedron {
  static constexpr std::size_t kMostPlanes = 12;

  std::array<FreePlane, kMostPlanes> planes;
  std::size_t count = 0;
  Box window;              ///< [m]
  double clearance = 0.0;  ///< least of a plane from the segment that it was made for [m]; 0 where that meets a voxel
};

/// Finds large convex parts of the free space about segments: the plane between the segment and the voxel nearest to
/// it, with all voxels behind it put away, then the nearest of those that are left, until none is. Works from the
/// voxels, block by block, so that nothing has to be prepared when a map changes. Fixed memory.
class PolyhedronSearch {
 public:
  PolyhedronSearch();

  /// About a segment, in a window [m] that holds its control points; in a smaller one where that has more voxels than
  /// there is room for, or more planes.
  void find(const VoxelMap& map, const SegmentPoints& segment, const Box& window, FreePolyhedron& polyhedron);

 private:
  static constexpr std::size_t kMostBlocks = 1024;
  static constexpr std::size_t kMostVoxels = 4096;

  struct Block {
    double squared_gap = 0.0;  ///< to the box about the segment [m^2]
    Box box;                   ///< of its voxels [m]
    const VoxelChunk* chunk = nullptr;
    const VoxelChunk::Range* range = nullptr;
    VoxelIndex corner;  ///< of the chunk, in voxels
  };
  struct Voxel {
    double squared_distance = 0.0;  ///< of its middle from the segment's chord [m^2]
    Vector3 middle;                 ///< [m]
    VoxelIndex index;
  };

  /// The point of the segment's chord that is nearest to `p`.
  Vector3 nearestOnChord(const Vector3& p) const;
  bool gatherBlocks(const VoxelMap& map);
  void gatherBlocks(const VoxelChunk& chunk, const VoxelIndex& corner);
  /// Adds the block's voxels that are not behind a plane. False if there is no room.
  bool expand(const Block& block);
  /// Of the voxels of a row of a chunk from `corner` on, y and z being that of the row, those in front of all planes.
  std::uint32_t inFront(std::uint32_t row, const VoxelIndex& corner) const;
  /// Looks for all planes. False if there is no room for voxels.
  bool separate();
  /// Adds the plane between the segment and a voxel; false if the segment meets the voxel.
  bool addPlane(const Voxel& voxel);
  void addBounds(const VoxelMap& map);
  bool isBehind(const FreePlane& plane, const Vector3& middle, const Vector3& half) const;
  bool isBehindAny(const Vector3& middle, const Vector3& half) const;
  /// Makes the window so small that it holds nothing that no plane has put away.
  void shrinkWindow(std::size_t next_block);

  FreePolyhedron* polyhedron_ = nullptr;
  SegmentPoints segment_;
  Vector3 chord_;     ///< of the segment [m]
  Vector3 along_;     ///< chord_ over its squared length [1/m]
  Box hull_;          ///< of the segment [m]
  VoxelIndex first_;  ///< voxels of the window, each included
  VoxelIndex last_;
  double resolution_ = 1.0;
  std::vector<Block> blocks_;
  std::vector<Voxel> voxels_;
};

}  // namespace swarm_planner
