// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/random_stream.hpp"

namespace swarm_planner {
namespace {

constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15u;

/// Output function of SplitMix64: a bijection in which every bit depends on every other.
std::uint64_t scramble(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::uint64_t rotateLeft(std::uint64_t x, int bits) { return (x << bits) | (x >> (64 - bits)); }

}  // namespace

std::uint64_t streamSeed(std::uint64_t seed, RandomUse use, std::size_t index) {
  const std::uint64_t of_use =
      scramble(scramble(seed + kSplitMixStep) + kSplitMixStep + static_cast<std::uint64_t>(use));
  return scramble(of_use + kSplitMixStep + static_cast<std::uint64_t>(index));
}

RandomStream::RandomStream(std::uint64_t seed) {
  // SplitMix64 spreads neighbouring seeds, as its authors advise for this generator; the state is never all zero.
  for (std::uint64_t& word : state_) {
    seed += kSplitMixStep;
    word = scramble(seed);
  }
}

std::uint64_t RandomStream::nextBits() {
  const std::uint64_t result = rotateLeft(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = rotateLeft(state_[3], 45);
  return result;
}

double RandomStream::nextUniform() {
  constexpr double kTwoToMinus53 = 1.0 / 9007199254740992.0;
  return static_cast<double>(nextBits() >> 11) * kTwoToMinus53;
}

}  // namespace swarm_planner
