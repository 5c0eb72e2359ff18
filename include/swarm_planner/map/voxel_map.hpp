// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "swarm_planner/map/voxel_chunk.hpp"
#include "swarm_planner/obstacles/box.hpp"

namespace swarm_planner {

/// Voxel (i, j, k) covers [i, i + 1) x resolution along x, and so on, in the planning frame; so do the chunks, which
/// are 32 voxels wide.
using VoxelIndex = Eigen::Vector3i;

/// Indices lie within +-kFarthestVoxel.
constexpr int kFarthestVoxel = 1 << 24;

/// The occupied space of a place, in cubes of equal size. Immutable; successive maps share the chunks that are equal.
class VoxelMap {
 public:
  using ChunkPointer = std::shared_ptr<const VoxelChunk>;
  struct Entry {
    VoxelIndex index;  ///< of the chunk
    ChunkPointer chunk;
  };

  /// Edge of a voxel [m].
  double resolution() const { return resolution_; }
  /// Contains all occupied voxels, or, where everything outside counts as occupied, all that do not [m].
  const Box& bounds() const { return bounds_; }
  /// True: whatever lies outside of bounds() is occupied.
  bool outsideIsOccupied() const { return outside_is_occupied_; }
  /// Within bounds().
  std::size_t occupiedCount() const { return occupied_count_; }
  /// Memory that the map takes, with the chunks that it shares with others [bytes].
  std::size_t memory() const;

  /// Chunks that have occupied voxels, in ascending order of z, y, x.
  const std::vector<Entry>& chunks() const { return chunks_; }
  /// Null if nothing in it is occupied.
  const VoxelChunk* chunk(const VoxelIndex& index) const;

  VoxelIndex voxelAt(const Vector3& p) const;
  bool isOccupied(const VoxelIndex& voxel) const;
  bool isOccupied(const Vector3& p) const;
  Box boxOf(const VoxelIndex& voxel) const;

  /// From a point to the nearest occupied voxel, 0 within one; `limit` where none is that near [m]. Infinite points
  /// are far from everything, and what is not a number is near.
  double distance(const Vector3& p, double limit) const { return findNearest(p, limit).distance; }
  struct Nearest {
    double distance = 0.0;            ///< as above [m]
    Vector3 point = Vector3::Zero();  ///< of an occupied voxel, if the distance is less than the limit [m]
  };
  Nearest findNearest(const Vector3& p, double limit) const;

  /// Of what is occupied in the chunks that a box touches: the same in a map that is equal there, and as good as never
  /// in another.
  std::uint64_t fingerprint(const Box& box) const;

  /// Whether no occupied voxel has a point in common with a box.
  bool isEmpty(const Box& box) const;

  /// Calls visit(const VoxelIndex&) with every occupied voxel that has a point in common with a box, within bounds().
  template <class Visitor>
  void forEachOccupied(const Box& box, Visitor visit) const;

 private:
  friend class VoxelMapBuilder;
  friend class VoxelMapEditor;

  VoxelMap() = default;
  /// All occupied; one for all maps.
  static const ChunkPointer& fullChunk();
  /// What follows from the chunks, which are in order; where outside_is_occupied_, bounds_ stays.
  void finish();
  void buildTable();
  /// Those of `box` that bounds() has; empty (some min > max) if none.
  void clampedRange(const Box& box, VoxelIndex& first, VoxelIndex& last) const;

  double resolution_ = 1.0;
  bool outside_is_occupied_ = false;
  Box bounds_;
  std::size_t occupied_count_ = 0;
  std::vector<Entry> chunks_;
  std::vector<std::int32_t> table_;  ///< open addressing: index in chunks_, or -1
};

/// Collects what a map is made of.
class VoxelMapBuilder {
 public:
  /// `resolution` [m]; std::invalid_argument unless finite and positive.
  explicit VoxelMapBuilder(double resolution);

  /// Makes a voxel occupied. std::out_of_range beyond kFarthestVoxel, as of the others.
  void set(int i, int j, int k) { setBox(VoxelIndex(i, j, k), VoxelIndex(i + 1, j + 1, k + 1)); }
  /// Makes the voxels from `low` on, up to but without `high`, occupied.
  void setBox(const VoxelIndex& low, const VoxelIndex& high);
  /// Everything outside of the voxels from `low` on, up to but without `high`, counts as occupied.
  void setOutsideOccupied(const VoxelIndex& low, const VoxelIndex& high);

  /// The map. Chunks that are equal to those of `previous`, which may be null, are shared. Leaves the builder as new.
  std::shared_ptr<const VoxelMap> build(const VoxelMap* previous = nullptr);

 private:
  double resolution_;
  bool outside_is_occupied_ = false;
  VoxelIndex known_low_ = VoxelIndex::Zero();
  VoxelIndex known_high_ = VoxelIndex::Zero();
  std::unordered_map<std::uint64_t, std::shared_ptr<VoxelChunk>> chunks_;
};

template <class Visitor>
void VoxelMap::forEachOccupied(const Box& box, Visitor visit) const {
  VoxelIndex first;
  VoxelIndex last;
  clampedRange(box, first, last);
  if ((first.array() > last.array()).any()) return;
  const auto chunkOf = [](int i) { return i >> 5; };
  for (int cz = chunkOf(first.z()); cz <= chunkOf(last.z()); ++cz) {
    for (int cy = chunkOf(first.y()); cy <= chunkOf(last.y()); ++cy) {
      for (int cx = chunkOf(first.x()); cx <= chunkOf(last.x()); ++cx) {
        const VoxelChunk* part = chunk({cx, cy, cz});
        if (part == nullptr) continue;
        const VoxelIndex corner = VoxelChunk::kSide * VoxelIndex(cx, cy, cz);
        const VoxelIndex low = (first - corner).cwiseMax(0);
        const VoxelIndex high = (last - corner).cwiseMin(VoxelChunk::kSide - 1);
        for (int z = low.z(); z <= high.z(); ++z) {
          for (int y = low.y(); y <= high.y(); ++y) {
            for (int x = low.x(); x <= high.x(); ++x) {
              if (part->isOccupied(x, y, z)) visit(VoxelIndex(corner + VoxelIndex(x, y, z)));
            }
          }
        }
      }
    }
  }
}

}  // namespace swarm_planner
