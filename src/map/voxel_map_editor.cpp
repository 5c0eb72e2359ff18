// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/voxel_map_editor.hpp"

#include <stdexcept>
#include <utility>

namespace swarm_planner {
namespace {

constexpr int kSide = VoxelChunk::kSide;

std::size_t rowIndex(int y, int z) { return static_cast<std::size_t>(y + kSide * z); }

}  // namespace

VoxelMapEditor::VoxelMapEditor(std::shared_ptr<const VoxelMap> base) : base_(std::move(base)) {}

void VoxelMapEditor::set(const VoxelIndex& voxel, bool occupied) {
  if (voxel.cwiseAbs().maxCoeff() >= kFarthestVoxel) {
    throw std::out_of_range("voxel index beyond what a map can hold");
  }
  const VoxelIndex index = voxel.unaryExpr([](int i) { return i >> 5; });
  const Order order{index.z(), index.y(), index.x()};
  if (rows_ == nullptr || order != order_) {
    const auto [entry, is_new] = edited_.try_emplace(order);
    rows_ = &entry->second;
    order_ = order;
    const VoxelChunk* chunk = is_new ? base_->chunk(index) : nullptr;
    if (is_new) rows_->fill(0);
    for (int z = 0; chunk != nullptr && z < kSide; ++z) {
      for (int y = 0; y < kSide; ++y) (*rows_)[rowIndex(y, z)] = chunk->row(y, z);
    }
  }
  const VoxelIndex own = voxel - kSide * index;
  std::uint32_t& row = (*rows_)[rowIndex(own.y(), own.z())];
  const std::uint32_t bit = std::uint32_t{1} << own.x();
  row = occupied ? row | bit : row & ~bit;
}

VoxelMap::ChunkPointer VoxelMapEditor::chunkOf(const Rows& rows, const VoxelMap::ChunkPointer& before) {
  auto chunk = std::make_shared<VoxelChunk>();
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) chunk->fillRow(y, z, rows[rowIndex(y, z)]);
  }
  if (before != nullptr && *before == *chunk) return before;
  if (chunk->isFull()) return VoxelMap::fullChunk();
  return chunk->occupiedCount() > 0 ? VoxelMap::ChunkPointer(std::move(chunk)) : nullptr;
}

std::shared_ptr<const VoxelMap> VoxelMapEditor::build() const {
  std::shared_ptr<VoxelMap> map(new VoxelMap());
  map->resolution_ = base_->resolution_;
  map->outside_is_occupied_ = base_->outside_is_occupied_;
  map->bounds_ = base_->bounds_;
  map->chunks_.reserve(base_->chunks_.size() + edited_.size());
  auto old = base_->chunks_.begin();
  const auto orderOf = [](const VoxelMap::Entry& entry) {
    return Order{entry.index.z(), entry.index.y(), entry.index.x()};
  };
  for (const auto& [order, rows] : edited_) {
    while (old != base_->chunks_.end() && orderOf(*old) < order) map->chunks_.push_back(*old++);
    const bool was_there = old != base_->chunks_.end() && orderOf(*old) == order;
    VoxelMap::ChunkPointer chunk = chunkOf(rows, was_there ? old->chunk : nullptr);
    if (was_there) ++old;
    if (chunk != nullptr) map->chunks_.push_back({VoxelIndex(order[2], order[1], order[0]), std::move(chunk)});
  }
  map->chunks_.insert(map->chunks_.end(), old, base_->chunks_.end());
  map->finish();
  return map;
}

}  // namespace swarm_planner
