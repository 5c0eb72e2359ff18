// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// Makes files that OctoMap reads. The same voxels always give the same bytes, in whatever order they come.
class OctreeWriter {
 public:
  /// `resolution` [m], that of maps.
  explicit OctreeWriter(double resolution);
  ~OctreeWriter();
  OctreeWriter(const OctreeWriter&) = delete;
  OctreeWriter& operator=(const OctreeWriter&) = delete;

  /// Makes a voxel known, in place of what it was before. Indices lie within [-32768, 32767].
  void set(const VoxelIndex& voxel, bool occupied);

  /// A .bt file: the voxels that are known, in as few cubes as possible.
  std::vector<std::uint8_t> file();

 private:
  struct Tree;  // keeps OctoMap's headers from whoever includes this
  std::unique_ptr<Tree> tree_;
};

}  // namespace swarm_planner
