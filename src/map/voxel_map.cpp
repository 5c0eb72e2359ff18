// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/voxel_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace swarm_planner {
namespace {

constexpr int kSide = VoxelChunk::kSide;
constexpr std::int32_t kNone = -1;

int chunkOf(int voxel) { return voxel >> 5; }

std::size_t hashOf(const VoxelIndex& index) {
  const auto mixed = static_cast<std::uint64_t>(index.x()) * 0x9e3779b97f4a7c15U ^
                     static_cast<std::uint64_t>(index.y()) * 0xc2b2ae3d27d4eb4fU ^
                     static_cast<std::uint64_t>(index.z()) * 0x165667b19e3779f9U;
  return static_cast<std::size_t>(mixed ^ (mixed >> 32U));
}

std::uint64_t bitsOf(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

/// Of a coordinate from [low, high] [same unit].
double gapTo(double x, double low, double high) { return std::max({low - x, x - high, 0.0}); }

/// Looks for the occupied voxel that is nearest to a point, chunk by chunk, block by block, row by row. Lengths are in
/// voxels.
class NearestSearch {
 public:
  NearestSearch(const Vector3& p, double limit) : p_(p), best_(limit * limit) {}

  void lookIn(const VoxelChunk& chunk, const VoxelIndex& corner) {
    corner_ = corner;
    const double reach = std::sqrt(best_);
    VoxelIndex first_block;
    VoxelIndex last_block;
    for (int axis = 0; axis < 3; ++axis) {
      const double own = p_[axis] - corner[axis];
      first_[axis] = static_cast<int>(std::clamp(std::floor(own - reach), 0.0, static_cast<double>(kSide)));
      last_[axis] = static_cast<int>(std::clamp(std::floor(own + reach), -1.0, kSide - 1.0));
      if (first_[axis] > last_[axis]) return;
      first_block[axis] = first_[axis] / VoxelChunk::kBlock;
      last_block[axis] = last_[axis] / VoxelChunk::kBlock;
    }
    for (int z = first_block.z(); z <= last_block.z(); ++z) {
      for (int y = first_block.y(); y <= last_block.y(); ++y) {
        for (int x = first_block.x(); x <= last_block.x(); ++x) {
          const VoxelChunk::Range& range = chunk.block(x, y, z);
          if (!range.isEmpty() && squaredGap(range) < best_) lookInBlock(chunk, range);
        }
      }
    }
  }

  double squaredDistance() const { return best_; }
  const Vector3& point() const { return point_; }

 private:
  double squaredGap(const VoxelChunk::Range& range) const {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      const double gap = gapTo(p_[i], corner_[i] + range.first[axis], corner_[i] + range.last[axis] + 1.0);
      squared += gap * gap;
    }
    return squared;
  }

  void lookInBlock(const VoxelChunk& chunk, const VoxelChunk::Range& range) {
    const int first_x = std::max<int>(range.first[0], first_.x());
    const int last_x = std::min<int>(range.last[0], last_.x());
    const std::uint32_t within = bitsBetween(first_x, last_x);
    // The voxels of a row up to the point and those from there on: of each part the one that is nearest to it counts.
    const int own = static_cast<int>(std::clamp(std::floor(p_.x() - corner_.x()), -1.0, kSide - 1.0));
    const std::uint32_t up_to_own = bitsBetween(0, own) & within;
    const std::uint32_t beyond = ~bitsBetween(0, own) & within;
    const int last_z = std::min<int>(range.last[2], last_.z());
    const int last_y = std::min<int>(range.last[1], last_.y());
    for (int z = std::max<int>(range.first[2], first_.z()); z <= last_z; ++z) {
      const double above = corner_.z() + z;
      const double dz = gapTo(p_.z(), above, above + 1.0);
      if (dz * dz >= best_) continue;
      for (int y = std::max<int>(range.first[1], first_.y()); y <= last_y; ++y) {
        const std::uint32_t row = chunk.row(y, z);
        if ((row & within) == 0) continue;
        const double across = corner_.y() + y;
        const double dy = gapTo(p_.y(), across, across + 1.0);
        const double squared = dy * dy + dz * dz;
        if (squared >= best_) continue;
        const Vector3 first_voxel(corner_.x(), across, above);
        if ((row & up_to_own) != 0) consider(first_voxel + highestBit(row & up_to_own) * Vector3::UnitX(), squared);
        if ((row & beyond) != 0) consider(first_voxel + lowestBit(row & beyond) * Vector3::UnitX(), squared);
      }
    }
  }

  /// The voxel from `low` on; `squared`: what its distance has across x.
  void consider(const Vector3& low, double squared) {
    const double dx = gapTo(p_.x(), low.x(), low.x() + 1.0);
    if (dx * dx + squared >= best_) return;
    best_ = dx * dx + squared;
    point_ = p_.cwiseMax(low).cwiseMin(low + Vector3::Ones());
  }

  Vector3 p_;
  double best_;  ///< squared
  Vector3 point_ = Vector3::Zero();
  VoxelIndex corner_ = VoxelIndex::Zero();  ///< of the chunk
  VoxelIndex first_ = VoxelIndex::Zero();   ///< within reach, in the chunk
  VoxelIndex last_ = VoxelIndex::Zero();
};

}  // namespace

