// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/config/rehearsal.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "portable_numbers.hpp"
#include "scenario_parts.hpp"

namespace swarm_planner {
namespace {

constexpr double kFieldSide = 40.0;                // of the field for up to six UAVs [m]
constexpr double kFloor = 3.0, kCeiling = 13.0;    // of the field [m]
constexpr double kMargin = 6.0;                    // of the workspace around the field [m]
constexpr double kColumnRadius = 2.0;              // [m]
constexpr double kFromColumn = 4.0;                // of a start, beyond the column's radius [m]
constexpr double kApart = 5.0;                     // of two starts [m]
constexpr int kMostDraws = 10000;                  // before a place is taken not to exist
constexpr double kQuietEnd = 20.0;                 // without faults, so that all can recover [s]
constexpr double kFirstFault = 5.0;                // [s]
constexpr double kLeastGap = 3.0, kMostGap = 9.0;  // from one fault to the next [s]
constexpr double kCompanionShare = 0.25;           // of the faults that come with a second one
constexpr double kTakeoverTime = 3.0;              // in which a new planner finds out what UAVs do [s]
constexpr double kSeen = 1.5;                      // in which others have new plans round who left its own [s]
constexpr double kCompanionDelay = 1.0;            // at most [s]
constexpr double kShortest = 0.5, kLongest = 5.0;  // durations [s]
static_assert(kLongest < kRehearsalTrackTimeout, "obstacles are to be remembered while their tracks are lost");

/// Where the columns stand, as shares of the field's side.
constexpr double kColumns[][2] = {{0.25, 0.3}, {0.7, 0.35}, {0.45, 0.75}};

/// Magnitudes that are drawn. Pushes and winds move a vehicle by less than tracking_error: more than that no planner
/// can make up for.
struct MagnitudeRange {
  FaultKind kind;
  double least, most;
};
constexpr MagnitudeRange kMagnitudes[] = {
    {FaultKind::kOdometryStale, 1.0, 3.0}, {FaultKind::kOdometryJump, 2.0, 6.0}, {FaultKind::kOdometryDrift, 0.5, 1.5},
    {FaultKind::kPush, 1.0, 2.5},          {FaultKind::kWind, 2.0, 4.0},         {FaultKind::kTracksFlicker, 0.2, 0.6},
};

ScenarioObstacle column(int id, double x, double y) {
  ScenarioObstacle obstacle;
  obstacle.id = id;
  obstacle.center = Vector3(roundedToMicro(x), roundedToMicro(y), 8.0);
  obstacle.radii = Vector3(kColumnRadius, kColumnRadius, 9.0);
  obstacle.exponents = Vector3(2.0, 2.0, 4.0);
  return obstacle;
}

ScenarioObstacle crosser(int id, const Vector3& center, const Vector3& velocity) {
  ScenarioObstacle obstacle;
  obstacle.id = id;
  obstacle.center = center.unaryExpr([](double x) { return roundedToMicro(x); });
  obstacle.radii = Vector3(1.5, 1.5, 2.0);
  obstacle.velocity = velocity;
  return obstacle;
}

Vector3 drawStart(const Scenario& scenario, const Workspace& field, UniformRandom& random) {
  for (int i = 0; i < kMostDraws; ++i) {
    Vector3 start;
    for (int axis = 0; axis < 3; ++axis) start[axis] = random.real(field.min[axis], field.max[axis]);
    const bool clear_of_uavs =
        std::all_of(scenario.uavs.begin(), scenario.uavs.end(),
                    [&start](const ScenarioUav& uav) { return (uav.start - start).norm() >= kApart; });
    const bool clear_of_columns =
        std::all_of(scenario.obstacles.begin(), scenario.obstacles.end(), [&start](const ScenarioObstacle& obstacle) {
          return (obstacle.center - start).head<2>().norm() >= kColumnRadius + kFromColumn;
        });
    if (clear_of_uavs && clear_of_columns) return start;
  }
  throw std::invalid_argument("rehearsal: no place found for so many UAVs");
}

FaultInjection drawFault(double at, const Scenario& scenario, UniformRandom& random) {
  const FaultKindInfo& info =
      faultKinds()[static_cast<std::size_t>(random.whole(0, static_cast<int>(faultKinds().size()) - 1))];
  FaultInjection fault;
  fault.kind = info.kind;
  fault.at = roundedToMicro(at);
  const int uav = random.whole(0, static_cast<int>(scenario.uavs.size()) - 1);
  if (info.of_uav) fault.uav = scenario.uavs[static_cast<std::size_t>(uav)].name;
  if (info.lasts) fault.duration = random.real(kShortest, kLongest);
  for (const MagnitudeRange& range : kMagnitudes) {
    if (range.kind == info.kind) fault.magnitude = random.real(range.least, range.most);
  }
  return fault;
}

bool isOfTracks(FaultKind kind) { return kind == FaultKind::kTracksLost || kind == FaultKind::kTracksFlicker; }

bool isLie(FaultKind kind) {
  return kind == FaultKind::kOdometryFrozen || kind == FaultKind::kOdometryJump || kind == FaultKind::kOdometryDrift;
}

/// Pairs that nobody could cope with. Two outages of tracks in a row last longer than tracks are remembered; a planner
/// that takes over has nothing but odometry and tracks to go by; a vehicle that leaves its trajectory on its own is in
/// the way of others' until a planner has seen it, which a dead one does not; and one that has missed its newest
/// trajectories is where others do not expect it when there are no newer ones.
bool mayCoincide(const FaultInjection& earlier, const FaultInjection& later) {
  if (isOfTracks(earlier.kind) && isOfTracks(later.kind)) return false;
  const bool was_dead = earlier.kind == FaultKind::kPlannerDead;
  const bool dies = later.kind == FaultKind::kPlannerDead;
  if (!was_dead && !dies) return true;
  const FaultKind other = was_dead ? later.kind : earlier.kind;
  if (other == FaultKind::kSetpointsIgnored) {
    return was_dead ? later.at > earlier.at + earlier.duration : later.at > earlier.at + kSeen;
  }
  if (other == FaultKind::kSetpointsLost) return was_dead || later.at > earlier.at + earlier.duration + kSeen;
  return !isOfTracks(other) && !isLie(other);
}

void addFault(double at, Scenario& scenario, UniformRandom& random) {
  const auto fits = [&scenario](const FaultInjection& fault) {
    return std::all_of(scenario.faults.begin(), scenario.faults.end(), [&fault](const FaultInjection& earlier) {
      const double takeover = earlier.kind == FaultKind::kPlannerDead ? kTakeoverTime : 0.0;
      const bool is_over = earlier.at + earlier.duration + takeover + kCompanionDelay < fault.at;
      return is_over || mayCoincide(earlier, fault);
    });
  };
  FaultInjection fault = drawFault(at, scenario, random);
  while (!fits(fault)) fault = drawFault(at, scenario, random);
  scenario.faults.push_back(fault);
}

}  // namespace

Workspace rehearsalField(int uavs) {
  const double side = roundedToMicro(kFieldSide * std::sqrt(std::max(1.0, uavs / 6.0)));
  return {Vector3(0.0, 0.0, kFloor), Vector3(side, side, kCeiling)};
}

Scenario rehearsal(int uavs, double duration, std::uint64_t seed) {
  if (uavs < 1 || !(duration > 0.0)) throw std::invalid_argument("rehearsal needs at least one UAV and some time");
  constexpr double kLead = 45.0;  // of a moving obstacle before the field [m]
  UniformRandom random(seed);
  const Workspace field = rehearsalField(uavs);
  const double side = field.max.x();
  Scenario scenario;
  scenario.name = "rehearsal_" + std::to_string(seed);
  scenario.end.duration = duration;
  for (const auto& at : kColumns) {
    scenario.obstacles.push_back(column(static_cast<int>(scenario.obstacles.size()) + 1, at[0] * side, at[1] * side));
  }
  for (int i = 1; i <= uavs; ++i) {
    const Vector3 start = drawStart(scenario, field, random);
    scenario.uavs.push_back(straightUav(static_cast<std::size_t>(i), start, start, 0.0));
    scenario.uavs.back().reference.resize(1);
  }
  scenario.obstacles.push_back(crosser(4, Vector3(-kLead, 0.5 * side, 7.0), Vector3(0.6, 0.0, 0.0)));
  scenario.obstacles.push_back(crosser(5, Vector3(0.6 * side, side + kLead + 5.0, 9.0), Vector3(0.0, -0.5, 0.0)));
  scenario.workspace = Workspace{field.min - Vector3(kMargin, kMargin, 2.0), field.max + Vector3::Constant(kMargin)};
  scenario.overrides = {{"max_speed", 4.0},     {"max_acceleration", 8.0}, {"uav_radius", 0.4},
                        {"pair_distance", 1.5}, {"tracking_margin", 0.8},  {"pair_margin", 1.6},
                        {"tracking_error", 0.6}};
  for (double at = kFirstFault; at < duration - kQuietEnd; at += random.real(kLeastGap, kMostGap)) {
    addFault(at, scenario, random);
    if (random.real(0.0, 1.0) < kCompanionShare) addFault(at + random.real(0.0, kCompanionDelay), scenario, random);
  }
  return scenario;
}

}  // namespace swarm_planner
