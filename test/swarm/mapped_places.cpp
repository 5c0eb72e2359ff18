// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "mapped_places.hpp"

namespace swarm_planner {
namespace {

constexpr double kResolution = 0.1;  // [m]
constexpr int kSamples = 20;         // of a cycle

}  // namespace

std::shared_ptr<const VoxelMap> hallWithDoor(double door_width) {
  PlaceBuilder place(kResolution);
  const Vector3 low(-6.0, -3.0, 0.0);
  const Vector3 high(6.0, 3.0, PlaceBuilder::kHeight);
  place.addFloorAndCeiling(low, high);
  place.addBox({-6.1, -3.0, 0.0}, {-6.0, 3.0, high.z()});
  place.addBox({6.0, -3.0, 0.0}, {6.1, 3.0, high.z()});
  place.addBox({-6.0, -3.1, 0.0}, {6.0, -3.0, high.z()});
  place.addBox({-6.0, 3.0, 0.0}, {6.0, 3.1, high.z()});
  place.addWall(0.0, -3.0, 3.0, 1.0, door_width);
  return place.build();
}

Mission makeIndoorMission(const std::vector<Vector3>& starts, const std::vector<Vector3>& ends) {
  Mission mission = makeTestMission(starts, ends, 1.2);
  Faults faults;
  mission.scenario.overrides = {{"max_speed", 1.5}, {"uav_radius", 0.2}, {"pair_distance", 0.5}};
  mission.parameters = resolveParameters({}, mission.scenario.overrides, "test", faults);
  faults.throwIfAny();
  return mission;
}

const CycleReport& MappedFlight::cycle() {
  const double from = flight_.now();
  const CycleReport& report = flight_.cycle([this](Snapshot& snapshot) { snapshot.map = map_; });
  // The motions that were flown until now are replaced by the new ones at now() alone.
  for (std::size_t i = 0; i < mission_.scenario.uavs.size(); ++i) {
    for (int s = 0; s < kSamples; ++s) {
      const double t = flight_.now() + (flight_.now() - from) * s / kSamples;
      least_distance_ = std::min(least_distance_, map_->distance(flight_.vehicle(i, t).p, least_distance_));
    }
  }
  return report;
}

std::size_t MappedFlight::fly(int most_cycles) {
  std::size_t arrived = 0;
  for (int i = 0; i < most_cycles && arrived < mission_.scenario.uavs.size(); ++i) {
    cycle();
    arrived = 0;
    for (std::size_t uav = 0; uav < mission_.scenario.uavs.size(); ++uav) {
      const Vector3& end = mission_.scenario.uavs[uav].reference.back();
      if ((flight_.vehicle(uav).p - end).norm() < 0.3) ++arrived;
    }
  }
  return arrived;
}

}  // namespace swarm_planner
