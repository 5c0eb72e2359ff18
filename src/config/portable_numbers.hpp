// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace swarm_planner {

constexpr double kPi = 3.14159265358979323846;

/// Uniform random numbers that are the same on every platform. The standard fixes the engine's output but not that
/// of its distributions.
class UniformRandom {
 public:
  explicit UniformRandom(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high).
  double real(double low, double high) {
    constexpr double kTwoToMinus53 = 1.0 / 9007199254740992.0;
    return low + (high - low) * static_cast<double>(engine_() >> 11) * kTwoToMinus53;
  }

  /// In {low, ..., high}; the bias of the reduction is below (high - low) / 2^53.
  int whole(int low, int high) { return low + static_cast<int>(real(0.0, high - low + 1.0)); }

 private:
  std::mt19937_64 engine_;
};

/// To whole micrometres (or 1e-6 of any unit). Sines and cosines differ in the last bit from one mathematics library
/// to the next; coordinates of scenarios must not.
inline double roundedToMicro(double value) {
  constexpr double kPerUnit = 1e6;
  return std::round(value * kPerUnit) / kPerUnit + 0.0;  // + 0.0 turns -0.0 into 0.0
}

}  // namespace swarm_planner
