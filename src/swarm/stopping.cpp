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

/// Rolls out the jerks j_k = -a / (M dt) + w_k slope + q_k curvature, of which any that fulfil the conditions of
/// rollOutStop and have the least squares are of this kind.
void rollOutJerks(const KinematicState& x, int stages, double dt, const Vector3& curvature, StopManoeuvre& stop) {
  stop.dt = dt;
  stop.stages = stages;
  stop.within_bounds = false;
  const double m = stages;
  const Vector3 mean = -x.a / (m * dt);
  const Vector3 slope = -12.0 / (m * (m * m - 1.0) * dt * dt) * (x.v + 0.5 * m * dt * x.a);
  stop.knots[0] = x;
  for (int k = 0; k < stages; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double w = 0.5 * (m - 1.0) - k;
    stop.jerks[i] = mean + w * slope + (w * w - (m * m - 1.0) / 12.0) * curvature;
    stop.knots[i + 1] = propagate(stop.knots[i], stop.jerks[i], dt);
  }
  // Zero but for rounding; exactly, so that whatever follows rests.
  stop.knots[static_cast<std::size_t>(stages)].v.setZero();
  stop.knots[static_cast<std::size_t>(stages)].a.setZero();
}

}  // namespace

void rollOutStop(const KinematicState& x, int stages, double dt, StopManoeuvre& stop) {
  rollOutJerks(x, stages, dt, Vector3::Zero(), stop);
}

void rollOutStopAt(const KinematicState& x, const Vector3& place, int stages, double dt, StopManoeuvre& stop) {
  // Where the stop without the third term ends is linear in x. A jerk j_k moves the end by
  // dt^3 ((r^2 + r) / 2 + 1 / 6) j_k with r = M - 1 - k = w_k + (M - 1) / 2; of that, q_k sees w_k^2 / 2 alone.
  const double m = stages;
  const Vector3 end = x.p + 0.5 * m * dt * x.v + m * m * dt * dt / 12.0 * x.a;
  const double reach = dt * dt * dt * m * (m * m - 1.0) * (m * m - 4.0) / 360.0;
  rollOutJerks(x, stages, dt, (place - end) / reach, stop);
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

void planStopAt(const KinematicState& x, const Vector3& place, double dt, const FlightBounds& bounds,
                StopManoeuvre& stop) {
  for (int stages = 3; stages <= kMaxStopStages; ++stages) {
    rollOutStopAt(x, place, stages, dt, stop);
    stop.within_bounds = keepsBounds(stop, bounds);
    if (stop.within_bounds) return;
  }
}

}  // namespace swarm_planner
