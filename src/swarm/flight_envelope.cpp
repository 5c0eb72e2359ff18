// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/flight_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "swarm_planner/swarm/bernstein.hpp"

namespace swarm_planner {
namespace {

constexpr int kMaxDepth = 16;  // halvings of a segment that is close to a bound

using Quadratic = BernsteinPoints<3>;

Quadratic velocityPoints(const KinematicState& begin, const Vector3& jerk, double dt) {
  return {begin.v, begin.v + 0.5 * dt * begin.a, begin.v + dt * (begin.a + 0.5 * dt * jerk)};
}

/// A + g e3 with A = a + k_d / M v of (3): its norm is the thrust over mass of (5).
Quadratic thrustPoints(const FlightBounds& bounds, const KinematicState& begin, const Vector3& jerk, double dt,
                       const Quadratic& velocity) {
  const Vector3 end = begin.a + dt * jerk;
  const Vector3& drag = bounds.drag_over_mass;
  return {begin.a + drag.cwiseProduct(velocity[0]) + bounds.gravity,
          0.5 * (begin.a + end) + drag.cwiseProduct(velocity[1]) + bounds.gravity,
          end + drag.cwiseProduct(velocity[2]) + bounds.gravity};
}

/// Whether |w| <= limit all along; otherwise `time`, in [from, to], is where it fails.
bool staysWithin(const Quadratic& w, double squared_limit, double from, double to, int depth, double& time) {
  if (greatestSquaredNorm(w) <= squared_limit) return true;
  time = from;
  if (!(w[0].squaredNorm() <= squared_limit)) return false;
  const double middle = 0.5 * (from + to);
  time = middle;
  if (depth == kMaxDepth || !(curveMiddle(w).squaredNorm() <= squared_limit)) return false;
  Quadratic left;
  Quadratic right;
  halve(w, left, right);
  return staysWithin(left, squared_limit, from, middle, depth + 1, time) &&
         staysWithin(right, squared_limit, middle, to, depth + 1, time);
}

bool staysWithin(const Quadratic& w, double limit, double dt, double& time) {
  if (limit == std::numeric_limits<double>::infinity()) return true;
  const double tolerant = limit * (1.0 + kBoundTolerance);
  return staysWithin(w, tolerant * tolerant, 0.0, dt, 0, time);
}

/// Least value of a quadratic with Bernstein coefficients w0, w1, w2, and where in [0, 1].
double leastValue(double w0, double w1, double w2, double& where) {
  where = w2 < w0 ? 1.0 : 0.0;
  const double least = std::min(w0, w2);
  const double curvature = w0 - 2.0 * w1 + w2;
  if (w1 >= least || !(curvature > 0.0)) return least;
  where = std::min(std::max((w0 - w1) / curvature, 0.0), 1.0);
  return w0 - (w0 - w1) * (w0 - w1) / curvature;
}

}  // namespace

EnvelopeBreach findBreach(const FlightBounds& bounds, const KinematicState& begin, const Vector3& jerk, double dt) {
  double time = 0.0;
  if (!(jerk.norm() <= bounds.max_jerk * (1.0 + kBoundTolerance))) return {FlightBound::kJerk, 0.0};
  const Quadratic velocity = velocityPoints(begin, jerk, dt);
  if (!staysWithin(velocity, bounds.max_speed, dt, time)) return {FlightBound::kSpeed, time};

  const Vector3 end = begin.a + dt * jerk;  // |a| is convex along a segment: its ends are the largest
  const double most = bounds.max_acceleration * (1.0 + kBoundTolerance);
  if (!(begin.a.norm() <= most)) return {FlightBound::kAcceleration, 0.0};
  if (!(end.norm() <= most)) return {FlightBound::kAcceleration, dt};

  const Quadratic thrust = thrustPoints(bounds, begin, jerk, dt, velocity);
  if (!staysWithin(thrust, bounds.max_thrust_acceleration, dt, time)) return {FlightBound::kThrust, time};
  double where = 0.0;
  const double least_vertical = bounds.min_vertical_thrust + bounds.gravity.z();
  const double tolerance = kBoundTolerance * bounds.gravity.z();
  if (!(leastValue(thrust[0].z(), thrust[1].z(), thrust[2].z(), where) >= least_vertical - tolerance)) {
    return {FlightBound::kThrust, where * dt};
  }
  return {};
}

double envelopeRatio(const FlightBounds& bounds, const KinematicState& begin, const Vector3& jerk, double dt) {
  const Quadratic velocity = velocityPoints(begin, jerk, dt);
  const Quadratic thrust = thrustPoints(bounds, begin, jerk, dt, velocity);
  const double acceleration = std::max(begin.a.norm(), (begin.a + dt * jerk).norm());
  double where = 0.0;
  const double vertical = leastValue(thrust[0].z(), thrust[1].z(), thrust[2].z(), where);
  const double missing = bounds.min_vertical_thrust + bounds.gravity.z() - vertical;
  return std::max({jerk.norm() / bounds.max_jerk, std::sqrt(greatestSquaredNorm(velocity)) / bounds.max_speed,
                   acceleration / bounds.max_acceleration,
                   std::sqrt(greatestSquaredNorm(thrust)) / bounds.max_thrust_acceleration,
                   1.0 + missing / bounds.gravity.z()});
}

FlightBounds relieveBounds(const FlightBounds& bounds, const KinematicState& start, double slack) {
  const auto relieve = [slack](double& limit, double value) {
    limit = std::min(std::max(limit, value), limit * (1.0 + slack));
  };
  FlightBounds relieved = bounds;
  const Vector3 thrust = start.a + bounds.drag_over_mass.cwiseProduct(start.v) + bounds.gravity;
  relieve(relieved.max_speed, start.v.norm());
  relieve(relieved.max_acceleration, start.a.norm());
  relieve(relieved.max_thrust_acceleration, thrust.norm());
  const double least = bounds.min_vertical_thrust + bounds.gravity.z();
  relieved.min_vertical_thrust = std::max(std::min(least, thrust.z()), least * (1.0 - slack)) - bounds.gravity.z();
  return relieved;
}

}  // namespace swarm_planner
