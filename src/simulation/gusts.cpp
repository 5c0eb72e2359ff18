// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/gusts.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {

Gusts::Gusts(double sigma, double correlation_time, std::uint64_t seed)
    : sigma_(sigma),
      decay_(std::exp(-kKnotSpacing / correlation_time)),
      noise_(seed),
      last_(noise_.vector(sigma)),
      next_(drawSuccessor(last_)) {}

Vector3 Gusts::drawSuccessor(const Vector3& wind) {
  // The variance stays sigma^2: decay^2 of it is the old wind's.
  return decay_ * wind + noise_.vector(sigma_ * std::sqrt(1.0 - decay_ * decay_));
}

void Gusts::resetClock(double t) {
  origin_ = t;
  passed_ = 0;
}

Vector3 Gusts::at(double t) {
  if (sigma_ == 0.0) return Vector3::Zero();
  const double knots = (t - origin_) / kKnotSpacing;
  for (; static_cast<double>(passed_ + 1) < knots; ++passed_) {
    last_ = next_;
    next_ = drawSuccessor(last_);
  }
  return last_ + std::max(0.0, knots - static_cast<double>(passed_)) * (next_ - last_);
}

}  // namespace swarm_planner
