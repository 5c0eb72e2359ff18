// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>

#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// Makes a map that differs from another in some voxels, in a time that grows with those and with the number of chunks,
/// not with that of the voxels.
class VoxelMapEditor {
 public:
  /// `base` is not null. What counts as occupied outside of its bounds stays.
  explicit VoxelMapEditor(std::shared_ptr<const VoxelMap> base);

  /// std::out_of_range beyond kFarthestVoxel.
  void set(const VoxelIndex& voxel, bool occupied);

  /// The map. Shares the chunks that are as in `base`.
  std::shared_ptr<const VoxelMap> build() const;

 private:
  using Order = std::array<int, 3>;  ///< z, y, x of a chunk: as in a map's list
  using Rows = std::array<std::uint32_t, VoxelChunk::kSide * VoxelChunk::kSide>;

  static VoxelMap::ChunkPointer chunkOf(const Rows& rows, const VoxelMap::ChunkPointer& before);

  std::shared_ptr<const VoxelMap> base_;
  std::map<Order, Rows> edited_;
  Rows* rows_ = nullptr;  ///< of the chunk that was edited last, `order_`
  Order order_{};
};

}  // namespace swarm_planner
