// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/gaussian_noise.hpp"

#include <cmath>

namespace swarm_planner {

double GaussianNoise::next() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double x = 0.0, y = 0.0, square = 0.0;
  do {
    x = 2.0 * stream_.nextUniform() - 1.0;
    y = 2.0 * stream_.nextUniform() - 1.0;
    square = x * x + y * y;
  } while (square >= 1.0 || square == 0.0);
  const double scale = std::sqrt(-2.0 * std::log(square) / square);
  spare_ = y * scale;
  has_spare_ = true;
  return x * scale;
}

Vector3 GaussianNoise::vector(double sigma) {
  Vector3 noise;
  for (int axis = 0; axis < 3; ++axis) noise(axis) = sigma * next();
  return noise;
}

}  // namespace swarm_planner
