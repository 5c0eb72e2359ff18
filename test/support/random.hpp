// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// A seeded source of test inputs, the same on every run and standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * kScale;
  }
  /// Equally likely orders of magnitude.
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  Vector3 vector(double low, double high) {
    const double x = uniform(low, high);
    const double y = uniform(low, high);
    return Vector3(x, y, uniform(low, high));
  }
  /// A direction, uniform on the sphere.
  Vector3 direction() {
    for (;;) {
      const Vector3 v = vector(-1.0, 1.0);
      if (v.squaredNorm() <= 1.0 && v.squaredNorm() > 1e-4) return v.normalized();
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace swarm_planner
