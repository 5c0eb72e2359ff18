// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/map/octree_data.hpp"
#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// Where UAVs are as a cloud is taken: what it tells of these balls is them, or hidden by them.
struct BodyPlaces {
  std::vector<Vector3> centers;  ///< planning frame [m]
  double radius = 0.0;           ///< [m]
};

/// A map made from point clouds by OctoMap: a cell is occupied where points lie, and free where the sensor saw through.
class CloudMap {
 public:
  /// An empty one. `resolution` [m], within that of maps.
  explicit CloudMap(double resolution);
  /// One that clouds are added to. `present` is what toVoxelMap() makes of it; null: not known. Throws
  /// std::invalid_argument if the octree cannot be read.
  explicit CloudMap(const OctreeData& start, std::shared_ptr<const VoxelMap> present = nullptr);
  ~CloudMap();
  CloudMap(CloudMap&&) noexcept;
  CloudMap& operator=(CloudMap&&) noexcept;

  double resolution() const;

  /// Whether the octree holds all that a sensor at `origin` may see within `max_range` [m]: it ends somewhere.
  bool reaches(const Vector3& origin, double max_range) const;
  /// What a sensor at `origin` sees. Up to `max_range` [m] a ray's cells are free, and that of its point is occupied;
  /// of a point farther away only the free part counts. Points in `bodies` are left out, and what is known of the cells
  /// there stays: without its own points a wall beside the sensor would be taken for free by the rays to those farther
  /// along. Returns how many points were used: finite ones; none if the octree does not reach there.
  std::size_t insert(const std::vector<Vector3>& points, const Vector3& origin, double max_range,
                     const BodyPlaces& bodies = {});

  /// Its present state, as toVoxelMap() of an octree. Of the last one only the voxels that clouds have changed since
  /// are made anew; all of them where there is none, or where `unknown_is_occupied` and more space has become known
  /// about.
  std::shared_ptr<const VoxelMap> voxels(bool unknown_is_occupied, const VoxelMap* previous, std::string& why);

 private:
  /// OctoMap computes in single precision: rays are cut to this [m] before it sees them. It moves points into the
  /// middle of voxels, and cuts rays then: to be cut there, they have to be some voxels longer.
  double longestRay(double max_range) const;
  std::shared_ptr<const VoxelMap> convertAll(bool unknown_is_occupied, const VoxelMap* previous,
                                             std::string& why) const;
  /// The last map with what has changed; null where that will not do.
  std::shared_ptr<const VoxelMap> convertChanges() const;

  struct Tree;  // keeps OctoMap's headers from whoever includes this
  std::unique_ptr<Tree> tree_;
  std::shared_ptr<const VoxelMap> last_;  ///< the tree without the changes that it has noted
};

}  // namespace swarm_planner
