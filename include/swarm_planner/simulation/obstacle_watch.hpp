// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "swarm_planner/obstacles/superellipsoid.hpp"

namespace swarm_planner {

/// Watches the clearance of UAVs from obstacles: centre to the surface S = 1, minus the UAV's radius.
///
/// Exact, yet cheap: an obstacle's bounding box bounds the clearance from below, and only what lies below the least
/// clearance so far, or below zero, is evaluated. A UAV whose slack against every box is larger than what it and the
/// obstacles have moved since is not looked at. Obstacles may move in any way, but do not turn or change their shape.
class ObstacleWatch {
 public:
  using Contact = std::pair<std::size_t, std::size_t>;  ///< UAV, obstacle (indices)

  /// `uav_radius` [m], >= 0.
  explicit ObstacleWatch(double uav_radius);

  /// Looks at one instant; the numbers of UAVs and obstacles must not change between calls. Returns the contacts
  /// (clearance below zero) that were not there at the instant before.
  const std::vector<Contact>& observe(const std::vector<Vector3>& positions,
                                      const std::vector<Superellipsoid>& obstacles);

  /// Least clearance so far [m]; empty without UAVs or obstacles.
  std::optional<double> minClearance() const;

 private:
  double farthestObstacleMove(const std::vector<Superellipsoid>& obstacles);
  void look(std::size_t uav, const Vector3& position, const std::vector<Superellipsoid>& obstacles);

  double uav_radius_;
  double min_clearance_;
  bool measured_ = false;
  double obstacle_travel_ = 0.0;           ///< of the fastest obstacle at each instant, added up [m]
  std::vector<Vector3> obstacle_centers_;  ///< at the last instant
  struct Sleep {
    Vector3 position = Vector3::Zero();  ///< when last looked at
    double obstacle_travel = 0.0;        ///< obstacle_travel_ then
    double slack = -1.0;                 ///< movement that cannot matter [m]
  };
  std::vector<Sleep> sleep_;
  std::vector<Contact> contacts_;  ///< sorted
  std::vector<Contact> contacts_now_;
  std::vector<Contact> entered_;
};

}  // namespace swarm_planner
