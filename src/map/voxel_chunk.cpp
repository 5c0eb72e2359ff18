// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/voxel_chunk.hpp"

#include <algorithm>
#include <bitset>

namespace swarm_planner {
namespace {

/// 0 for a row without voxels; the finaliser of SplitMix64 otherwise.
std::uint64_t fingerprintOf(std::size_t index, std::uint32_t row) {
  if (row == 0) return 0;
  std::uint64_t mixed = (static_cast<std::uint64_t>(index) << 32U | row) + 0x9e3779b97f4a7c15U;
  mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
  mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebU;
  return mixed ^ (mixed >> 31U);
}

}  // namespace

void VoxelChunk::fillRow(int y, int z, std::uint32_t voxels) {
  std::uint32_t& row = rows_[index(y, z)];
  if ((voxels & ~row) == 0) return;
  count_ += static_cast<int>(std::bitset<kSide>(voxels & ~row).count());
  fingerprint_ -= fingerprintOf(index(y, z), row);
  row |= voxels;
  fingerprint_ += fingerprintOf(index(y, z), row);
  for (int x = 0; x < kBlocks; ++x) {
    const std::uint32_t part = voxels & bitsBetween(kBlock * x, kBlock * (x + 1) - 1);
    if (part == 0) continue;
    const int first = lowestBit(part);
    const int last = highestBit(part);
    const auto byte = [](int i) { return static_cast<std::uint8_t>(i); };
    blocks_[blockIndex(x, y / kBlock, z / kBlock)].include(
        {{byte(first), byte(y), byte(z)}, {byte(last), byte(y), byte(z)}});
  }
}

void VoxelChunk::Range::include(const Range& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = std::min(first[axis], other.first[axis]);
    last[axis] = std::max(last[axis], other.last[axis]);
  }
}

VoxelChunk::Range VoxelChunk::range() const {
  Range all;
  for (const Range& block : blocks_) all.include(block);
  return all;
}

std::uint32_t VoxelChunk::surface(int y, int z) const {
  const std::uint32_t voxels = row(y, z);
  if (voxels == 0 || y == 0 || z == 0 || y == kSide - 1 || z == kSide - 1) return voxels;
  const std::uint32_t inner =
      (voxels << 1U) & (voxels >> 1U) & row(y - 1, z) & row(y + 1, z) & row(y, z - 1) & row(y, z + 1);
  return voxels & ~inner;
}

bool VoxelChunk::hasIn(const Eigen::Vector3i& first, const Eigen::Vector3i& last) const {
  const std::uint32_t voxels = bitsBetween(first.x(), last.x());
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      if ((row(y, z) & voxels) != 0) return true;
    }
  }
  return false;
}

}  // namespace swarm_planner
