// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "perfect_flight.hpp"

#include <algorithm>
#include <string>

#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {

Mission makeTestMission(const std::vector<Vector3>& starts, const std::vector<Vector3>& ends, double speed) {
  Mission mission;
  mission.scenario.name = "test";
  for (std::size_t i = 0; i < starts.size(); ++i) {
    ScenarioUav uav;
    uav.name = "uav" + std::to_string(i + 1);
    uav.start = starts[i];
    uav.reference = {starts[i], ends[i]};
    uav.target.speed = speed;
    mission.scenario.uavs.push_back(uav);
  }
  return mission;
}

Mission twoAbreast() {
  return makeTestMission({Vector3(0, 0, 10), Vector3(0, 10, 10)}, {Vector3(90, 0, 10), Vector3(90, 10, 10)}, 3.0);
}

Mission crossingPair() {
  return makeTestMission({Vector3(-20, 0, 10), Vector3(0, -20, 10)}, {Vector3(20, 0, 10), Vector3(0, 20, 10)}, 3.0);
}

Snapshot snapshotOf(const Mission& mission, double now) {
  Snapshot snapshot;
  snapshot.now = now;
  for (const ScenarioUav& uav : mission.scenario.uavs) snapshot.uavs.push_back({true, now, uav.start, Vector3::Zero()});
  return snapshot;
}

bool identical(const CommittedMotion& a, const CommittedMotion& b) {
  bool same = a.epoch() == b.epoch() && a.dt() == b.dt() && a.pieces() == b.pieces();
  for (int k = 0; same && k <= a.pieces(); ++k) same = a.piece(k) == b.piece(k);
  return same;
}

PerfectFlight::PerfectFlight(const Mission& mission, double start_time, PlanningMode mode)
    : mission_(mission),
      planner_(mission, mode),
      start_time_(start_time),
      now_(start_time),
      flown_(mission.scenario.uavs.size()) {
  snapshot_.uavs.resize(mission.scenario.uavs.size());
}

const CycleReport& PerfectFlight::cycle(const std::function<void(Snapshot&)>& tamper, double budget) {
  measure();
  if (tamper) tamper(snapshot_);
  const double epoch = now_ + mission_.parameters.time.cycle_period;
  planner_.searchGuides();
  const CycleReport& report = planner_.plan(snapshot_, epoch, budget);
  watch(now_, epoch);
  now_ = epoch;
  for (std::size_t i = 0; i < flown_.size(); ++i) {
    if (report.uavs[i].planned) flown_[i] = planner_.committed(i);
  }
  return report;
}

KinematicState PerfectFlight::vehicle(std::size_t uav, double t) const {
  KinematicState rest;
  rest.p = mission_.scenario.uavs[uav].start;
  if (!flown_[uav]) return rest;
  return flown_[uav]->at(t);
}

Superellipsoid PerfectFlight::obstacle(std::size_t index, double t) const {
  return makeObstacle(mission_.scenario.obstacles[index]).movedBy(t - start_time_);
}

void PerfectFlight::measure() {
  snapshot_.now = now_;
  for (std::size_t i = 0; i < flown_.size(); ++i) {
    const KinematicState x = vehicle(i);
    snapshot_.uavs[i] = {true, now_, x.p, x.v};
  }
  snapshot_.obstacles.clear();
  for (std::size_t i = 0; i < mission_.scenario.obstacles.size(); ++i) {
    TrackedObstacle track;
    track.shape = obstacle(i, now_);
    track.stamp = now_;
    snapshot_.obstacles.push_back(track);
  }
}

void PerfectFlight::watch(double from, double to) {
  constexpr int kSamples = 20;
  for (int s = 0; s < kSamples; ++s) {
    const double t = from + (to - from) * s / kSamples;
    for (std::size_t i = 0; i < flown_.size(); ++i) {
      const Vector3 p = vehicle(i, t).p;
      for (std::size_t j = 0; j < i; ++j) {
        least_pair_gauge_ = std::min(least_pair_gauge_, pairGauge(p - vehicle(j, t).p, mission_.parameters.limits));
      }
      for (std::size_t j = 0; j < mission_.scenario.obstacles.size(); ++j) {
        least_obstacle_distance_ = std::min(least_obstacle_distance_, obstacle(j, t).signedDistance(p));
      }
    }
  }
}

}  // namespace swarm_planner
