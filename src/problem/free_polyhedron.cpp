// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/free_polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "swarm_planner/problem/moving_body.hpp"

namespace swarm_planner {
namespace {

constexpr double kRounding = 1e-9;  // [m]
constexpr double kMeets = 1e-6;     // nearer than this a segment meets a voxel [m]
constexpr int kHalvings = 6;        // of a window that has too many voxels
constexpr double kAsGood = 0.85;    // of the clearance, that a plane along the axes may have less

Vector3 gaps(const Box& a, const Box& b) { return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0); }

Vector3 middleOf(const Box& box) { return 0.5 * (box.min + box.max); }
Vector3 halfOf(const Box& box) { return 0.5 * (box.max - box.min); }

double leastClearance(const FreePlane& plane, const SegmentPoints& segment) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3& point : segment) least = std::min(least, plane.n.dot(point) - plane.offset);
  return least;
}

std::uint32_t identityOf(const VoxelIndex& index) {
  return (static_cast<std::uint32_t>(index.x()) * 73856093U ^ static_cast<std::uint32_t>(index.y()) * 19349663U ^
          static_cast<std::uint32_t>(index.z()) * 83492791U) &
         0x3fffffffU;
}

}  // namespace

PolyhedronSearch::PolyhedronSearch() {
  blocks_.reserve(kMostBlocks);
  voxels_.reserve(kMostVoxels);
}

void PolyhedronSearch::find(const VoxelMap& map, const SegmentPoints& segment, const Box& window,
                            FreePolyhedron& polyhedron) {
  polyhedron_ = &polyhedron;
  segment_ = segment;
  chord_ = segment[3] - segment[0];
  const double squared_length = chord_.squaredNorm();
  along_ = squared_length > 0.0 ? Vector3(chord_ / squared_length) : Vector3(Vector3::Zero());
  resolution_ = map.resolution();
  hull_ = Box();
  for (const Vector3& point : segment) hull_.include(point);
  polyhedron.window = window;
  for (int halving = 0; halving < kHalvings; ++halving) {
    Box& own = polyhedron.window;
    polyhedron.count = 0;
    polyhedron.clearance = std::min((hull_.min - own.min).minCoeff(), (own.max - hull_.max).minCoeff());
    addBounds(map);
    if (gatherBlocks(map) && separate()) return;
    own = {0.5 * (own.min + hull_.min), 0.5 * (own.max + hull_.max)};
  }
  polyhedron.clearance = 0.0;
}

Vector3 PolyhedronSearch::nearestOnChord(const Vector3& p) const {
  return segment_[0] + std::clamp((p - segment_[0]).dot(along_), 0.0, 1.0) * chord_;
}

void PolyhedronSearch::addBounds(const VoxelMap& map) {
  if (!map.outsideIsOccupied()) return;
  const Box& bounds = map.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      FreePlane plane;
      plane.n = side * Vector3::Unit(axis);
      plane.offset = side > 0.0 ? bounds.min[axis] : -bounds.max[axis];
      plane.voxel = static_cast<std::uint32_t>(2 * axis) + (side > 0.0 ? 1U : 0U);
      const Box& window = polyhedron_->window;
      if ((side > 0.0 ? window.min[axis] : -window.max[axis]) >= plane.offset) continue;
      polyhedron_->planes[polyhedron_->count++] = plane;
      polyhedron_->clearance = std::min(polyhedron_->clearance, std::max(leastClearance(plane, segment_), 0.0));
    }
  }
}

bool PolyhedronSearch::gatherBlocks(const VoxelMap& map) {
  blocks_.clear();
  first_ = map.voxelAt(polyhedron_->window.min);
  last_ = map.voxelAt(polyhedron_->window.max);
  for (int z = first_.z() >> 5; z <= last_.z() >> 5; ++z) {
    for (int y = first_.y() >> 5; y <= last_.y() >> 5; ++y) {
      for (int x = first_.x() >> 5; x <= last_.x() >> 5; ++x) {
        const VoxelChunk* chunk = map.chunk({x, y, z});
        if (chunk != nullptr) gatherBlocks(*chunk, VoxelChunk::kSide * VoxelIndex(x, y, z));
        if (blocks_.size() == kMostBlocks) return false;
      }
    }
  }
  std::sort(blocks_.begin(), blocks_.end(), [](const Block& a, const Block& b) {
    if (a.squared_gap != b.squared_gap) return a.squared_gap < b.squared_gap;
    if (a.box.min.x() != b.box.min.x()) return a.box.min.x() < b.box.min.x();
    return a.box.min.y() != b.box.min.y() ? a.box.min.y() < b.box.min.y() : a.box.min.z() < b.box.min.z();
  });
  return true;
}

