// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/flight_director.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

constexpr int kRoom = 2;                     // times the stages of the quickest stop that a hold brakes in
constexpr double kAtSite = 0.2;              // from the column of its site a UAV may descend [m]
constexpr double kOffSite = 1.0;             // from it a UAV has been pushed out of it [m]
constexpr double kSlow = 0.3;                // a UAV that moves less hardly moves [m/s]
constexpr double kQuietTime = 2.0;           // that a UAV hardly moves before that counts [s]
constexpr double kPointPath = 1e-3;          // length of a path that is a point with a direction [m]
constexpr double kPushedAway = 0.2;          // from its place a UAV holds at another [m]
constexpr double kAtGround = 0.1;            // of what is flown to the ground, a landing's end [m]
constexpr double kNearGround = 0.15;         // of the UAV, as measured [m]
constexpr double kStandsWithin = 1.0;        // of where it comes to rest a slow UAV stands [m]
constexpr std::size_t kChecksPerCycle = 64;  // of sites that were given
constexpr std::size_t kMostEffort = 200000;  // distances in a cycle, about a millisecond; one UAV may take more

double horizontalDistance(const Vector3& a, const Vector3& b) { return (a - b).head<2>().norm(); }

}  // namespace

FlightDirector::FlightDirector(const Mission& mission, const Parameters& parameters)
    : parameters_(parameters),
      bounds_(parameters, mission.scenario.workspace ? &*mission.scenario.workspace : nullptr),
      approach_speed_(0.5 * parameters.limits.max_speed),
      sites_(parameters, mission.scenario.workspace, mission.scenario.uavs.size()) {
  waiting_.reserve(mission.scenario.uavs.size());
}

void FlightDirector::direct(double epoch, const UavMeasurement& measured, UavRecord& record,
                            const VoxelMap* map) const {
  FlightTask& task = record.task;
  lookAtFloor(record);
  if (measured.v.norm() > kSlow) task.quiet_since = epoch;
  switch (task.mode) {
    case FlightMode::kHolding:
    case FlightMode::kStopped:
      hold(epoch, record);
      break;
    case FlightMode::kLanding:
      land(epoch, measured, record, map);
      break;
    case FlightMode::kLanded:
      if (!task.placed) task.follow(record.start.p, record.start.p, 0.0, epoch);
      task.placed = true;
      break;
    case FlightMode::kWaiting:
    case FlightMode::kFlying:
    case FlightMode::kAbsent:
      break;
  }
}

void FlightDirector::lookAtFloor(UavRecord& record) const {
  FlightTask& task = record.task;
  const double height = record.start.p.z();
  const double least = bounds_.workspace.min.z() - parameters_.limits.tracking_margin;
  const bool lands = task.mode == FlightMode::kLanding || task.mode == FlightMode::kLanded;
  if (lands) {
    if (!task.placed) task.floor = std::min(parameters_.landing.ground_height, height);
    task.below_workspace = true;
  } else if (height >= least) {
    task.below_workspace = false;
  } else if (!record.planned && height < least - parameters_.limits.tracking_margin) {
    // Not planned for yet: it stands on the ground.
    task.floor = height;
    task.below_workspace = true;
  }
}

Vector3 FlightDirector::placeOfRest(double epoch, const UavRecord& record, bool quickest) const {
  const KinematicState x = record.planned ? record.motions.flown().at(epoch) : record.start;
  StopManoeuvre stop;
  planStop(x, parameters_.time.sampling_time, bounds_, stop);
  if (!quickest) rollOutStop(x, std::min(kRoom * stop.stages, kMaxStopStages), parameters_.time.sampling_time, stop);
  Vector3 place = stop.restingPlace();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = axis == 2 && record.task.below_workspace ? record.task.floor : bounds_.workspace.min[axis];
    place[axis] = std::max(std::min(place[axis], bounds_.workspace.max[axis]), low);
  }
  return place;
}

