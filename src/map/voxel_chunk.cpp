// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/voxel_chunk.hpp"

#include <bitset>

namespace swarm_planner {

void VoxelChunk::fillRow(int y, int z, std::uint32_t voxels) {
  std::uint32_t& row = rows_[index(y, z)];
  count_ += static_cast<int>(std::bitset<kSide>(voxels & ~row).count());
  row |= voxels;
  for (int x = 0; x < kBlocks; ++x) {
    const bool has_some = ((voxels >> (kBlock * x)) & 0xffU) != 0;
    if (has_some) blocks_ |= std::uint64_t{1} << (x + kBlocks * (y / kBlock + kBlocks * (z / kBlock)));
  }
}

bool VoxelChunk::hasIn(const Eigen::Vector3i& first, const Eigen::Vector3i& last) const {
  const std::uint64_t below = (std::uint64_t{1} << (last.x() + 1)) - 1;
  const auto voxels = static_cast<std::uint32_t>(below & ~((std::uint64_t{1} << first.x()) - 1));
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      if ((row(y, z) & voxels) != 0) return true;
    }
  }
  return false;
}

}  // namespace swarm_planner
