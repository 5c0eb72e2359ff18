// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace swarm_planner {

/// What can be made to go wrong in simulation, so that users can rehearse it.
enum class FaultKind {
  kOdometryLost,       ///< no odometry of the UAV arrives
  kOdometryStale,      ///< its stamps lag by the magnitude [s]; the values are those of the present
  kOdometryFrozen,     ///< it repeats the values of the fault's beginning under new stamps
  kOdometryJump,       ///< a horizontal offset of the magnitude [m] is added to its position
  kOdometryDrift,      ///< the same, growing from zero at the magnitude's rate [m/s]
  kOdometryNotFinite,  ///< its position is not a number
  kSetpointsLost,      ///< no setpoints reach the vehicle: it flies the last trajectory to its end
  kSetpointsIgnored,   ///< the vehicle brakes and hovers
  kPush,               ///< a horizontal kick: its velocity changes by the magnitude [m/s] at once
  kWind,               ///< horizontal wind of the magnitude [m/s] blows it off course
  kTracksLost,         ///< no obstacle tracks arrive
  kTracksFlicker,      ///< each obstacle is missing from each message with the magnitude's probability
  kPlannerDead,        ///< nothing is planned; then a new planner takes over, every other time without a record
};

/// What a kind of fault is about and what its magnitude means.
struct FaultKindInfo {
  FaultKind kind;
  const char* name;          ///< in scenario files and services
  bool of_uav;               ///< concerns one UAV; else the whole swarm
  bool lasts;                ///< has a duration; else it happens at one instant
  const char* magnitude;     ///< meaning and unit; null: the kind has none
  double most_magnitude;     ///< magnitudes are above 0 and at most this
  double default_magnitude;  ///< where none is given
};

/// Every kind, in the order of the enumeration.
const std::vector<FaultKindInfo>& faultKinds();
const FaultKindInfo& faultKindInfo(FaultKind kind);
/// Null if there is no such kind.
const FaultKindInfo* findFaultKind(const std::string& name);
/// "odometry_lost, odometry_stale, ..."
std::string faultKindNames();

/// One fault to be injected.
struct FaultInjection {
  FaultKind kind = FaultKind::kOdometryLost;
  std::string uav;         ///< its name; empty for kinds that concern the whole swarm
  double at = 0.0;         ///< when it begins, after t = 0 of the run [s], >= 0
  double duration = 0.0;   ///< [s], > 0; 0 for kinds that happen at one instant
  double magnitude = 0.0;  ///< as FaultKindInfo says; 0 for kinds without
};

/// Longest duration of a fault [s].
constexpr double kLongestFault = 1e5;

/// A fault from what a service was given, checked by the rules of a scenario file but with 0 for the kind's default
/// magnitude. `uavs` are the names of the scenario. Nothing if it cannot be: `mistake` then says what was expected.
std::optional<FaultInjection> makeFaultInjection(const std::string& kind, const FaultInjection& given,
                                                 const std::vector<std::string>& uavs, std::string& mistake);

}  // namespace swarm_planner