bool FlightDirector::brake(double epoch, UavRecord& record) const {
  FlightTask& task = record.task;
  if (task.at_rest) return true;
  task.place = placeOfRest(epoch, record, task.mode == FlightMode::kStopped);
  // Cost (16) holds a UAV to its path across it, by alpha and beta, and hardly along it: a path of next to no length
  // across the way that it comes.
  const Vector3& v = record.start.v;
  const bool comes_level = v.head<2>().norm() >= std::abs(v.z());
  task.follow(task.place, task.place + kPointPath * (comes_level ? Vector3::UnitZ() : Vector3::UnitX()), 0.0, epoch);
  task.placed = true;
  task.at_rest = record.start.v.norm() < kSlow;
  task.quiet_since = task.next_search = epoch;
  return false;
}

void FlightDirector::hold(double epoch, UavRecord& record) const {
  FlightTask& task = record.task;
  if (!brake(epoch, record)) return;
  const bool is_kept_away = (record.start.p - task.place).norm() > kPushedAway;
  if (epoch - task.quiet_since < kQuietTime || !is_kept_away) return;
  // Pressing on would only keep UAVs that share a place in motion.
  task.place = record.start.p;
  task.follow(task.place, task.place, 0.0, epoch);
}

void FlightDirector::land(double epoch, const UavMeasurement& measured, UavRecord& record, const VoxelMap* map) const {
  FlightTask& task = record.task;
  // Whatever stands beside it: who is on the ground already stays there.
  const bool is_on_ground = measured.p.z() < parameters_.landing.ground_height + kNearGround;
  if (!task.placed && is_on_ground && measured.v.norm() < kSlow) {
    task.enter(transition(task.mode, FlightEvent::kTouchdown).mode);
    return;
  }
  if (!brake(epoch, record) || task.phase == LandingPhase::kBraking) return;
  const bool is_above = horizontalDistance(record.start.p, task.site) < kAtSite;
  if (task.phase == LandingPhase::kDescending) {
    descend(epoch, measured, record, map);
  } else if (is_above && record.start.v.head<2>().norm() < kSlow) {
    const double height = std::max(record.start.p.z(), task.site.z());
    task.follow(Vector3(task.site.x(), task.site.y(), height), task.site, descentSpeed(), epoch);
    task.phase = LandingPhase::kDescending;
    task.quiet_since = epoch;
  } else if (epoch - task.quiet_since > kQuietTime) {
    giveUpSite(epoch, record);  // it does not get there: another one, from where it is
  } else {
    task.leadFrom(record.start.p, epoch);
  }
}

void FlightDirector::giveUpSite(double epoch, UavRecord& record) {
  FlightTask& task = record.task;
  task.phase = LandingPhase::kBraking;
  task.at_rest = false;
  task.next_search = epoch;
}

bool FlightDirector::isAtFloor(const VoxelMap* map, const Vector3& place) const {
  if (map == nullptr) return false;
  const double least = parameters_.limits.uav_radius + parameters_.limits.tracking_error;
  return map->distance(place - kAtGround * Vector3::UnitZ(), least) < least;
}

void FlightDirector::descend(double epoch, const UavMeasurement& measured, UavRecord& record,
                             const VoxelMap* map) const {
  FlightTask& task = record.task;
  if (horizontalDistance(record.start.p, task.site) > kOffSite) {
    const Vector3 above(task.site.x(), task.site.y(), record.start.p.z());
    task.follow(record.start.p, above, approach_speed_, epoch);
    task.phase = LandingPhase::kApproach;
    task.quiet_since = epoch;
    return;
  }
  task.leadFrom(record.start.p, epoch);
  if (!record.planned || measured.v.norm() > kSlow) return;
  const CommittedMotion& motion = record.motions.flown();
  const bool is_down = measured.p.z() < task.site.z() + kNearGround;
  // Ground that is higher than it was said to be: the UAV is to go down and does not move.
  const bool is_to_descend = motion.at(epoch + kQuietTime).p.z() < measured.p.z() - kAtGround;
  const bool is_held_up = is_to_descend && epoch - task.quiet_since > kQuietTime;
  // So does a floor that is mapped, but the motion knows of it.
  const bool ends_at_floor = isAtFloor(map, motion.restingPlace()) && epoch - task.quiet_since > kQuietTime;
  const bool ends_down = motion.restingPlace().z() < task.site.z() + kAtGround;
  if ((is_down && ends_down) || is_held_up || ends_at_floor)
    task.enter(transition(task.mode, FlightEvent::kTouchdown).mode);
}

