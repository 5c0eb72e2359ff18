// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// Everything that a UAV may have to keep clear of in one cycle: obstacles where they will be at the epoch and the
/// newest plan of every UAV.
class Surroundings {
 public:
  Surroundings(const Parameters& parameters, std::size_t uav_count);

  /// Predicts the tracks to `epoch`. A track older than track_timeout at `now` is left out.
  void setObstacles(const std::vector<TrackedObstacle>& tracks, double now, double epoch);
  /// Forgets all UAVs.
  void clearUavs();
  /// The UAV flies `plan`; the stages are those of a horizon that starts at `epoch`.
  void setPlan(std::size_t uav, const Trajectory& plan, double epoch);
  /// The UAV rests at `position`.
  void setResting(std::size_t uav, const Vector3& position);

  /// Fills problem.bodies with what `uav` can reach from problem.start within the horizon.
  void collect(std::size_t uav, UavProblem& problem) const;

 private:
  void collectObstacles(const Box& reach, UavProblem& problem) const;
  void collectUavs(std::size_t uav, const Box& reach, UavProblem& problem) const;

  const Parameters& parameters_;
  std::vector<Superellipsoid> obstacles_;  ///< at the epoch
  std::vector<PredictedMotion> motions_;
  std::vector<char> known_;  ///< whether motions_[uav] holds
};

}  // namespace swarm_planner
