// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/simulation/random_stream.hpp"

namespace swarm_planner {

/// A stream of independent standard normal numbers (the polar method). The standard library's distributions differ
/// between implementations: with this one a seed gives the same run everywhere.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : stream_(seed) {}

  /// Mean 0, standard deviation 1.
  double next();
  /// Three independent numbers of standard deviation `sigma`.
  Vector3 vector(double sigma);

 private:
  RandomStream stream_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace swarm_planner
