// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace swarm_planner {

/// A cube of 32^3 voxels, a bit each.
class VoxelChunk {
 public:
  static constexpr int kSide = 32;   ///< voxels along an edge
  static constexpr int kBlock = 8;   ///< voxels along an edge of a block
  static constexpr int kBlocks = 4;  ///< blocks along an edge

  /// Bit x is the voxel (x, y, z), each from 0 to 31.
  std::uint32_t row(int y, int z) const { return rows_[index(y, z)]; }
  bool isOccupied(int x, int y, int z) const { return ((row(y, z) >> x) & 1U) != 0; }
  /// Whether any voxel of the block (x, y, z), each from 0 to 3, is occupied.
  bool hasInBlock(int x, int y, int z) const { return ((blocks_ >> (x + kBlocks * (y + kBlocks * z))) & 1U) != 0; }
  /// Whether any voxel from `first` to `last`, each included, is occupied.
  bool hasIn(const Eigen::Vector3i& first, const Eigen::Vector3i& last) const;
  int occupiedCount() const { return count_; }
  bool isFull() const { return count_ == kSide * kSide * kSide; }

  /// Makes the voxels of a row occupied whose bit is set.
  void fillRow(int y, int z, std::uint32_t voxels);

  bool operator==(const VoxelChunk& other) const { return count_ == other.count_ && rows_ == other.rows_; }

 private:
  static std::size_t index(int y, int z) { return static_cast<std::size_t>(y + kSide * z); }

  std::array<std::uint32_t, kSide * kSide> rows_{};
  std::uint64_t blocks_ = 0;  ///< those that have occupied voxels
  int count_ = 0;
};

}  // namespace swarm_planner
