// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// Watches the clearance of UAVs from the voxels of a map: centre to the nearest occupied voxel's surface, minus the
/// UAV's radius. Exact, yet cheap: a UAV that has moved less since it was looked at than would make a difference is not
/// looked at.
class MapWatch {
 public:
  /// `map` null: there is nothing to keep clear of. `uav_radius` [m], >= 0.
  MapWatch(std::shared_ptr<const VoxelMap> map, double uav_radius);

  /// Watches the clearance from another map from now on, or from none; what was seen so far stays.
  void setMap(std::shared_ptr<const VoxelMap> map);

  /// Looks at one instant; the number of UAVs must not change between calls. Returns the UAVs that are in contact
  /// (clearance below zero) and were not at the instant before.
  const std::vector<std::size_t>& observe(const std::vector<Vector3>& positions);

  /// Least clearance so far [m]; empty without UAVs or without anything occupied.
  std::optional<double> minClearance() const;

 private:
  struct Uav {
    Vector3 position = Vector3::Zero();  ///< when last looked at
    double slack = -1.0;                 ///< movement that cannot matter [m]
    bool in_contact = false;
  };

  /// At least min(distance to the nearest occupied voxel, what matters) [m]; exact below that.
  double distanceThatMatters(const Vector3& position) const;
  bool look(Uav& uav, const Vector3& position);

  std::shared_ptr<const VoxelMap> map_;
  double uav_radius_;
  double min_clearance_;
  std::vector<Uav> uavs_;
  std::vector<std::size_t> entered_;
};

}  // namespace swarm_planner
