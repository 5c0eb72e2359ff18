// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace swarm_planner {

constexpr double kPi = 3.14159265358979323846;

/// To whole micrometres (or 1e-6 of any unit). The last bit of a sine, or of a product and sum that one processor
/// fuses and another does not, differs from platform to platform; coordinates of scenarios must not.
inline double roundedToMicro(double value) {
  constexpr double kPerUnit = 1e6;
  return std::round(value * kPerUnit) / kPerUnit + 0.0;  // + 0.0 turns -0.0 into 0.0
}

/// Uniform random numbers that are the same on every platform. The standard fixes the engine's output but not that
/// of its distributions.
class UniformRandom {
 public:
  explicit UniformRandom(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high], to 1e-6.
  double real(double low, double high) {
    constexpr double kTwoToMinus53 = 1.0 / 9007199254740992.0;
    return roundedToMicro(low + (high - low) * static_cast<double>(engine_() >> 11) * kTwoToMinus53);
  }

  /// In {low, ..., high}; 2^64 values of the engine make the bias of the remainder negligible.
  int whole(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace swarm_planner
