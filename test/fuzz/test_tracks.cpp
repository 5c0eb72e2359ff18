// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a tracker gone wild that fills the memory with tracks, keeps a far one instead of a near one, or
// brings one into the planner that its arithmetic cannot bear.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fuzz_target.hpp"
#include "swarm_planner/config/plausible.hpp"
#include "swarm_planner/obstacles/track_memory.hpp"

namespace swarm_planner {
namespace {

constexpr std::size_t kCapacity = 5;
constexpr double kTimeout = 1.0;

std::vector<TrackedObstacle> wildTracks(FuzzData& data, double now) {
  std::vector<TrackedObstacle> tracks(data.below(12));
  for (TrackedObstacle& track : tracks) {
    const Vector3 center = data.wildVector(-50.0, 50.0);
    const Vector3 velocity = data.wildVector(-3.0, 3.0);
    try {
      track.shape = Superellipsoid(data.byte() % 16, center, data.wildVector(0.2, 4.0), data.wildVector(2.0, 9.0),
                                   data.wild(-3.0, 3.0), velocity);
    } catch (const std::invalid_argument&) {
      track.shape = Superellipsoid(data.byte() % 16, Vector3(1, 2, 3), Vector3::Ones(), Vector3::Constant(2.0), 0.0,
                                   Vector3::Zero())
                        .movedBy(data.wild(-1.0, 1.0));
    }
    track.stamp = data.wild(now - 1.5, now + 0.1);
    track.position_sigma = data.wild(0.0, 1.0);
    track.velocity_sigma = data.wild(0.0, 1.0);
  }
  return tracks;
}

double rankOf(const TrackedObstacle& track, const std::vector<Vector3>& places) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3& place : places) nearest = std::min(nearest, (track.shape.center() - place).norm());
  return nearest - track.shape.boundingRadius() - 6.0 * track.shape.velocity().norm();
}

/// What went is not nearer than what stayed, by the definition.
void checkNearest(const std::vector<TrackedObstacle>& all, const std::vector<TrackedObstacle>& kept,
                  const std::vector<Vector3>& places) {
  if (places.empty() || kept.size() == all.size()) return;
  double farthest_kept = -std::numeric_limits<double>::infinity();
  for (const TrackedObstacle& track : kept) farthest_kept = std::max(farthest_kept, rankOf(track, places));
  for (const TrackedObstacle& track : all) {
    const bool stays = std::any_of(kept.begin(), kept.end(), [&track](const TrackedObstacle& each) {
      return each.shape.id() == track.shape.id();
    });
    FUZZ_CHECK(stays || rankOf(track, places) >= farthest_kept - 1e-6 * (1.0 + std::abs(farthest_kept)));
  }
}

void checkUsable(const TrackMemory& memory, double now) {
  for (const TrackedObstacle& track : memory.tracks()) {
    FUZZ_CHECK(isWithin(track.shape.center(), kMostCoordinate) && isWithin(track.shape.velocity(), kMostSpeed));
    FUZZ_CHECK(now - track.stamp <= kTimeout && track.stamp <= now + kClockTolerance);
    FUZZ_CHECK(track.shape.halfExtents().allFinite());
    Vector3 normal;
    FUZZ_CHECK(std::isfinite(track.shape.signedDistance(Vector3(10.0, -4.0, 2.0), normal)) && normal.allFinite());
    const Gauge gauge = track.shape.gauge(Vector3(3.0, 2.0, -1.0));
    FUZZ_CHECK(std::isfinite(gauge.value) && gauge.gradient.allFinite());
  }
}

}  // namespace

std::vector<std::string> fuzzSeeds() { return seedsOfBytes(400, 40, 1); }

}  // namespace swarm_planner

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace swarm_planner;
  FuzzData data(bytes, size);
  TrackMemory memory(kTimeout, kCapacity);
  double now = 100.0;
  while (!data.empty()) {
    now += data.within(0.0, 0.4);
    memory.update(wildTracks(data, now), now);
    std::vector<Vector3> places(data.below(4));
    for (Vector3& place : places) place = Vector3(data.within(-50, 50), data.within(-50, 50), data.within(0, 20));
    const std::vector<TrackedObstacle> all = memory.tracks();
    const std::size_t gone = memory.keepNearest(places);
    FUZZ_CHECK(memory.tracks().size() <= kCapacity && memory.tracks().size() + gone == all.size());
    checkNearest(all, memory.tracks(), places);
    checkUsable(memory, now);
    if (data.byte() == 0) memory.reset();
  }
  return 0;
}
