// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// A stream of independent standard normal numbers (xoshiro256++ and the polar method). The standard library's
/// distributions differ between implementations: with this one a seed gives the same run everywhere.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed);

  /// Mean 0, standard deviation 1.
  double next();
  /// Three independent numbers of standard deviation `sigma`.
  Vector3 vector(double sigma);

 private:
  std::uint64_t nextBits();
  double nextUniform();  ///< in [-1, 1)

  std::uint64_t state_[4];
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace swarm_planner
