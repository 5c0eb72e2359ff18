// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/simulation/gaussian_noise.hpp"

namespace swarm_planner {

/// Gusts as one UAV feels them: on each axis wind of mean 0, a first-order Gauss-Markov process as the longitudinal one
/// of the Dryden model, with standard deviation sigma and the correlation sigma^2 exp(-|s| / T) of two instants s
/// apart. Dryden's length scale over the airspeed is T. The wind is a function of time alone: it does not depend on the
/// instants at which it is asked for.
class Gusts {
 public:
  /// Spacing of the instants between which the wind changes linearly [s].
  static constexpr double kKnotSpacing = 0.02;

  /// `sigma` >= 0 [m/s], 0: calm; `correlation_time` T > 0 [s]. Begins at time 0.
  Gusts(double sigma, double correlation_time, std::uint64_t seed);

  /// The clock has been set to `t` [s]: the wind goes on with the last knot.
  void resetClock(double t);

  /// Wind velocity at `t` [m/s]. `t` must not decrease between two calls; before the first knot it is the knot's.
  Vector3 at(double t);

 private:
  Vector3 drawSuccessor(const Vector3& wind);

  double sigma_;
  double decay_;  ///< exp(-kKnotSpacing / T)
  GaussianNoise noise_;
  double origin_ = 0.0;   ///< [s]
  long long passed_ = 0;  ///< number of the last knot, from the origin
  Vector3 last_, next_;   ///< wind at that knot and at the one after it
};

}  // namespace swarm_planner