double FlightDirector::descentSpeed() const { return std::min(parameters_.landing.speed, approach_speed_); }

void FlightDirector::takeColumns(const std::vector<UavRecord>& uavs) {
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    const FlightTask& task = uavs[i].task;
    if (task.mode == FlightMode::kLanding) {
      if (task.phase != LandingPhase::kBraking) sites_.take(i, task.site);
      continue;
    }
    if (!isPlannedFor(task.mode)) {
      const std::optional<UavMeasurement>& seen = uavs[i].monitor.trusted();
      if (seen && seen->v.norm() < kSlow) sites_.take(i, seen->p);
      continue;
    }
    if (uavs[i].motions.empty()) continue;
    const Vector3& rest = uavs[i].motions.flown().restingPlace();
    const bool stands = uavs[i].start.v.norm() < kSlow && (uavs[i].start.p - rest).norm() < kStandsWithin;
    if (stands || task.mode == FlightMode::kLanded) sites_.take(i, rest);
  }
}

void FlightDirector::releaseBlockedSites(double epoch, const std::vector<Reason>& judged,
                                         std::vector<UavRecord>& uavs) {
  for (std::size_t k = 0; k < std::min(kChecksPerCycle, uavs.size()); ++k) {
    next_check_ = (next_check_ + 1) % uavs.size();
    FlightTask& task = uavs[next_check_].task;
    const bool has_site = task.mode == FlightMode::kLanding && task.phase != LandingPhase::kBraking;
    if (!has_site || judged[next_check_] != Reason::kNone) continue;
    const Vector3& p = uavs[next_check_].start.p;
    if (sites_.canKeep(next_check_, task.site, p.z())) continue;
    giveUpSite(epoch, uavs[next_check_]);
  }
}

void FlightDirector::assignSites(double epoch, const std::vector<TrackedObstacle>& obstacles,
                                 const std::vector<Reason>& judged, std::vector<UavRecord>& uavs, const VoxelMap* map) {
  waiting_.clear();
  bool lands = false;
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    const FlightTask& task = uavs[i].task;
    if (task.mode != FlightMode::kLanding) continue;
    lands = true;
    const bool searches = task.at_rest && task.phase == LandingPhase::kBraking && epoch >= task.next_search;
    if (searches && judged[i] == Reason::kNone) waiting_.push_back(i);
  }
  if (!lands) return;
  sites_.begin(obstacles, epoch, map);
  takeColumns(uavs);
  releaseBlockedSites(epoch, judged, uavs);
  // From the lowest up: of UAVs above each other it is the upper ones that give way, at their own height.
  std::sort(waiting_.begin(), waiting_.end(), [&uavs](std::size_t a, std::size_t b) {
    const double low = uavs[a].task.place.z();
    const double high = uavs[b].task.place.z();
    return low != high ? low < high : a < b;
  });
  for (const std::size_t i : waiting_) {
    FlightTask& task = uavs[i].task;
    const std::optional<Vector3> site = sites_.find(i, task.place, task.floor);
    task.has_no_site = !site;
    if (site) {
      task.site = *site;
      task.follow(task.place, Vector3(site->x(), site->y(), task.place.z()), approach_speed_, epoch);
      task.phase = LandingPhase::kApproach;
      task.quiet_since = epoch;
      sites_.take(i, *site);
    } else {
      task.next_search = epoch + kQuietTime;
    }
    if (sites_.effort() > kMostEffort) break;
  }
}

}  // namespace swarm_planner
