// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/voxel_chunk.hpp"

#include <algorithm>
#include <bitset>

namespace swarm_planner {

void VoxelChunk::fillRow(int y, int z, std::uint32_t voxels) {
  std::uint32_t& row = rows_[index(y, z)];
  count_ += static_cast<int>(std::bitset<kSide>(voxels & ~row).count());
  row |= voxels;
  for (int x = 0; x < kBlocks; ++x) {
    if (((voxels >> (kBlock * x)) & 0xffU) == 0) continue;
    int first = kBlock * x;
    while (((voxels >> first) & 1U) == 0) ++first;
    int last = kBlock * (x + 1) - 1;
    while (((voxels >> last) & 1U) == 0) --last;
    Range& range = blocks_[blockIndex(x, y / kBlock, z / kBlock)];
    const std::array<int, 3> low{first, y, z};
    const std::array<int, 3> high{last, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      range.first[axis] = static_cast<std::uint8_t>(std::min<int>(range.first[axis], low[axis]));
      range.last[axis] = static_cast<std::uint8_t>(std::max<int>(range.last[axis], high[axis]));
    }
  }
}

std::uint32_t VoxelChunk::surface(int y, int z) const {
  const std::uint32_t voxels = row(y, z);
  if (voxels == 0 || y == 0 || z == 0 || y == kSide - 1 || z == kSide - 1) return voxels;
  const std::uint32_t inner =
      (voxels << 1U) & (voxels >> 1U) & row(y - 1, z) & row(y + 1, z) & row(y, z - 1) & row(y, z + 1);
  return voxels & ~inner;
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
