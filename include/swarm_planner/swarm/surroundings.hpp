// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/problem/joint_problem.hpp"
#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/swarm/neighbour_lists.hpp"
#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// Everything that a UAV may have to keep clear of in one cycle: obstacles where they will be at the epoch and the
/// motions that every UAV may be flying.
class Surroundings {
 public:
  /// Up to `max_obstacles` obstacles before memory has to grow.
  Surroundings(const Parameters& parameters, std::size_t uav_count, std::size_t max_obstacles);

  /// The cycle's epoch [s]; obstacles and motions are set after it.
  void setEpoch(double epoch);
  /// Predicts the tracks, which have to outlive the cycle, to the epoch. `now`: of the cycle [s].
  void setObstacles(const std::vector<TrackedObstacle>& tracks, double now);
  /// One more obstacle, seen at `stamp` [s]; after the tracks. It has to outlive the cycle.
  void addObstacle(const Superellipsoid& shape, double stamp, const TrackInflation& inflation);
  /// Nothing is known of the UAV; others need not keep clear of it.
  void setUnknown(std::size_t uav);
  /// The UAV flies `newest`, unless its setpoints were lost: then `older` (null: no other), until the cycle after the
  /// newest one's sends others. Both have to outlive the cycle.
  void setMotions(std::size_t uav, const CommittedMotion& newest, const CommittedMotion* older);

  /// The UAV, whose motions are set, is not seen, or seen off them: it may be off them by `doubt`. `aside`: what it may
  /// fly instead, if others are to keep clear of that too; it must outlive the cycle.
  void setDoubt(std::size_t uav, const MotionDoubt& doubt, const CommittedMotion* aside);

  /// The same in the course of the cycle, for a UAV that has its new motion; within the area that others were told of.
  void replaceMotions(std::size_t uav, const CommittedMotion& newest, const CommittedMotion* older);

  /// The UAV will plan anew from `start`: it may go wherever its speed takes it within the horizon.
  void setPlanning(std::size_t uav, const KinematicState& start);
  /// Finds out which UAVs can meet within the horizon, once motions and starts of all are set.
  void findNeighbours();
  const NeighbourLists& neighbours() const { return neighbours_; }
  /// Contains the UAV in this cycle and half the distance to keep from it; empty if it is unknown [m].
  const Box& area(std::size_t uav) const { return areas_[uav]; }
  /// Of a distance vector of two UAVs [m]: 1 is on the pair ellipsoid, at the distance to keep.
  double pairGauge(const Vector3& apart) const;
  /// How close the newest motions of two UAVs come within the horizon, where 1 is the distance to keep; just some
  /// number above `limit` if it is above. Infinite if one is unknown.
  double leastPairGauge(std::size_t first, std::size_t second, double limit) const;

  /// Whether others were told of the place: only there may a motion of the UAV go that is new in this cycle.
  bool isWithinArea(std::size_t uav, const CommittedMotion& motion) const;

  /// Which UAV's newest motion a body that was collected is, if it is one.
  static std::optional<std::size_t> uavOf(const MovingBody& body) {
    if (!body.isUav()) return {};
    return (body.identity() - 1) / 2;
  }
  /// The distances of two UAVs whose motions are certain; `first` and `second` are left to the caller.
  UavPair pairDistances() const;
  /// Fills problem.bodies with what `uav` can reach from problem.start within the horizon.
  void collect(std::size_t uav, UavProblem& problem) const;
  /// Lists all that a motion of `uav` has to keep clear of, for the check.
  void collect(std::size_t uav, CheckSurroundings& surroundings) const;

 private:
  struct PredictedTrack {
    Superellipsoid shape;   ///< at the epoch
    double inflation;       ///< at the epoch [m]
    DistanceGrowth growth;  ///< of the inflation from then on
  };
  /// What a UAV may be flying.
  struct Motions {
    const CommittedMotion* newest = nullptr;  ///< null: unknown
    const CommittedMotion* older = nullptr;
    Box box;              ///< of all motions, with the doubt [m]
    MotionDoubt doubt{};  ///< of each
    int aside = -1;       ///< index of what it may fly instead; negative: nothing
  };
  /// What a UAV that is off its motions may fly instead.
  struct Aside {
    const CommittedMotion* motion = nullptr;
    PredictedMotion prediction;
  };

  void updateBox(Motions& motions) const;
  Box reach(const KinematicState& start) const;
  void collectObstacles(const Box& reach, UavProblem& problem) const;
  void collectUavs(std::size_t uav, const Box& reach, UavProblem& problem) const;
  /// Adds the body of `other` for `uav`, if it is in reach.
  void addUav(std::size_t uav, std::uint32_t other, const PredictedMotion& motion, std::uint32_t identity,
              const Box& reach, UavProblem& problem) const;

  const Parameters& parameters_;
  double obstacle_margin_;  ///< kept on top of the distances [m]
  double pair_margin_;
  double horizontal_;  ///< semi-axes of the pair ellipsoid with the tracking margin [m]
  double vertical_;
  double epoch_ = 0.0;  ///< of the cycle [s]
  std::vector<PredictedTrack> obstacles_;
  std::vector<PredictedObstacle> checked_obstacles_;
  std::vector<Motions> motions_;
  std::vector<Aside> asides_;
  std::vector<PredictedMotion> predictions_;  ///< of the newest motions
  std::vector<Box> areas_;                    ///< where each UAV may be, grown by half the pair distance [m]
  NeighbourLists neighbours_;
};

}  // namespace swarm_planner
