// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace swarm_planner {

/// The number of the lowest and of the highest bit that is set; `bits` must not be 0.
inline int lowestBit(std::uint32_t bits) { return __builtin_ctz(bits); }
inline int highestBit(std::uint32_t bits) { return 31 - __builtin_clz(bits); }
/// Bits first to last, each from 0 to 31 and included; none if first > last.
inline std::uint32_t bitsBetween(int first, int last) {
  return first > last ? 0U : (~std::uint32_t{0} << first) & (~std::uint32_t{0} >> (31 - last));
}

/// A cube of 32^3 voxels, a bit each.
class VoxelChunk {
 public:
  static constexpr int kSide = 32;   ///< voxels along an edge
  static constexpr int kBlock = 8;   ///< voxels along an edge of a block
  static constexpr int kBlocks = 4;  ///< blocks along an edge

  /// Bit x is the voxel (x, y, z), each from 0 to 31.
  std::uint32_t row(int y, int z) const { return rows_[index(y, z)]; }
  bool isOccupied(int x, int y, int z) const { return ((row(y, z) >> x) & 1U) != 0; }
  /// The occupied voxels of the block (x, y, z), each from 0 to 3, lie within these, each included.
  struct Range {
    std::array<std::uint8_t, 3> first{kSide, kSide, kSide};
    std::array<std::uint8_t, 3> last{};

    bool isEmpty() const { return first[0] > last[0]; }
    void include(const Range& other);
  };
  /// Tight about all occupied voxels.
  Range range() const;
  const Range& block(int x, int y, int z) const { return blocks_[blockIndex(x, y, z)]; }
  /// Voxels of a row that have a neighbour across one of their faces in the chunk, or may have one beyond it, that is
  /// not occupied.
  std::uint32_t surface(int y, int z) const;
  /// Whether any voxel from `first` to `last`, each included, is occupied.
  bool hasIn(const Eigen::Vector3i& first, const Eigen::Vector3i& last) const;
  int occupiedCount() const { return count_; }
  bool isFull() const { return count_ == kSide * kSide * kSide; }
  /// Of what is occupied: the same for equal chunks, and as good as never for others.
  std::uint64_t fingerprint() const { return fingerprint_; }

  /// Makes the voxels of a row occupied whose bit is set.
  void fillRow(int y, int z, std::uint32_t voxels);

  bool operator==(const VoxelChunk& other) const { return fingerprint_ == other.fingerprint_ && rows_ == other.rows_; }

 private:
  static std::size_t index(int y, int z) { return static_cast<std::size_t>(y + kSide * z); }
  static std::size_t blockIndex(int x, int y, int z) {
    return static_cast<std::size_t>(x + kBlocks * (y + kBlocks * z));
  }

  std::array<std::uint32_t, kSide * kSide> rows_{};
  std::array<Range, kBlocks * kBlocks * kBlocks> blocks_{};
  int count_ = 0;
  std::uint64_t fingerprint_ = 0;  ///< sum over the rows
};

}  // namespace swarm_planner
