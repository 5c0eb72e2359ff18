// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "swarm_planner/guide/guide_planner.hpp"
#include "swarm_planner/problem/uav_problem.hpp"
#include "swarm_planner/swarm/cycle_report.hpp"

namespace swarm_planner {

/// The guide that a UAV flies along in place of what it follows, if there is one in force. Takes no heap once made.
class GuidedFlight {
 public:
  GuidedFlight();

  /// The UAV follows `target` in this cycle: a guide for anything else is dropped.
  void setFollowed(const MovingTarget& target);
  /// Counts what was followed so far: of requests.
  std::uint32_t version() const { return version_; }

  /// Takes an answer to a request for what is followed now; others are not looked at.
  void take(const GuideAnswer& answer, const MovingTarget& target);
  /// The next thing followed is another one, even if it is at the same place.
  void forget();

  bool active() const { return active_; }
  /// A plan shifted from the cycle before does not lead along it: the guide is new, or the last plan did not get on.
  /// In a map that holds without a guide, too: a plan may be held up behind something that its path leads round.
  bool needsFreshStart() const { return needs_fresh_start_; }
  /// The plan made for the pose of this cycle ends at `end` [m].
  void notePlan(const Vector3& end, const UavProblem& problem);
  /// Why the UAV is right to stand where it is, kNone if it is not because of what blocks its way.
  Reason reasonToStand() const;
  const ReferencePath& path() const { return path_; }

  /// Makes the problem that of following the guide: its path, and targets that move along it as the UAV can: from its
  /// foot and its speed on, slower round corners. `progress`: of the UAV on what it follows [m]; kept at where the
  /// guide joins that.
  void pose(const MovingTarget& target, double& progress, UavProblem& problem);

 private:
  /// Bounds the speeds at the path's corners.
  void limitCorners(const UavProblem& problem);
  /// The greatest speed at `way` [m] from which every corner ahead is taken slowly enough [m/s].
  double speedAt(double way, double max_speed) const;
  /// Where the target is on the path when it is at `arc_length` of what is followed [m].
  double wayOf(double arc_length) const;

  bool active_ = false;
  bool is_new_ = false;
  bool needs_fresh_start_ = false;
  int held_up_ = 0;  ///< cycles since a fresh start in which the plan did not get on
  /// Targets are ahead on the guide by no more [m]: those far round a corner draw a UAV that is held up towards what
  /// the guide leads round.
  double lead_ = std::numeric_limits<double>::infinity();
  bool has_no_way_ = false;
  std::uint32_t version_ = 0;
  std::uint32_t number_ = 0;
  std::uint32_t course_ = 0;
  const MovingTarget* followed_ = nullptr;
  std::size_t points_ = 0;  ///< of what is followed, with its ends [m]
  Vector3 first_ = Vector3::Zero();
  Vector3 last_ = Vector3::Zero();

  ReferencePath path_;  ///< the guide, then what is followed on from there
  /// Where it turns, and the greatest speed there.
  struct Corner {
    double way = 0.0;    ///< [m]
    double speed = 0.0;  ///< [m/s]
  };
  std::array<Corner, GuidePath::kMostPoints + FollowedPath::kMostPoints> corners_;
  std::size_t corner_count_ = 0;
  double braking_ = 1.0;  ///< before corners, and acceleration after them [m/s^2]
  double progress_ = 0.0;
  double to_rejoin_ = 0.0;  ///< length of the guide [m]
  double branch_ = 0.0;     ///< arc length of what is followed where the guide leaves it [m]
  double rejoin_ = 0.0;     ///< and joins it again [m]
  bool rejoins_ = false;
};

}  // namespace swarm_planner
