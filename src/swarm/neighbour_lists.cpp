// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/neighbour_lists.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

bool isEmpty(const Box& box) { return !(box.min.array() <= box.max.array()).all(); }

/// A power of two, so that a hash needs no division.
std::size_t bucketCount(std::size_t boxes) {
  std::size_t buckets = 16;
  while (buckets < 2 * boxes) buckets *= 2;
  return buckets;
}

}  // namespace

std::size_t NeighbourLists::bucketOf(const Cell& cell) const {
  const auto mixed = static_cast<std::uint64_t>(cell[0]) * 0x9e3779b97f4a7c15ULL ^
                     static_cast<std::uint64_t>(cell[1]) * 0xc2b2ae3d27d4eb4fULL ^
                     static_cast<std::uint64_t>(cell[2]) * 0x165667b19e3779f9ULL;
  return (mixed ^ mixed >> 29) & (bucket_begin_.size() - 2);
}

void NeighbourLists::reserve(std::size_t boxes) {
  constexpr std::size_t kMostNeighbours = 1000;
  if (boxes == 0) return;
  cells_.reserve(boxes);
  bucket_begin_.reserve(bucketCount(boxes) + 1);
  offsets_.reserve(boxes + 1);
  members_.reserve(boxes);
  filled_.reserve(boxes);
  found_.reserve(boxes * std::min(boxes - 1, kMostNeighbours));
  neighbours_.reserve(boxes * std::min(boxes - 1, kMostNeighbours));
}

void NeighbourLists::build(const std::vector<Box>& boxes) {
  sortIntoBuckets(boxes);
  offsets_.assign(1, 0);
  found_.clear();
  for (std::size_t box = 0; box < boxes.size(); ++box) {
    if (!isEmpty(boxes[box])) findNeighbours(boxes[box], box);
    offsets_.push_back(static_cast<std::uint32_t>(found_.size()));
  }
  sortLists(boxes.size());
}

/// Cells as large as the largest box: two boxes that overlap have their centres in the same or in adjacent cells.
void NeighbourLists::sortIntoBuckets(const std::vector<Box>& boxes) {
  double size = 1e-3;
  for (const Box& box : boxes) {
    if (!isEmpty(box)) size = std::max(size, (box.max - box.min).maxCoeff());
  }
  const std::size_t buckets = bucketCount(boxes.size());
  bucket_begin_.assign(buckets + 1, 0);
  cells_.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (isEmpty(boxes[i])) continue;
    const Vector3 centre = 0.5 * (boxes[i].min + boxes[i].max) / size;
    for (int axis = 0; axis < 3; ++axis) {
      cells_[i][static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(centre[axis]));
    }
    ++bucket_begin_[bucketOf(cells_[i]) + 1];
  }
  for (std::size_t b = 0; b < buckets; ++b) bucket_begin_[b + 1] += bucket_begin_[b];
  members_.resize(bucket_begin_[buckets]);
  // Filled from the back, so that bucket_begin_ ends up where it began and members ascend.
  for (std::size_t i = boxes.size(); i-- > 0;) {
    if (isEmpty(boxes[i])) continue;
    members_[--bucket_begin_[bucketOf(cells_[i]) + 1]] = {cells_[i], boxes[i], static_cast<std::uint32_t>(i)};
  }
  for (std::size_t b = 0; b < buckets; ++b) bucket_begin_[b] = bucket_begin_[b + 1];
  bucket_begin_[buckets] = static_cast<std::uint32_t>(members_.size());
}

void NeighbourLists::findNeighbours(const Box& box, std::size_t index) {
  for (int adjacent = 0; adjacent < 27; ++adjacent) {
    const Cell cell{cells_[index][0] + adjacent % 3 - 1, cells_[index][1] + adjacent / 3 % 3 - 1,
                    cells_[index][2] + adjacent / 9 - 1};
    const std::size_t bucket = bucketOf(cell);
    for (std::uint32_t m = bucket_begin_[bucket]; m < bucket_begin_[bucket + 1]; ++m) {
      const Member& member = members_[m];
      if (member.index != index && member.cell == cell && box.near(member.box, 0.0)) found_.push_back(member.index);
    }
  }
}

/// Overlap is mutual: whoever goes through the lists in order and enters each box with its neighbours meets every
/// list's entries in order.
void NeighbourLists::sortLists(std::size_t boxes) {
  neighbours_.resize(found_.size());
  filled_.assign(boxes, 0);
  for (std::size_t box = 0; box < boxes; ++box) {
    for (std::uint32_t i = offsets_[box]; i < offsets_[box + 1]; ++i) {
      const std::uint32_t other = found_[i];
      neighbours_[offsets_[other] + filled_[other]++] = static_cast<std::uint32_t>(box);
    }
  }
}

}  // namespace swarm_planner
