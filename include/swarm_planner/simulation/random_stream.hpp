// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>

namespace swarm_planner {

/// What a stream of random numbers is for. Each use, of each UAV, has a stream of its own: switching one disturbance on
/// or off leaves the numbers of all others as they are.
enum class RandomUse : std::uint64_t {
  kPositionNoise,
  kVelocityNoise,
  kPositionBias,
  kGusts,
  kOdometryLink,
  kTrackLink,
  kSetpointLink,
  kDrop,
  kJitter,
  kFaultDirection,
  kTrackFlicker,
  kMissions,
  kFlightRecord,
};

/// Seed of the stream for `use` by UAV `index`, in a run whose seed is `seed`.
std::uint64_t streamSeed(std::uint64_t seed, RandomUse use, std::size_t index = 0);

/// A stream of independent random bits (xoshiro256++), the same on every platform. Neighbouring seeds give independent
/// streams.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed);

  std::uint64_t nextBits();
  double nextUniform();  ///< in [0, 1)

 private:
  std::uint64_t state_[4];
};

}  // namespace swarm_planner
