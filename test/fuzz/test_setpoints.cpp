// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a vehicle, simulated with the logic that drivers follow, that is thrown off by a trajectory that
// nobody can fly, or whose state is lost for good.
#include "fuzz_target.hpp"
#include "swarm_planner/simulation/quad_simulator.hpp"
#include "swarm_planner/simulation/setpoint_track.hpp"

namespace swarm_planner {
namespace {

SetpointTrajectory wildTrajectory(FuzzData& data, double now) {
  SetpointTrajectory trajectory;
  trajectory.epoch = data.wild(now - 1.0, now + 2.0);
  trajectory.points.resize(data.below(8));
  double time = 0.0;
  for (Setpoint& point : trajectory.points) {
    point.time_from_start = time;
    time += data.wild(0.0, 0.5);
    point.p = data.wildVector(-20.0, 20.0);
    point.v = data.wildVector(-5.0, 5.0);
    point.a = data.wildVector(-5.0, 5.0);
    point.yaw = data.wild(-3.0, 3.0);
  }
  return trajectory;
}

bool isFinite(const MotionSetpoint& x) {
  return x.p.allFinite() && x.v.allFinite() && x.a.allFinite() && x.jerk.allFinite();
}

}  // namespace

std::vector<std::string> fuzzSeeds() { return seedsOfBytes(300, 50, 77); }

}  // namespace swarm_planner

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace swarm_planner;
  FuzzData data(bytes, size);
  static const Parameters parameters;
  SetpointTrack track(Vector3::Zero());
  QuadSimulator quad(parameters, Vector3(0.0, 0.0, 2.0), 1);
  double now = 100.0;
  quad.advanceTo(now);
  while (!data.empty()) {
    const SetpointTrajectory trajectory = wildTrajectory(data, now);
    const bool taken = track.receive(trajectory, now);
    FUZZ_CHECK(!taken || isFlyable(trajectory));
    FUZZ_CHECK(quad.receive(trajectory) == taken);
    now += data.within(0.0, 0.1);
    for (const double ahead : {0.0, 0.013, 0.7, 5.0, 1e6}) FUZZ_CHECK(isFinite(track.at(now + ahead)));
    quad.advanceTo(now);
    FUZZ_CHECK(quad.state().p.allFinite() && quad.state().v.allFinite() && quad.measure().p.allFinite());
  }
  return 0;
}
