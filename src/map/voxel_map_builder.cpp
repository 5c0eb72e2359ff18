// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {
namespace {

constexpr int kSide = VoxelChunk::kSide;
constexpr int kChunkBits = 21;  // of a chunk's index along an axis
constexpr int kChunkOffset = 1 << (kChunkBits - 1);

std::uint64_t keyOf(int x, int y, int z) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + kChunkOffset); };
  return (part(z) << (2 * kChunkBits)) | (part(y) << kChunkBits) | part(x);
}

VoxelIndex chunkOfKey(std::uint64_t key) {
  const auto part = [key](int shift) {
    return static_cast<int>((key >> shift) & ((std::uint64_t{1} << kChunkBits) - 1)) - kChunkOffset;
  };
  return {part(0), part(kChunkBits), part(2 * kChunkBits)};
}

void requireRange(const VoxelIndex& low, const VoxelIndex& high) {
  if (low.minCoeff() < -kFarthestVoxel || high.maxCoeff() > kFarthestVoxel) {
    throw std::out_of_range("voxel index beyond what a map can hold");
  }
}

}  // namespace

VoxelMapBuilder::VoxelMapBuilder(double resolution) : resolution_(resolution) {
  if (!std::isfinite(resolution) || resolution <= 0.0) {
    throw std::invalid_argument("the resolution of a map has to be finite and positive");
  }
}

void VoxelMapBuilder::setBox(const VoxelIndex& low, const VoxelIndex& high) {
  requireRange(low, high);
  if (!(low.array() < high.array()).all()) return;
  for (int cz = low.z() >> 5; cz <= (high.z() - 1) >> 5; ++cz) {
    for (int cy = low.y() >> 5; cy <= (high.y() - 1) >> 5; ++cy) {
      for (int cx = low.x() >> 5; cx <= (high.x() - 1) >> 5; ++cx) {
        std::shared_ptr<VoxelChunk>& chunk = chunks_[keyOf(cx, cy, cz)];
        if (!chunk) chunk = std::make_shared<VoxelChunk>();
        const VoxelIndex corner = kSide * VoxelIndex(cx, cy, cz);
        const VoxelIndex from = (low - corner).cwiseMax(0);
        const VoxelIndex to = (high - corner).cwiseMin(kSide);
        const std::uint32_t voxels = bitsBetween(from.x(), to.x() - 1);
        for (int z = from.z(); z < to.z(); ++z) {
          for (int y = from.y(); y < to.y(); ++y) chunk->fillRow(y, z, voxels);
        }
      }
    }
  }
}

void VoxelMapBuilder::setOutsideOccupied(const VoxelIndex& low, const VoxelIndex& high) {
  requireRange(low, high);
  outside_is_occupied_ = true;
  known_low_ = low;
  known_high_ = high.cwiseMax(low);
}

std::shared_ptr<const VoxelMap> VoxelMapBuilder::build(const VoxelMap* previous) {
  std::shared_ptr<VoxelMap> map(new VoxelMap());
  map->resolution_ = resolution_;
  map->outside_is_occupied_ = outside_is_occupied_;
  const bool comparable = previous != nullptr && previous->resolution_ == resolution_;
  map->chunks_.reserve(chunks_.size());
  for (auto& [key, chunk] : chunks_) {
    const VoxelIndex index = chunkOfKey(key);
    map->chunks_.push_back({index, chunk->isFull() ? VoxelMap::fullChunk() : VoxelMap::ChunkPointer(std::move(chunk))});
  }
  std::sort(map->chunks_.begin(), map->chunks_.end(), [](const VoxelMap::Entry& a, const VoxelMap::Entry& b) {
    return std::make_tuple(a.index.z(), a.index.y(), a.index.x()) <
           std::make_tuple(b.index.z(), b.index.y(), b.index.x());
  });
  if (comparable) {
    auto old = previous->chunks_.begin();
    for (VoxelMap::Entry& entry : map->chunks_) {
      const auto isBefore = [&entry](const VoxelMap::Entry& other) {
        return std::make_tuple(other.index.z(), other.index.y(), other.index.x()) <
               std::make_tuple(entry.index.z(), entry.index.y(), entry.index.x());
      };
      while (old != previous->chunks_.end() && isBefore(*old)) ++old;
      if (old == previous->chunks_.end()) break;
      if (old->index == entry.index && *old->chunk == *entry.chunk) entry.chunk = old->chunk;
    }
  }
  if (outside_is_occupied_) {
    map->bounds_ = {resolution_ * known_low_.cast<double>(), resolution_ * known_high_.cast<double>()};
  }
  map->finish();
  *this = VoxelMapBuilder(resolution_);
  return map;
}

}  // namespace swarm_planner
