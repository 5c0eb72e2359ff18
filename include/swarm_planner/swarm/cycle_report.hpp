// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// State of a UAV as PlannerStatus reports it (same numbers as the message's constants).
enum class UavState : std::uint8_t {
  kTracking = 0,
  kHolding = 1,
  kFallback = 2,
  kLost = 3,
  kLanding = 4,
  kStopped = 5
};

/// Why a UAV is in its state.
enum class Reason : std::uint8_t {
  kNone,
  kWaitingForOdometry,  ///< this UAV's odometry has never arrived
  kWaitingForOthers,    ///< another UAV's odometry has never arrived
  kWaitingForStart,     ///< autostart is off
  kOdometryStale,       ///< older than odometry_timeout
  kOdometryFromFuture,
  kOdometryNotFinite,  ///< NaN, infinite or of a size that no UAV is at
  kSolverFailed,       ///< the QP had no answer; the committed motion goes on
  kPlanRefused,        ///< the check refused the plan; the committed motion goes on
  kBraking,            ///< the committed motion is no longer safe either; brakes at once
  kUnsafeRest,         ///< an obstacle will come to where the UAV comes to rest, whatever it plans
  kNoSafePlan,         ///< the least violating motion flies
  kOverrun,            ///< no time was left to plan; the committed motion goes on
  kStraying,           ///< the UAV is farther from its motion than tracking_margin
  kOdometryFrozen,     ///< the position stays the same although the UAV is to move, or says that it does
  kOdometryJumps,      ///< no flight leads from one measurement to the next
  kOdometryBackwards,  ///< stamps go back
  kOdometryDrifts,     ///< the position does not follow the velocity
  kOffPlan,            ///< far from its motion for long: planned for anew from where it is
  kForeign,            ///< another system flies the UAV
  kNoLandingSite,      ///< none is free: it holds and looks again
  kHeld,               ///< the mode's own, as are those that follow: nothing is amiss
  kBrakesToLand,
  kFliesToLandingSite,
  kDescending,
  kLanded,
  kStopped,
  kTakingOver,          ///< in flight at the planner's start: what it flies goes on until inputs are known
  kNotFollowing,        ///< the vehicle does not do what it is told; planned for from where it is
  kGivesWayToObstacle,  ///< an obstacle will come to where it could rest: goes to a place beside its way
  kEvadesUnseen,        ///< without odometry: a new motion, because the one before was not clear any more
  kNoWayRound,          ///< something is in the way of what the UAV follows, and no way round it is found
  kEndNotClear,         ///< the end of what it follows is inside something: it waits as near as is safe
  kGivesWay,            ///< traffic, as are those that follow, with the other one in UavReport::partner: it stays aside
  kWaits,               ///< the other stands in its way
  kParked,              ///< beside its end, which the other occupies
  kOffMotion            ///< as measured last, by more than noise explains: pushed, or it does not follow
};
/// Whether the operator has to look at once: safety cannot be assured any more.
bool isAlarm(Reason reason);
/// Whether it tells of a command that is carried out, not of trouble.
bool isCommanded(Reason reason);
/// Whether it tells what the UAV does because of another one, and nothing is amiss.
bool isTraffic(Reason reason);
/// In words, for operators. A string literal.
const char* reasonText(Reason reason);
/// The same, with why the check refused the solver's plan where that is what led there.
std::string explainReason(Reason reason, CheckReason refusal);
const char* stateText(UavState state);

/// Result of one cycle for one UAV.
struct UavReport {
  UavState state = UavState::kHolding;
  Reason reason = Reason::kWaitingForOdometry;
  std::size_t partner = 0;  ///< index of the other UAV that a reason of traffic tells of
  bool planned = false;     ///< a motion stands and may be published
  double solve_time = 0.0;  ///< [s] of wall clock
  int sqp_iterations = 0;
  int qp_iterations = 0;
  bool overrun = false;                          ///< its turn did not come
  bool solved = false;                           ///< a QP had an answer
  CheckReason refusal = CheckReason::kAccepted;  ///< of the solver's plan; the check may have passed a shorter step
  bool stays = false;      ///< of the solver's plan nothing passed: the motion goes on from where the UAV will be
  double max_slack = 0.0;  ///< largest violation of a constraint by what flies [m, m/s, m/s^2]
  double deviation = 0.0;  ///< of the UAV from what it was to fly, as measured [m]
  double obstacle_clearance =
      0.0;                     ///< smallest predicted, centre to surface minus uav_radius [m]; +inf without obstacle
  double pair_distance = 0.0;  ///< smallest predicted centre distance to another UAV [m]; +inf without
  double lag = 0.0;            ///< arc length from the UAV's foot on its reference to its target [m]
};

/// Result of one cycle.
struct CycleReport {
  std::uint64_t cycle = 0;
  double epoch = 0.0;      ///< [s]
  double time_zero = 0.0;  ///< epoch of t = 0 of the run; valid if started
  bool started = false;
  bool out_of_time = false;        ///< some UAVs were not planned for within the budget
  double cycle_time = 0.0;         ///< snapshot in, plans out [s] of wall clock
  std::size_t refused_tracks = 0;  ///< not finite, absurd, from the future or too many (see TrackMemory)
  std::vector<UavReport> uavs;
};

}  // namespace swarm_planner
