// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/octree_conversion.hpp"

#include <algorithm>
#include <limits>

namespace swarm_planner {
namespace {

/// The voxels from `low` on, up to but without `high`.
struct VoxelRange {
  VoxelIndex low = VoxelIndex::Constant(std::numeric_limits<int>::max());
  VoxelIndex high = VoxelIndex::Constant(std::numeric_limits<int>::min());

  bool isEmpty() const { return (low.array() >= high.array()).any(); }
  void include(const OctreeCube& cube) {
    low = low.cwiseMin(cube.low);
    high = high.cwiseMax(VoxelIndex(cube.low.array() + cube.width));
  }
  VoxelRange within(const VoxelRange& other) const { return {low.cwiseMax(other.low), high.cwiseMin(other.high)}; }
};

VoxelRange rangeOf(const OctreeCube& cube) { return {cube.low, cube.low.array() + cube.width}; }

VoxelIndex chunkOf(const VoxelIndex& voxel) {
  return voxel.unaryExpr([](int i) { return i >> 5; });
}

/// How many chunks a map takes. The cubes come as visitOctree() gives them: those of one chunk one after the other.
class ChunkCount {
 public:
  void add(const VoxelRange& range) {
    const VoxelIndex first = chunkOf(range.low);
    const VoxelIndex last = chunkOf(range.high.array() - 1);
    if (first == last && first == last_) return;
    last_ = last;
    // Of doubles: a range may hold 2^33 chunks.
    count_ += (last - first + VoxelIndex::Ones()).cast<double>().prod();
  }
  double count() const { return count_; }

 private:
  VoxelIndex last_ = VoxelIndex::Constant(std::numeric_limits<int>::max());
  double count_ = 0.0;
};

/// What a map needs, without making it. False and `why` as of toVoxelMap().
bool measure(const OctreeData& data, bool unknown_is_occupied, VoxelRange& known, std::string& why) {
  ChunkCount chunks;
  const auto visit = [&](const OctreeCube& cube) {
    if (cube.state != CubeState::kUnknown) known.include(cube);
    if (cube.state == CubeState::kOccupied) chunks.add(rangeOf(cube));
  };
  if (!visitOctree(data, visit, why)) return false;
  if (known.isEmpty()) {
    why = "it is empty: nothing in it is known";
    return false;
  }
  if (unknown_is_occupied) {
    chunks = ChunkCount();
    chunks.add(known);
  }
  if (chunks.count() <= static_cast<double>(kMostMapChunks)) return true;
  why = "it is too large: it takes more than " + std::to_string(kMostMapChunks) + " cubes of 32 voxels along an edge";
  return false;
}

}  // namespace

std::shared_ptr<const VoxelMap> toVoxelMap(const OctreeData& data, bool unknown_is_occupied, const VoxelMap* previous,
                                           std::string& why) {
  VoxelRange known;
  if (!measure(data, unknown_is_occupied, known, why)) return nullptr;
  VoxelMapBuilder builder(data.resolution);
  const auto visit = [&](const OctreeCube& cube) {
    const bool unknown = cube.state == CubeState::kUnknown;
    if (cube.state == CubeState::kFree || (unknown && !unknown_is_occupied)) return;
    const VoxelRange range = rangeOf(cube).within(known);
    if (!range.isEmpty()) builder.setBox(range.low, range.high);
  };
  visitOctree(data, visit, why);
  if (unknown_is_occupied) builder.setOutsideOccupied(known.low, known.high);
  return builder.build(previous);
}

std::shared_ptr<const VoxelMap> resampled(const VoxelMap& map, const Eigen::Isometry3d& pose, const VoxelMap* previous,
                                          std::string& why) {
  if (map.outsideIsOccupied()) {
    why = "a map in another frame cannot be used while unknown space counts as occupied";
    return nullptr;
  }
  // So much a voxel may overlap its neighbour by rounding [voxels].
  constexpr double kRounding = 1e-6;
  const double resolution = map.resolution();
  const Vector3 half_extents = 0.5 * pose.linear().cwiseAbs() * Vector3::Ones() - Vector3::Constant(kRounding);
  const double farthest = 0.5 * static_cast<double>(kFarthestVoxel);
  VoxelMapBuilder builder(resolution);
  bool near = true;
  map.forEachOccupied(map.bounds(), [&](const VoxelIndex& voxel) {
    const Vector3 center = pose * (resolution * (voxel.cast<double>() + Vector3::Constant(0.5))) / resolution;
    near = near && (center.array().abs() < farthest).all();
    if (!near) return;
    const VoxelIndex low = (center - half_extents).array().floor().cast<int>();
    const VoxelIndex high = (center + half_extents).array().floor().cast<int>();
    builder.setBox(low, high.array() + 1);
  });
  if (near) return builder.build(previous);
  why = "its frame is too far away";
  return nullptr;
}

}  // namespace swarm_planner
