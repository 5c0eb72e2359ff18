// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/stopping.hpp"

#include <algorithm>
#include <limits>

#include "swarm_planner/swarm/flight_envelope.hpp"

namespace swarm_planner {
namespace {

bool keepsBounds(const StopManoeuvre& stop, const FlightBounds& bounds) {
  const auto stages = static_cast<std::size_t>(stop.stages);
  // The acceleration peaks near the middle: a stop that is too short mostly fails there at once.
  for (std::size_t i = 0; i < stages; ++i) {
    const std::size_t k = (i + stages / 2) % stages;
    if (findBreach(bounds, stop.knots[k], stop.jerks[k], stop.dt).bound != FlightBound::kNone) return false;
  }
  return true;
}

double largestRatio(const StopManoeuvre& stop, const FlightBounds& bounds) {
  double largest = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(stop.stages); ++k) {
    largest = std::max(largest, envelopeRatio(bounds, stop.knots[k], stop.jerks[k], stop.dt));
  }
  return largest;
}

}  // namespace

void rollOutStop(const KinematicState& x, int stages, double dt, StopManoeuvre& stop) {
  stop.dt = dt;
  stop.stages = stages;
  stop.within_bounds = false;
  const double m = stages;
  const Vector3 mean = -x.a / (m * dt);
  const Vector3 slope = -12.0 / (m * (m * m - 1.0) * dt * dt) * (x.v + 0.5 * m * dt * x.a);
  stop.knots[0] = x;
  for (int k = 0; k < stages; ++k) {
    const auto i = static_cast<std::size_t>(k);
    stop.jerks[i] = mean + (0.5 * (m - 1.0) - k) * slope;
    stop.knots[i + 1] = propagate(stop.knots[i], stop.jerks[i], dt);
  }
  // Zero but for rounding; exactly, so that whatever follows rests.
  stop.knots[static_cast<std::size_t>(stages)].v.setZero();
  stop.knots[static_cast<std::size_t>(stages)].a.setZero();
}

void planStop(const KinematicState& x, double dt, const FlightBounds& bounds, StopManoeuvre& stop) {
  for (int stages = 2; stages <= kMaxStopStages; ++stages) {
    rollOutStop(x, stages, dt, stop);
    stop.within_bounds = keepsBounds(stop, bounds);
    if (stop.within_bounds) return;
  }
  int gentlest = 2;
  double least = std::numeric_limits<double>::infinity();
  for (int stages = 2; stages <= kMaxStopStages; ++stages) {
    rollOutStop(x, stages, dt, stop);
    const double ratio = largestRatio(stop, bounds);
    if (ratio < least) {
      least = ratio;
      gentlest = stages;
    }
  }
  rollOutStop(x, gentlest, dt, stop);
}

}  // namespace swarm_planner
