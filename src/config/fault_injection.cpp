// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/config/fault_injection.hpp"

#include <algorithm>

#include "number_range.hpp"
#include "spelling.hpp"

namespace swarm_planner {

const std::vector<FaultKindInfo>& faultKinds() {
  static const std::vector<FaultKindInfo> kinds = {
      {FaultKind::kOdometryLost, "odometry_lost", true, true, nullptr, 0.0, 0.0},
      {FaultKind::kOdometryStale, "odometry_stale", true, true, "lag of the stamps [s]", 3600.0, 2.0},
      {FaultKind::kOdometryFrozen, "odometry_frozen", true, true, nullptr, 0.0, 0.0},
      {FaultKind::kOdometryJump, "odometry_jump", true, true, "offset [m]", 1e4, 3.0},
      {FaultKind::kOdometryDrift, "odometry_drift", true, true, "rate of the offset [m/s]", 100.0, 1.0},
      {FaultKind::kOdometryNotFinite, "odometry_not_finite", true, true, nullptr, 0.0, 0.0},
      {FaultKind::kSetpointsLost, "setpoints_lost", true, true, nullptr, 0.0, 0.0},
      {FaultKind::kSetpointsIgnored, "setpoints_ignored", true, true, nullptr, 0.0, 0.0},
      {FaultKind::kPush, "push", true, false, "change of velocity [m/s]", 20.0, 2.0},
      {FaultKind::kWind, "wind", true, true, "wind [m/s]", 30.0, 5.0},
      {FaultKind::kTracksLost, "tracks_lost", false, true, nullptr, 0.0, 0.0},
      {FaultKind::kTracksFlicker, "tracks_flicker", false, true, "probability of a track to be missing", 1.0, 0.5},
      {FaultKind::kPlannerDead, "planner_dead", false, true, nullptr, 0.0, 0.0},
  };
  return kinds;
}

const FaultKindInfo& faultKindInfo(FaultKind kind) { return faultKinds()[static_cast<std::size_t>(kind)]; }

const FaultKindInfo* findFaultKind(const std::string& name) {
  const std::vector<FaultKindInfo>& kinds = faultKinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const FaultKindInfo& x) { return x.name == name; });
  return found != kinds.end() ? &*found : nullptr;
}

std::string faultKindNames() {
  std::string names;
  for (const FaultKindInfo& info : faultKinds()) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

std::optional<FaultInjection> makeFaultInjection(const std::string& kind, const FaultInjection& given,
                                                 const std::vector<std::string>& uavs, std::string& mistake) {
  const FaultKindInfo* info = findFaultKind(kind);
  const NumberRange durations =
      info != nullptr && info->lasts ? NumberRange::aboveUpTo(0.0, kLongestFault) : NumberRange::closed(0.0, 0.0);
  mistake.clear();
  if (info == nullptr) {
    mistake = "kind: found " + quoted(kind) + ", expected one of " + faultKindNames();
  } else if (info->of_uav && std::find(uavs.begin(), uavs.end(), given.uav) == uavs.end()) {
    mistake = "uav: found " + quoted(given.uav) + ", expected the name of a UAV of the scenario";
  } else if (!info->of_uav && !given.uav.empty()) {
    mistake = "uav: found " + quoted(given.uav) + ", expected none: " + kind + " concerns the whole swarm";
  } else if (!NumberRange::closed(0.0, kLongestFault).contains(given.at)) {
    mistake = "delay: expected " + numberIn(NumberRange::closed(0.0, kLongestFault));
  } else if (!durations.contains(given.duration)) {
    mistake = "duration: expected " + (info->lasts ? numberIn(durations) : "0: " + kind + " happens at one instant");
  } else if (info->magnitude == nullptr && given.magnitude != 0.0) {
    mistake = "magnitude: expected 0: " + kind + " has none";
  } else if (!NumberRange::closed(0.0, info->most_magnitude).contains(given.magnitude)) {
    mistake = std::string("magnitude: expected the ") + info->magnitude + ", " +
              numberIn(NumberRange::aboveUpTo(0.0, info->most_magnitude)) + ", or 0 for the default";
  }
  if (!mistake.empty()) return std::nullopt;
  FaultInjection fault = given;
  fault.kind = info->kind;
  if (fault.magnitude == 0.0) fault.magnitude = info->default_magnitude;
  return fault;
}

}  // namespace swarm_planner
