// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <limits>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/swarm/committed_motion.hpp"
#include "swarm_planner/swarm/motion_doubt.hpp"

namespace swarm_planner {

// The check that every plan passes before it flies. It judges the continuous curve of plan, stop and rest, and shares
// nothing with the solver's linearisation.
//
// The rule for whatever is demanded, distances and workspace alike.
//
//   Demanded is `least`, all along. Where the motion committed before has less at the time at which the plan starts
//   (UAVs may stand closer than that before the first plan, an obstacle may appear beside one), what it has takes the
//   place of `least`: a plan need not be better than what flies, and must not be worse.
//
// Why it is made so. Let a motion, from its own start on, be followed to within e, and let `least` be the hard distance
// plus e (twice e for a pair). Then
//  - whoever flies a motion that was accepted keeps the hard distance, wherever its start was: every accepted motion
//  keeps
//    `least`, for good;
//  - a refused plan changes nothing: the motion committed before goes on, accepted to its end and its rest;
//  - the motion committed before, from any later point of it on, would be accepted again: it keeps its distance, which
//    under predictions that stay within their stated growth is no less than `least` either. So a plan that starts on
//    the committed motion always exists: nobody is refused for ever;
//  - a start that tracking error has moved below `least` is refused, whatever the plan: one can start from the
//    committed motion instead.
// The margin that plans are made with is larger than e, so that few starts are refused; the check does not ask for it.
// With `least` the hard distance alone, the error of each motion's tracking adds to that of the one before, and the
// hard distance itself may be used up.

/// Distances are proven to within this [m]; it covers rounding and knots that are rounded.
constexpr double kDistanceTolerance = 1e-6;
/// Knots have to follow from their predecessors and jerks to within this [m, m/s, m/s^2].
constexpr double kKnotTolerance = 1e-6;
/// What holds for all UAVs alike.
struct CheckLimits {
  /// Speed, acceleration and thrust; workspace that a centre keeps to, its margin included.
  FlightBounds bounds;
  double bound_slack = 0.0;      ///< by which fraction a start may exceed the bounds
  double workspace_slack = 0.0;  ///< how far outside of bounds.workspace a start may lie [m]
  double pair_horizontal = 0.0;  ///< least semi-axes of the pair ellipsoid (14) [m]
  double pair_vertical = 0.0;
  double look_ahead = 20.0;  ///< how long the resting place must stay clear of obstacles [s]
};

/// An obstacle with constant velocity, and the distance to keep from its surface S = 1 at time t >= stamp:
/// least_distance + growth_rate min(t - stamp, growth_time).
struct PredictedObstacle {
  const Superellipsoid* body = nullptr;                          ///< its centre at `stamp`
  double stamp = 0.0;                                            ///< [s]
  double least_distance = 0.0;                                   ///< >= 0 [m]
  double growth_rate = 0.0;                                      ///< >= 0; how fast the prediction may turn wrong [m/s]
  double growth_time = std::numeric_limits<double>::infinity();  ///< >= 0; how long after the stamp it does [s]
  double valid_until = std::numeric_limits<double>::infinity();  ///< not looked at later [s]
};

/// What an obstacle seen at `stamp` [s] demands: `least` [m] plus its inflation. The shape must outlive the prediction.
PredictedObstacle predictObstacle(const Superellipsoid& shape, double stamp, const TrackInflation& inflation,
                                  double least);

/// A motion that another UAV may be flying.
struct OtherMotion {
  const CommittedMotion* motion = nullptr;
  double valid_until = std::numeric_limits<double>::infinity();  ///< not flown any more then [s]
  MotionDoubt doubt{};  ///< demanded on top of the semi-axes: how far it may be from the motion
};

/// All that a motion has to keep clear of. Every motion that a UAV may be flying, as far as the station knows, is an
/// entry of its own.
struct CheckSurroundings {
  std::vector<PredictedObstacle> obstacles;
  std::vector<OtherMotion> uavs;
  const VoxelMap* map = nullptr;  ///< null: nothing is mapped
  double map_distance = 0.0;      ///< least, from its occupied voxels [m]

  void clear() {
    obstacles.clear();
    uavs.clear();
    map = nullptr;
  }
};

/// Why a plan is refused.
enum class CheckReason {
  kAccepted,
  kNotFinite,      ///< plan, start, obstacle or other motion has a number that is not finite
  kDiscontinuous,  ///< not from the start, or knots that do not follow from the jerks
  kSpeed,
  kAcceleration,
  kJerk,
  kThrust,
  kNoStop,  ///< no stop from the plan's end keeps the bounds
  kWorkspace,
  kObstacle,
  kUav,
  kRestingPlace,  ///< an obstacle comes to where the motion rests
  kOutOfArea,     ///< farther than UAVs that plan at the same time were told
  kMap            ///< too close to an occupied voxel
};
/// In words, for operators. A string literal.
const char* checkReasonText(CheckReason reason);

/// Result of a check: the first thing found against the motion, in the order of CheckReason's bounds, then workspace,
/// map, obstacles and UAVs as listed.
struct CheckVerdict {
  CheckReason reason = CheckReason::kAccepted;
  double time = 0.0;       ///< after the epoch, in the first piece that fails [s]
  int body = -1;           ///< index of the obstacle or UAV in the surroundings
  bool undecided = false;  ///< could not be proven safe, nor shown to be unsafe

  bool accepted() const { return reason == CheckReason::kAccepted; }
};

/// Checks `plan`, which is to start in `start`, and leaves its motion with the stop in `motion` (whether accepted or
/// not, unless it is not finite or discontinuous). `committed`: where the motion committed before is at the plan's
/// epoch [m]. Takes no heap.
CheckVerdict checkPlan(const Trajectory& plan, const KinematicState& start, const Vector3& committed,
                       const CheckLimits& limits, const CheckSurroundings& surroundings, CommittedMotion& motion);

/// Whether a motion whose bounds have been seen to, such as a stop from now on, keeps to the workspace and clear of
/// everything. `committed` as for checkPlan.
CheckVerdict checkClearance(const CommittedMotion& motion, const Vector3& committed, const CheckLimits& limits,
                            const CheckSurroundings& surroundings);

}  // namespace swarm_planner