void PolyhedronSearch::gatherBlocks(const VoxelChunk& chunk, const VoxelIndex& corner) {
  const VoxelIndex first = (first_ - corner).cwiseMax(0) / VoxelChunk::kBlock;
  const VoxelIndex last = (last_ - corner).cwiseMin(VoxelChunk::kSide - 1) / VoxelChunk::kBlock;
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        const VoxelChunk::Range& range = chunk.block(x, y, z);
        if (range.isEmpty()) continue;
        Box box;
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          box.min[axis] = resolution_ * (corner[axis] + range.first[a]);
          box.max[axis] = resolution_ * (corner[axis] + range.last[a] + 1);
        }
        if (!box.near(polyhedron_->window, 0.0) || isBehindAny(middleOf(box), halfOf(box))) continue;
        if (blocks_.size() == kMostBlocks) return;
        blocks_.push_back({gaps(box, hull_).squaredNorm(), box, &chunk, &range, corner});
      }
    }
  }
}

bool PolyhedronSearch::expand(const Block& block) {
  if (isBehindAny(middleOf(block.box), halfOf(block.box))) return true;
  const Vector3 half = Vector3::Constant(0.5 * resolution_);
  VoxelIndex first;
  VoxelIndex last;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    first[axis] = std::max<int>(block.range->first[a], first_[axis] - block.corner[axis]);
    last[axis] = std::min<int>(block.range->last[a], last_[axis] - block.corner[axis]);
  }
  const std::uint32_t within = bitsBetween(first.x(), last.x());
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      const std::uint32_t surface = block.chunk->surface(y, z) & within;
      std::uint32_t row = inFront(surface, block.corner + VoxelIndex(0, y, z));
      for (; row != 0; row &= row - 1) {
        if (voxels_.size() == kMostVoxels) return false;
        Voxel voxel;
        voxel.index = block.corner + VoxelIndex(lowestBit(row), y, z);
        voxel.middle = resolution_ * voxel.index.cast<double>() + half;
        voxel.squared_distance = (voxel.middle - nearestOnChord(voxel.middle)).squaredNorm();
        voxels_.push_back(voxel);
      }
    }
  }
  return true;
}

std::uint32_t PolyhedronSearch::inFront(std::uint32_t row, const VoxelIndex& corner) const {
  const Vector3 half = Vector3::Constant(0.5 * resolution_);
  const Vector3 middle = resolution_ * corner.cast<double>() + half;
  for (std::size_t i = 0; i < polyhedron_->count && row != 0; ++i) {
    // How far voxel x reaches in front of the plane: from + x * step.
    const FreePlane& plane = polyhedron_->planes[i];
    const double from = plane.n.dot(middle) + plane.n.cwiseAbs().dot(half) - plane.offset - kRounding;
    const double step = resolution_ * plane.n.x();
    const double to = from + 31.0 * step;
    if (from > 0.0 && to > 0.0) continue;
    if (from <= 0.0 && to <= 0.0) return 0;
    // The planes cross the row: -from / step lies from 0 to 31.
    const auto last_before = static_cast<int>(std::floor(-from / step));
    row &= step > 0.0 ? bitsBetween(last_before + 1, 31) : bitsBetween(0, last_before);
  }
  return row;
}

