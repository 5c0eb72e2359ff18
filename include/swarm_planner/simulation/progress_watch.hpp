// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// Follows every UAV along its reference: lag, stuck, arrived (INTERFACES "Experiment program").
class ProgressWatch {
 public:
  /// Tolerance of "arrived" in runs whose end condition has none [m].
  static constexpr double kDefaultTolerance = 0.2;
  /// A UAV is looked at over this time to tell whether it is stuck [s].
  static constexpr double kStuckTime = 20.0;

  explicit ProgressWatch(const Mission& mission);

  /// One instant, `t` [s] since t = 0 of the run.
  void observe(double t, const std::vector<Vector3>& positions, const std::vector<Vector3>& velocities);

  /// Arc length from the UAV's nearest point on its reference to its target [m]; negative: ahead of it. Nearest means
  /// within 5 m of arc length of the last one; the first is looked for along the whole reference.
  double lag(std::size_t uav) const;

  /// The foot: the UAV's nearest point on its reference.
  const PathPoint& foot(std::size_t uav) const { return feet_[uav]; }
  /// The target at the last instant.
  const TargetState& target(std::size_t uav) const { return targets_[uav]; }

  /// Where its reference ends [m].
  Vector3 end(std::size_t uav) const;
  /// Direction of the reference where the target is.
  Vector3 targetTangent(std::size_t uav) const;

  /// Lags more than 20 m (with all_at_goal: more than the tolerance), has not arrived, and in the last 20 s (or since
  /// the start, if that is shorter) advanced less than 1 m along the reference and moved less than 5 m net.
  bool stuck(std::size_t uav) const;

  /// Within the tolerance of its reference's end, or parked: almost at rest at the allowed distance around its end,
  /// where another UAV that has reached its own end leaves no room; or, where that place is taken as well, at the
  /// allowed distance from two that have arrived nearer to its end, at ends that exclude its own.
  bool arrived(std::size_t uav) const;

  /// Every UAV is within the tolerance of its reference's end.
  bool allAtGoal() const;
  /// Every target has crossed the plane x = `x` [m] in the direction from its start to its reference's end, or stands
  /// still for good.
  bool allTargetsCrossed(double x) const;

 private:
  struct Past {
    double time;
    std::vector<double> arc_lengths;
    std::vector<Vector3> positions;
  };

  void remember();
  bool atEnd(std::size_t uav) const;
  bool parked(std::size_t uav) const;
  bool parkedBehind(std::size_t uav) const;
  void findArrived() const;

  EndCondition end_;
  double pair_distance_;           ///< horizontal semi-axis of the pair ellipsoid [m]
  double pair_distance_vertical_;  ///< vertical one [m]
  double parking_margin_ = 0.0;    ///< on top of both [m]
  std::vector<MovingTarget> references_;
  double time_ = 0.0;
  std::vector<PathPoint> feet_;
  std::vector<TargetState> targets_;
  std::vector<Vector3> positions_;
  std::vector<Vector3> velocities_;
  std::deque<Past> past_;              ///< of the last 20 s, sparse
  mutable std::vector<bool> arrived_;  ///< at the last instant; empty: not found out yet
};

}  // namespace swarm_planner