std::size_t VoxelMap::memory() const {
  return chunks_.size() * (sizeof(VoxelChunk) + sizeof(Entry)) + table_.size() * sizeof(std::int32_t) +
         sizeof(VoxelMap);
}

const VoxelChunk* VoxelMap::chunk(const VoxelIndex& index) const {
  if (table_.empty()) return nullptr;
  for (std::size_t slot = hashOf(index) & (table_.size() - 1); table_[slot] != kNone;
       slot = (slot + 1) & (table_.size() - 1)) {
    const Entry& entry = chunks_[static_cast<std::size_t>(table_[slot])];
    if (entry.index == index) return entry.chunk.get();
  }
  return nullptr;
}

const VoxelMap::ChunkPointer& VoxelMap::fullChunk() {
  static const ChunkPointer full = [] {
    const auto chunk = std::make_shared<VoxelChunk>();
    for (int z = 0; z < kSide; ++z) {
      for (int y = 0; y < kSide; ++y) chunk->fillRow(y, z, bitsBetween(0, kSide - 1));
    }
    return chunk;
  }();
  return full;
}

void VoxelMap::finish() {
  occupied_count_ = 0;
  Box all;
  for (const Entry& entry : chunks_) {
    occupied_count_ += static_cast<std::size_t>(entry.chunk->occupiedCount());
    const VoxelChunk::Range range = entry.chunk->range();
    const VoxelIndex corner = kSide * entry.index;
    all.include(boxOf(corner + VoxelIndex(range.first[0], range.first[1], range.first[2])).min);
    all.include(boxOf(corner + VoxelIndex(range.last[0], range.last[1], range.last[2])).max);
  }
  if (!outside_is_occupied_) bounds_ = all;
  buildTable();
}

void VoxelMap::buildTable() {
  std::size_t size = 16;
  while (size < 2 * chunks_.size()) size *= 2;
  table_.assign(chunks_.empty() ? 0 : size, kNone);
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    std::size_t slot = hashOf(chunks_[i].index) & (size - 1);
    while (table_[slot] != kNone) slot = (slot + 1) & (size - 1);
    table_[slot] = static_cast<std::int32_t>(i);
  }
}

void VoxelMap::clampedRange(const Box& box, VoxelIndex& first, VoxelIndex& last) const {
  const Vector3 low = box.min.cwiseMax(bounds_.min);
  const Vector3 high = box.max.cwiseMin(bounds_.max);
  first.setOnes();
  last.setZero();
  if (!(low.array() <= high.array()).all()) return;
  for (int axis = 0; axis < 3; ++axis) {
    // Voxels that begin where the box ends, or end where it begins, share a face with it.
    first[axis] = static_cast<int>(std::ceil(low[axis] / resolution_)) - 1;
    last[axis] = static_cast<int>(std::floor(high[axis] / resolution_));
  }
}

VoxelIndex VoxelMap::voxelAt(const Vector3& p) const {
  VoxelIndex voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor(p[axis] / resolution_);
    voxel[axis] = static_cast<int>(std::clamp<double>(index, -kFarthestVoxel - 1, kFarthestVoxel + 1));
  }
  return voxel;
}

bool VoxelMap::isOccupied(const VoxelIndex& voxel) const {
  if (outside_is_occupied_) {
    const Vector3 middle = resolution_ * (voxel.cast<double>() + Vector3::Constant(0.5));
    if ((middle.array() < bounds_.min.array()).any() || (middle.array() > bounds_.max.array()).any()) return true;
  }
  const VoxelChunk* part = chunk({chunkOf(voxel.x()), chunkOf(voxel.y()), chunkOf(voxel.z())});
  return part != nullptr && part->isOccupied(voxel.x() & (kSide - 1), voxel.y() & (kSide - 1), voxel.z() & (kSide - 1));
}

