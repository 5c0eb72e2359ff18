// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a planner that, fed with anything by whoever reads its inputs, crashes, throws, or publishes a
// setpoint that is not finite.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fuzz_target.hpp"
#include "swarm_planner/config/plausible.hpp"
#include "swarm_planner/model/setpoints.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {
namespace {

constexpr std::size_t kUavs = 3;
constexpr int kMostCycles = 24;
constexpr double kPeriod = 0.3;

Mission threeUavs() {
  Scenario scenario;
  scenario.name = "fuzz";
  scenario.end.duration = 60.0;
  for (std::size_t i = 0; i < kUavs; ++i) {
    ScenarioUav uav;
    uav.name = "uav" + std::to_string(i + 1);
    uav.start = Vector3(0.0, 4.0 * static_cast<double>(i), 10.0);
    uav.reference = {uav.start, uav.start + Vector3(30.0, 0.0, 0.0), Vector3(30.0, 8.0, 12.0)};
    uav.target.speed = 2.0;
    scenario.uavs.push_back(uav);
  }
  return makeMission(scenario, {{"max_tracks", 8}}, "fuzz");
}

TrackedObstacle wildTrack(FuzzData& data, double now) {
  TrackedObstacle track;
  const Vector3 center = data.wildVector(-10.0, 40.0);
  const Vector3 velocity = data.wildVector(-4.0, 4.0);
  try {
    track.shape = Superellipsoid(static_cast<int>(data.below(3000)), center, data.wildVector(0.2, 6.0),
                                 data.wildVector(2.0, 10.0), data.wild(-3.0, 3.0), velocity);
  } catch (const std::invalid_argument&) {
    // No body; the one that stands for it is moved to nowhere.
    track.shape = Superellipsoid(1, center.allFinite() ? center : Vector3(5, 5, 5), Vector3::Ones(),
                                 Vector3::Constant(2.0), 0.0, Vector3(1.0, 0.0, 0.0))
                      .movedBy(data.wild(0.0, 3.0));
  }
  track.stamp = data.wild(now - 0.5, now);
  track.position_sigma = data.wild(0.0, 0.3);
  track.velocity_sigma = data.wild(0.0, 0.3);
  return track;
}

class Flight {
 public:
  explicit Flight(FuzzData& data) : data_(data), planner_(mission()) {
    snapshot_.uavs.resize(kUavs);
    for (std::size_t i = 0; i < kUavs; ++i) snapshot_.uavs[i].p = mission().scenario.uavs[i].start;
  }

  void cycle() {
    const double step = data_.byte() < 250 ? kPeriod : data_.wild(0.0, 2.0);
    now_ = std::isfinite(step) && std::abs(step) < 1e6 ? now_ + step : now_;
    measure();
    seeObstacles();
    if (data_.byte() < 24) changeReference();
    const double budget = data_.byte() < 240 ? std::numeric_limits<double>::infinity() : 0.0;
    const CycleReport& report = planner_.plan(snapshot_, now_ + kPeriod, budget);
    FUZZ_CHECK(report.uavs.size() == kUavs);
    for (std::size_t i = 0; i < kUavs; ++i) check(i, report.uavs[i]);
    if (data_.byte() == 255) planner_.reset();
  }

 private:
  static const Mission& mission() {
    static const Mission mission = threeUavs();
    return mission;
  }

  void measure() {
    snapshot_.now = now_;
    for (std::size_t i = 0; i < kUavs; ++i) {
      UavMeasurement& uav = snapshot_.uavs[i];
      const std::uint8_t kind = data_.byte();
      uav.received = kind < 252;
      uav.stamp = kind < 240 ? now_ - 0.02 : data_.wild(now_ - 1.0, now_ + 1.0);
      const UavReport& report = planner_.report().uavs[i];
      if (kind < 200 && report.planned) {
        const KinematicState flown = planner_.committed(i).at(uav.stamp);
        uav.p = flown.p;
        uav.v = flown.v;
      } else if (kind >= 220) {
        uav.p = data_.wildVector(-10.0, 40.0);
        uav.v = data_.wildVector(-5.0, 5.0);
      }
    }
  }

  void seeObstacles() {
    const std::uint8_t kind = data_.byte();
    if (kind < 128) return;
    // Thousands at times: copies of a few, each with an id of its own.
    snapshot_.obstacles.clear();
    for (std::size_t count = data_.below(10); count > 0; --count) snapshot_.obstacles.push_back(wildTrack(data_, now_));
    if (kind < 254 || snapshot_.obstacles.empty()) return;
    const TrackedObstacle one = snapshot_.obstacles.front();
    for (int id = 0; id < 2000; ++id) {
      TrackedObstacle copy = one;
      copy.shape = Superellipsoid(10000 + id, Vector3(0.01 * id, data_.within(-20, 20), 8.0), Vector3::Ones(),
                                  Vector3::Constant(2.0), 0.0, Vector3::Zero());
      snapshot_.obstacles.push_back(copy);
    }
  }

  void changeReference() {
    const std::size_t uav = data_.below(kUavs + 1);
    std::vector<Vector3> path(data_.below(5));
    for (Vector3& point : path) point = data_.wildVector(-10.0, 40.0);
    const double start = data_.wild(0.0, 20.0);
    const double speed = data_.wild(0.0, 5.0);
    try {
      planner_.setReference(uav, path, start, speed);
    } catch (const std::invalid_argument& refused) {
      FUZZ_CHECK(std::strlen(refused.what()) < 200);
    }
  }

  void check(std::size_t i, const UavReport& report) {
    FUZZ_CHECK(!std::isnan(report.obstacle_clearance) && !std::isnan(report.pair_distance));
    FUZZ_CHECK(std::isfinite(report.deviation) && std::isfinite(report.lag));
    if (!report.planned) return;
    const CommittedMotion& motion = planner_.committed(i);
    sampleMotion(motion, motion.epoch(), 0.05, std::numeric_limits<double>::infinity(), 0.0, setpoints_);
    FUZZ_CHECK(std::isfinite(setpoints_.epoch) && !setpoints_.points.empty());
    for (const Setpoint& point : setpoints_.points) {
      FUZZ_CHECK(point.p.allFinite() && point.v.allFinite() && point.a.allFinite() && std::isfinite(point.yaw));
      FUZZ_CHECK(isWithin(point.p, 2.0 * kMostCoordinate));
    }
  }

  FuzzData& data_;
  SwarmPlanner planner_;
  Snapshot snapshot_;
  SetpointTrajectory setpoints_;
  double now_ = 100.0;
};

}  // namespace

std::vector<std::string> fuzzSeeds() {
  std::vector<std::string> seeds = seedsOfBytes(500, 100, 991);
  seeds.insert(seeds.begin(), std::string(400, '\0'));  // a flight without faults
  return seeds;
}

}  // namespace swarm_planner

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace swarm_planner;
  FuzzData data(bytes, size);
  Flight flight(data);
  for (int cycle = 0; cycle < kMostCycles && !data.empty(); ++cycle) flight.cycle();
  return 0;
}
