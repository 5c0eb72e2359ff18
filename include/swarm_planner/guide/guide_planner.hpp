// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "swarm_planner/guide/followed_path.hpp"
#include "swarm_planner/guide/lattice_search.hpp"

namespace swarm_planner {

/// What all guides of one round keep clear of. Times count from the round's time zero.
struct GuideScene {
  std::vector<GuideBody> bodies;
  std::vector<PlannedFlight> flights;   ///< of every UAV, by its index; those not known have an empty box
  double spacing = 0.0;                 ///< of the points of a flight [s]
  std::shared_ptr<const VoxelMap> map;  ///< null: nothing is mapped
  double map_distance = 0.0;            ///< to keep from occupied voxels [m]
};

/// What a UAV is about to do, as far as a guide depends on it.
struct GuideRequest {
  bool wanted = false;              ///< it follows something that a guide may lead round obstacles
  std::uint32_t version = 0;        ///< changes with what is followed: an answer to another one is none
  Vector3 start = Vector3::Zero();  ///< where it will be at time zero [m]
  double speed = 1.0;               ///< at which it will fly, > 0 [m/s]
  FollowedPath path;                ///< from the UAV's foot on
  double reach = 0.0;               ///< how far ahead on the path counts [m]
  Workspace workspace;              ///< for its centre [m]
  /// UAVs at rest count as nothing to go round: it has been held up in spite of guides, and others are to leave its
  /// way.
  bool ignores_uavs = false;
};

/// What is known of a way for a UAV.
enum class GuideState : std::uint8_t {
  kNotNeeded,  ///< the reference is clear within reach
  kGuided,
  kNoWay,   ///< the reference is blocked, and no way round was found
  kWaiting  ///< the reference is blocked; its turn to be searched for has not come
};

/// A way round what blocks a reference.
struct GuideAnswer {
  GuideState state = GuideState::kNotNeeded;
  std::uint32_t version = 0;  ///< of the request
  std::uint32_t number = 0;   ///< changes with the path
  std::uint32_t course = 0;   ///< changes with the way round, not where a path only gives way to what has moved
  GuidePath path;             ///< from where the UAV was to where it is back on the reference
  double branch = 0.0;        ///< arc length on the reference where it was left [m]
  double rejoin = 0.0;        ///< arc length where it is joined again [m]
  bool rejoins = false;       ///< false: the path ends as near to the reference's end as is safe
};

/// How guides are searched.
struct GuideSettings {
  double horizontal = 0.0;  ///< semi-axes of the ellipsoid about another UAV [m]
  double vertical = 0.0;
  double least_gap = 0.0;  ///< clear stretches of a reference that are shorter are none [m]
  double comfort = 0.0;    ///< kept more than demanded, where that leaves a way [m]
  double slack = 0.0;      ///< by which a guide in force may have less than demanded: tracks are noisy [m]
};

/// Finds guides for a swarm, round by round: keeps those that are still good, searches where one is missing, in every
/// round for those first that need it most. Fixed memory, a fixed number of expansions per round, the same rounds give
/// the same guides.
class GuidePlanner {
 public:
  /// Most expansions of all searches of a round, and of one attempt.
  static constexpr int kRoundBudget = 12000;
  static constexpr int kSearchBudget = 3000;
  /// Of one attempt round what a map has: rooms are left by their doors.
  static constexpr int kMapSearchBudget = 12000;

  GuidePlanner(const GuideSettings& settings, std::size_t uavs, std::size_t most_bodies);

  /// One round. `requests` and `answers`: one per UAV; the answers are those of the round before.
  void plan(const GuideScene& scene, const std::vector<GuideRequest>& requests, std::vector<GuideAnswer>& answers);
  /// Of the last round.
  int expansions() const { return expansions_; }
  int searches() const { return searches_; }

 private:
  struct Want {
    std::uint32_t uav = 0;
    double urgency = 0.0;     ///< the greatest is first
    bool is_renewal = false;  ///< it has a guide that is clear
  };
  /// Where a search leads.
  struct Goal {
    Vector3 p = Vector3::Zero();
    double rejoin = 0.0;  ///< way on the followed path [m]
    bool rejoins = false;
  };

  /// How a way is searched.
  struct Attempt {
    bool far = false;     ///< round all that is within reach, not only round the next
    bool comfort = true;  ///< with more distance than demanded
    double cell = 1.0;    ///< of the lattice, over the usual one
    bool level = true;    ///< in a map: not far above or below start and goal
  };

  void sortBodies(const GuideScene& scene);
  /// Fills space_ with what a UAV may meet in `region` until `time` [s].
  void gather(const GuideScene& scene, const GuideRequest& request, std::uint32_t uav, const Box& region, double time);
  /// Fills traffic_ with what other UAVs are about to fly there.
  void gatherTraffic(const GuideScene& scene, std::uint32_t uav, const Box& region);
  /// Finds out whether the UAV needs a guide, or a new one.
  void assess(const GuideScene& scene, const GuideRequest& request, std::uint32_t uav, GuideAnswer& answer);
  /// Whether the rest of a guide, and the reference after it within reach, is clear.
  bool isClearStill(const GuideRequest& request, const GuidePath& rest, const GuideAnswer& answer) const;
  /// Moves the points of a guide that are too near to something away from it. False if that does not make it clear.
  bool repair(const GuideRequest& request, GuideAnswer& answer);
  /// The attempt after one that found nothing.
  Attempt nextAttempt(const Attempt& attempt, SearchOutcome outcome, bool in_map) const;
  /// Sets the lattice and the region of the query for a search that leads to about `towards` [m].
  void shapeQuery(const GuideScene& scene, const Blockage& blockage, const Vector3& towards, const Attempt& attempt);
  void search(const GuideScene& scene, const GuideRequest& request, const Want& want, GuideAnswer& answer);
  /// Makes space_, traffic_ and query_ those of an attempt. Where it leads; none if no place is clear.
  std::optional<Goal> prepare(const GuideScene& scene, const GuideRequest& request, std::uint32_t uav,
                              const Attempt& attempt);
  /// Where a search that is to go round all that is within reach, or (`far` false) the next of it, leads; none if no
  /// place is clear.
  std::optional<Goal> goalOf(const GuideRequest& request, const Blockage& blockage, bool far, double step) const;
  /// The clear point nearest to `end` [m], among some up to some `step` [m] away; of equally near ones that nearest to
  /// `from`.
  std::optional<Vector3> nearestClear(const TimedPoint& end, const Vector3& from, double step) const;
  void take(const GuideRequest& request, const Want& want, const Goal& goal, GuideAnswer& answer);

  GuideSettings settings_;
  BodySpace space_;
  Traffic traffic_;
  LatticeSearch lattice_;
  SearchQuery query_;
  GuidePath found_;
  std::vector<std::uint32_t> by_x_;  ///< bodies in the order of the least x of their boxes
  std::vector<Box> boxes_;           ///< of the bodies over the time looked at
  double widest_ = 0.0;              ///< extent of a box along x [m]
  std::vector<Want> wants_;
  std::vector<Blockage> blockages_;   ///< by UAV, where it is wanted
  std::vector<std::uint32_t> ages_;   ///< rounds since the answer was found
  std::vector<std::uint32_t> waits_;  ///< rounds that a want was passed over
  int expansions_ = 0;
  int searches_ = 0;
};

}  // namespace swarm_planner