bool VoxelMap::isOccupied(const Vector3& p) const { return p.hasNaN() || isOccupied(voxelAt(p)); }

Box VoxelMap::boxOf(const VoxelIndex& voxel) const {
  return {resolution_ * voxel.cast<double>(), resolution_ * (voxel.cast<double>() + Vector3::Ones())};
}

VoxelMap::Nearest VoxelMap::findNearest(const Vector3& p, double limit) const {
  if (p.hasNaN()) return {0.0, p};
  Nearest nearest{limit, p};
  if (outside_is_occupied_) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double face : {bounds_.min[axis], bounds_.max[axis]}) {
        const double gap = std::max(face == bounds_.min[axis] ? p[axis] - face : face - p[axis], 0.0);
        if (gap >= nearest.distance) continue;
        nearest = {gap, p};
        if (gap > 0.0) nearest.point[axis] = face;
      }
    }
  }
  Box around;
  around.min = p - Vector3::Constant(nearest.distance);
  around.max = p + Vector3::Constant(nearest.distance);
  VoxelIndex first;
  VoxelIndex last;
  clampedRange(around, first, last);
  if ((first.array() > last.array()).any()) return nearest;
  const double limit_in_voxels = nearest.distance / resolution_;
  NearestSearch search(p / resolution_, limit_in_voxels);
  // What is near first: most of the others are then not worth a look.
  const VoxelIndex own = voxelAt(p).unaryExpr([](int voxel) { return chunkOf(voxel); });
  const VoxelChunk* around_p = chunk(own);
  if (around_p != nullptr) search.lookIn(*around_p, kSide * own);
  for (int z = chunkOf(first.z()); z <= chunkOf(last.z()); ++z) {
    for (int y = chunkOf(first.y()); y <= chunkOf(last.y()); ++y) {
      for (int x = chunkOf(first.x()); x <= chunkOf(last.x()); ++x) {
        const VoxelChunk* part = chunk({x, y, z});
        if (part != nullptr && part != around_p) search.lookIn(*part, kSide * VoxelIndex(x, y, z));
      }
    }
  }
  if (search.squaredDistance() >= limit_in_voxels * limit_in_voxels) return nearest;
  return {resolution_ * std::sqrt(search.squaredDistance()), resolution_ * search.point()};
}

std::uint64_t VoxelMap::fingerprint(const Box& box) const {
  std::uint64_t mixed = 0;
  const auto add = [&mixed](std::uint64_t part) {
    mixed = (mixed ^ part) * 0x9e3779b97f4a7c15U;
    mixed ^= mixed >> 29U;
  };
  add(bitsOf(resolution_));
  if (outside_is_occupied_) {
    for (int axis = 0; axis < 3; ++axis) {
      add(bitsOf(bounds_.min[axis]));
      add(bitsOf(bounds_.max[axis]));
    }
  }
  const VoxelIndex first = voxelAt(box.min).unaryExpr([](int voxel) { return chunkOf(voxel); });
  const VoxelIndex last = voxelAt(box.max).unaryExpr([](int voxel) { return chunkOf(voxel); });
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        const VoxelChunk* part = chunk({x, y, z});
        add(part == nullptr ? 0 : part->fingerprint());
      }
    }
  }
  return mixed;
}

bool VoxelMap::isEmpty(const Box& box) const {
  if (outside_is_occupied_ &&
      ((box.min.array() <= bounds_.min.array()).any() || (box.max.array() >= bounds_.max.array()).any())) {
    return false;
  }
  VoxelIndex first;
  VoxelIndex last;
  clampedRange(box, first, last);
  if ((first.array() > last.array()).any()) return true;
  for (int cz = chunkOf(first.z()); cz <= chunkOf(last.z()); ++cz) {
    for (int cy = chunkOf(first.y()); cy <= chunkOf(last.y()); ++cy) {
      for (int cx = chunkOf(first.x()); cx <= chunkOf(last.x()); ++cx) {
        const VoxelChunk* part = chunk({cx, cy, cz});
        if (part == nullptr) continue;
        const VoxelIndex corner = kSide * VoxelIndex(cx, cy, cz);
        if (part->hasIn((first - corner).cwiseMax(0), (last - corner).cwiseMin(kSide - 1))) return false;
      }
    }
  }
  return true;
}

}  // namespace swarm_planner
