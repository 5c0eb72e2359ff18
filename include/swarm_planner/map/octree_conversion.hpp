// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>

#include "swarm_planner/map/octree_data.hpp"
#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// Chunks that a map may need; 4 kB each.
constexpr std::size_t kMostMapChunks = 1 << 17;

/// The occupied voxels of an octree. With `unknown_is_occupied` also those that are not known to be free, and whatever
/// is outside of the box about all that is known. Null and `why` if the octree cannot be read, if nothing in it is
/// known, or if it needs more than kMostMapChunks. Chunks that are as in `previous`, which may be null, are shared.
std::shared_ptr<const VoxelMap> toVoxelMap(const OctreeData& data, bool unknown_is_occupied, const VoxelMap* previous,
                                           std::string& why);

/// A map whose voxels lie along the axes of another frame than the planning frame; `pose` [m] is that of its frame. The
/// result occupies every voxel that has a point in common with the box about an occupied voxel, turned: all of the
/// occupied space, and up to a voxel around it. Null and `why` if `map` counts unknown space as occupied: outside of a
/// turned box no axis-aligned one can say so; or if voxels would be too far away.
std::shared_ptr<const VoxelMap> resampled(const VoxelMap& map, const Eigen::Isometry3d& pose, const VoxelMap* previous,
                                          std::string& why);

}  // namespace swarm_planner
