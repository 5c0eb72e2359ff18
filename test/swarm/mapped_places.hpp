// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "perfect_flight.hpp"
#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// Builds a place of boxes, to the nearest voxel.
class PlaceBuilder {
 public:
  explicit PlaceBuilder(double resolution) : resolution_(resolution), builder_(resolution) {}

  void addBox(const Vector3& low, const Vector3& high) { builder_.setBox(indexOf(low), indexOf(high)); }
  /// A wall across x from `y_low` to `y_high` and floor to ceiling, with a door in it.
  void addWall(double x, double y_low, double y_high, double door_y, double door_width) {
    addBox({x, y_low, 0.0}, {x + kThickness, door_y - 0.5 * door_width, kHeight});
    addBox({x, door_y + 0.5 * door_width, 0.0}, {x + kThickness, y_high, kHeight});
    addBox({x, y_low, kDoorHeight}, {x + kThickness, y_high, kHeight});
  }
  void addFloorAndCeiling(const Vector3& low, const Vector3& high) {
    addBox({low.x(), low.y(), -0.1}, {high.x(), high.y(), 0.0});
    addBox({low.x(), low.y(), kHeight}, {high.x(), high.y(), kHeight + 0.1});
  }
  std::shared_ptr<const VoxelMap> build() { return builder_.build(); }

  static constexpr double kThickness = 0.1;   // [m]
  static constexpr double kHeight = 2.6;      // [m]
  static constexpr double kDoorHeight = 2.1;  // [m]

 private:
  VoxelIndex indexOf(const Vector3& p) const {
    return {static_cast<int>(std::lround(p.x() / resolution_)), static_cast<int>(std::lround(p.y() / resolution_)),
            static_cast<int>(std::lround(p.z() / resolution_))};
  }

  double resolution_;
  VoxelMapBuilder builder_;
};

/// A hall of 12 m x 6 m about x = 0, cut by a wall with a door of `door_width` [m] at y = 1 m.
std::shared_ptr<const VoxelMap> hallWithDoor(double door_width);

/// Vehicles of 0.2 m radius with pairs 0.5 m apart, at most 1.5 m/s fast.
Mission makeIndoorMission(const std::vector<Vector3>& starts, const std::vector<Vector3>& ends);

/// Flies in a map, and looks how near the vehicles come to its voxels.
class MappedFlight {
 public:
  MappedFlight(const Mission& mission, std::shared_ptr<const VoxelMap> map)
      : mission_(mission), flight_(mission), map_(std::move(map)) {}

  void setMap(std::shared_ptr<const VoxelMap> map) { map_ = std::move(map); }
  const CycleReport& cycle();
  /// Until all are within 0.3 m of their ends, or for so many cycles. Returns how many arrived.
  std::size_t fly(int most_cycles);
  PerfectFlight& flight() { return flight_; }
  double leastVoxelDistance() const { return least_distance_; }  ///< of a centre [m]

 private:
  Mission mission_;
  PerfectFlight flight_;
  std::shared_ptr<const VoxelMap> map_;
  double least_distance_ = std::numeric_limits<double>::infinity();
};

}  // namespace swarm_planner
