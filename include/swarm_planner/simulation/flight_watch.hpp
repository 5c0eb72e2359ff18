// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/obstacles/superellipsoid.hpp"
#include "swarm_planner/simulation/progress_watch.hpp"

namespace swarm_planner {

/// What one UAV did in a run.
struct UavFlight {
  bool arrived = false;                ///< at the end of the run, see ProgressWatch
  bool stuck = false;                  ///< the same
  std::optional<double> arrival_time;  ///< since when it has been arrived without a break [s]; empty: it is not
  double path_length = 0.0;            ///< flown until it arrived for good, or until the end [m]
  double remaining = 0.0;              ///< from where path_length ends straight to its reference's end [m]
  double lag = 0.0;                    ///< at the end [m]
  /// Distance at the end from the plane through its target across the reference there [m]; positive: behind it.
  double behind_target = 0.0;
  bool target_inside = false;               ///< at the end its target is inside an obstacle, S < 1, or a voxel
  std::optional<double> target_inside_ago;  ///< how long before the end it was so last [s]; empty: never

  /// More than 20 m from its target's plane, without a reason that lies in the target: inside an obstacle, or left one
  /// within the last 30 s.
  bool strayed() const { return isFar() && !hasReason(); }
  /// The same with such a reason.
  bool strayedWithReason() const { return isFar() && hasReason(); }

 private:
  bool isFar() const;
  bool hasReason() const;
};

/// Follows every UAV on its way: how far it flew, when it arrived, and whether its target could be reached at all.
class FlightWatch {
 public:
  /// `map` may be null.
  FlightWatch(std::size_t uavs, std::shared_ptr<const VoxelMap> map) : map_(std::move(map)), uavs_(uavs) {}
  void setMap(std::shared_ptr<const VoxelMap> map) { map_ = std::move(map); }

  /// One instant, `t` [s] since t = 0 of the run; `progress` has observed it.
  void observe(double t, const std::vector<Vector3>& positions, const std::vector<Superellipsoid>& obstacles,
               const ProgressWatch& progress);

  /// Of UAV `uav`, up to the last instant. `progress` as above.
  UavFlight flight(std::size_t uav, const ProgressWatch& progress) const;

 private:
  struct Uav {
    Vector3 position = Vector3::Zero();
    double path_length = 0.0;
    double path_length_at_arrival = 0.0;
    Vector3 position_at_arrival = Vector3::Zero();
    std::optional<double> arrival_time;
    std::optional<double> target_inside_at;  ///< the last time
  };

  std::shared_ptr<const VoxelMap> map_;
  std::vector<Uav> uavs_;
  double time_ = 0.0;
  bool begun_ = false;
};

}  // namespace swarm_planner