bool PolyhedronSearch::separate() {
  voxels_.clear();
  const Vector3 half = Vector3::Constant(0.5 * resolution_);
  std::size_t next = 0;
  std::size_t nearest = 0;
  const auto findNearest = [this, &nearest](std::size_t first) {
    for (std::size_t i = first; i < voxels_.size(); ++i) {
      if (voxels_[i].squared_distance < voxels_[nearest].squared_distance) nearest = i;
    }
  };
  for (;;) {
    if (next < blocks_.size() && (voxels_.empty() || blocks_[next].squared_gap <= voxels_[nearest].squared_distance)) {
      const std::size_t known = voxels_.size();
      if (!expand(blocks_[next++])) return false;
      findNearest(known);
      continue;
    }
    if (voxels_.empty()) return true;
    if (polyhedron_->count == FreePolyhedron::kMostPlanes) {
      shrinkWindow(next);
      return true;
    }
    if (!addPlane(voxels_[nearest])) return true;
    const FreePlane& plane = polyhedron_->planes[polyhedron_->count - 1];
    voxels_.erase(std::remove_if(voxels_.begin(), voxels_.end(),
                                 [&](const Voxel& voxel) { return isBehind(plane, voxel.middle, half); }),
                  voxels_.end());
    nearest = 0;
    findNearest(0);
  }
}

bool PolyhedronSearch::addPlane(const Voxel& voxel) {
  const Vector3 half = Vector3::Constant(0.5 * resolution_);
  const Vector3 seen_from = nearestOnChord(voxel.middle);
  const Vector3 corner = seen_from.cwiseMax(voxel.middle - half).cwiseMin(voxel.middle + half);
  SegmentPoints relative;
  for (std::size_t i = 0; i < relative.size(); ++i) relative[i] = segment_[i] - corner;
  const Vector3 way = nearestPoint(relative);
  const double length = way.norm();
  if (length < kMeets) {
    polyhedron_->clearance = 0.0;
    return false;
  }
  const auto planeTowards = [&](const Vector3& n) {
    return FreePlane{n, n.dot(voxel.middle) + half.dot(n.cwiseAbs()), identityOf(voxel.index)};
  };
  FreePlane plane = planeTowards(way / length);
  double clearance = leastClearance(plane, segment_);
  // Walls mostly lie along the axes: a plane like that puts away more of a rough one.
  Eigen::Index axis = 0;
  plane.n.cwiseAbs().maxCoeff(&axis);
  const FreePlane along = planeTowards(std::copysign(1.0, plane.n[axis]) * Vector3::Unit(axis));
  const double its_clearance = leastClearance(along, segment_);
  if (its_clearance >= kAsGood * clearance) {
    plane = along;
    clearance = its_clearance;
  }
  polyhedron_->planes[polyhedron_->count++] = plane;
  polyhedron_->clearance = std::min(polyhedron_->clearance, std::max(clearance, 0.0));
  return true;
}

bool PolyhedronSearch::isBehind(const FreePlane& plane, const Vector3& middle, const Vector3& half) const {
  return plane.n.dot(middle) + plane.n.cwiseAbs().dot(half) <= plane.offset + kRounding;
}

bool PolyhedronSearch::isBehindAny(const Vector3& middle, const Vector3& half) const {
  const auto end = polyhedron_->planes.begin() + static_cast<std::ptrdiff_t>(polyhedron_->count);
  return std::any_of(polyhedron_->planes.begin(), end,
                     [&](const FreePlane& plane) { return isBehind(plane, middle, half); });
}

void PolyhedronSearch::shrinkWindow(std::size_t next_block) {
  double room = std::numeric_limits<double>::infinity();
  for (const Voxel& voxel : voxels_) {
    const Vector3 half = Vector3::Constant(0.5 * resolution_);
    room = std::min(room, gaps({voxel.middle - half, voxel.middle + half}, hull_).maxCoeff());
  }
  for (std::size_t i = next_block; i < blocks_.size(); ++i) {
    if (isBehindAny(middleOf(blocks_[i].box), halfOf(blocks_[i].box))) continue;
    room = std::min(room, gaps(blocks_[i].box, hull_).maxCoeff());
  }
  Box& window = polyhedron_->window;
  window.min = window.min.cwiseMax(hull_.min - Vector3::Constant(room));
  window.max = window.max.cwiseMin(hull_.max + Vector3::Constant(room));
}

}  // namespace swarm_planner
