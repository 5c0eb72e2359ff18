// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/swarm/neighbour_lists.hpp"

namespace swarm_planner {

/// Everything that a UAV may have to keep clear of in one cycle: obstacles where they will be at the epoch and the
/// newest plan of every UAV.
class Surroundings {
 public:
  /// Up to `max_obstacles` obstacles before memory has to grow.
  Surroundings(const Parameters& parameters, std::size_t uav_count, std::size_t max_obstacles);

  /// Predicts the tracks to `epoch`.
  void setObstacles(const std::vector<TrackedObstacle>& tracks, double epoch);
  /// Nothing is known of the UAV; others need not keep clear of it.
  void setUnknown(std::size_t uav);
  /// The UAV flies `plan`; the stages are those of a horizon that starts at `epoch`.
  void setPlan(std::size_t uav, const Trajectory& plan, double epoch);
  /// The same for a UAV that cannot be planned for: it rests where `plan` ends.
  void setLastPlan(std::size_t uav, const Trajectory& plan, double epoch);
  /// The UAV rests at `position`.
  void setResting(std::size_t uav, const Vector3& position);

  /// The UAV will plan anew from `start`: it may go wherever its speed takes it within the horizon.
  void setPlanning(std::size_t uav, const KinematicState& start);
  /// Finds out which UAVs can meet within the horizon, once motions and starts of all are set.
  void findNeighbours();
  const NeighbourLists& neighbours() const { return neighbours_; }

  /// Fills problem.bodies with what `uav` can reach from problem.start within the horizon.
  void collect(std::size_t uav, UavProblem& problem) const;

 private:
  struct PredictedTrack {
    Superellipsoid shape;   ///< at the epoch
    double inflation;       ///< at the epoch [m]
    DistanceGrowth growth;  ///< of the inflation from then on
  };

  Box reach(const KinematicState& start) const;
  void collectObstacles(const Box& reach, UavProblem& problem) const;
  void collectUavs(std::size_t uav, const Box& reach, UavProblem& problem) const;

  const Parameters& parameters_;
  double horizontal_;  ///< semi-axes of the pair ellipsoid with the tracking margin [m]
  double vertical_;
  std::vector<PredictedTrack> obstacles_;
  std::vector<PredictedMotion> motions_;
  std::vector<char> known_;  ///< whether motions_[uav] holds
  std::vector<Box> areas_;   ///< where each UAV may be within the horizon, grown by half the pair distance
  NeighbourLists neighbours_;
};

}  // namespace swarm_planner
