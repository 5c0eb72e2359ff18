// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/clearance_proof.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swarm_planner {
namespace {

/// Halvings of one curve, and curves looked at for one body: a bound on the time that a proof takes.
constexpr int kMaxDepth = 16;
constexpr int kMaxNodes = 2000;

/// Error of signedDistance and of the arithmetic here, relative to the lengths in play.
constexpr double kRelativeError = 2e-9;

double supportOfEqualExponents(const Vector3& m, double p) {
  if (p == 2.0) return m.norm();
  const double largest = m.maxCoeff();
  if (!(largest > 0.0)) return 0.0;
  const double q = p / (p - 1.0);
  const Vector3 ratio = m / largest;
  return largest * std::pow(std::pow(ratio.x(), q) + std::pow(ratio.y(), q) + std::pow(ratio.z(), q), 1.0 / q);
}

/// Separation of two boxes along each axis [m], 0 where they overlap.
Vector3 gaps(const Box& a, const Box& b) { return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0); }

Vector3 toBody(const Superellipsoid& body, const Vector3& u) {
  const double c = std::cos(body.yaw());
  const double s = std::sin(body.yaw());
  return Vector3(c * u.x() + s * u.y(), c * u.y() - s * u.x(), u.z());
}

Vector3 toWorld(const Superellipsoid& body, const Vector3& u) {
  const double c = std::cos(body.yaw());
  const double s = std::sin(body.yaw());
  return Vector3(c * u.x() - s * u.y(), s * u.x() + c * u.y(), u.z());
}

/// The parameter at which the chord of a curve is nearest to the origin: where a nearly straight flight passes.
double nearestParameter(const BernsteinPoints<4>& points) {
  const Vector3 chord = points[3] - points[0];
  const double squared_length = chord.squaredNorm();
  if (!(squared_length > 0.0)) return 0.5;
  return std::min(std::max(-points[0].dot(chord) / squared_length, 0.0), 1.0);
}

Vector3 curvePoint(const BernsteinPoints<4>& p, double s) {
  const double r = 1.0 - s;
  return r * r * r * p[0] + 3.0 * r * s * (r * p[1] + s * p[2]) + s * s * s * p[3];
}

/// A direction in which the body, taken for something between an ellipsoid and a box, is left behind; zero inside.
Vector3 directionFrom(const Superellipsoid& body, const Vector3& point) {
  const Vector3 in_body = toBody(body, point);
  // About the corner of the largest box inside, 3^(-1/p) of the radii.
  const Vector3 inner = body.radii() - 0.85 * body.radii().cwiseQuotient(body.exponents());
  const Vector3 away = in_body - in_body.cwiseMax(-inner).cwiseMin(inner);
  return toWorld(body, away.normalized());
}

/// A normal for a plane between the body and a curve: from where the curve's chord passes. For a long one turned so
/// that the curve does not come closer to the plane before or after.
Vector3 guessNormal(const Superellipsoid& body, const BernsteinPoints<4>& points, bool is_long) {
  const double s = nearestParameter(points);
  const Vector3 normal = directionFrom(body, curvePoint(points, s));
  const Vector3 chord = points[3] - points[0];
  if (!is_long || !(chord.squaredNorm() > 0.0)) return normal;
  double along = normal.dot(chord) / chord.squaredNorm();
  if (s == 0.0) along = std::min(along, 0.0);
  if (s == 1.0) along = std::max(along, 0.0);
  return (normal - along * chord).normalized();
}

}  // namespace

double supportBound(const Superellipsoid& body, const Vector3& n) {
  constexpr int kMaxSteps = 20;
  constexpr double kTolerance = 1e-7;  // of the logarithm of the sum; the bound is off by its square
  constexpr double kRounding = 1e-12;
  const Vector3 m = toBody(body, n).cwiseAbs().cwiseProduct(body.radii());
  const Vector3& p = body.exponents();
  if (p.minCoeff() == p.maxCoeff()) return (1.0 + kRounding) * supportOfEqualExponents(m, p[0]);

  // ln s_i = q_i (ln(m_i / p_i) - x), x = ln l; the logarithm of the sum falls in x, convex and nearly linear.
  std::array<double, 3> logs{};
  double x = std::log(1e-300);
  for (int i = 0; i < 3; ++i) {
    logs[static_cast<std::size_t>(i)] = std::log(m[i] / p[i]);
    x = std::max(x, logs[static_cast<std::size_t>(i)]);
  }
  double bound = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    double sum = 0.0;
    double slope = 0.0;
    double weighted = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double q = p[i] / (p[i] - 1.0);
      const double term = std::exp(q * (logs[static_cast<std::size_t>(i)] - x));
      sum += term;
      slope += q * term;
      weighted += (p[i] - 1.0) * term;
    }
    bound = std::exp(x) * (1.0 + weighted);
    const double excess = std::log(sum);
    if (std::abs(excess) < kTolerance) break;
    x += excess * sum / slope;
  }
  return (1.0 + kRounding) * bound;
}

double distanceBound(const Superellipsoid& body, const Vector3& relative) {
  const Vector3 normal = directionFrom(body, relative);
  return normal.squaredNorm() > 0.5 ? normal.dot(relative) - supportBound(body, normal)
                                    : -std::numeric_limits<double>::infinity();
}

bool ObstacleProof::Plane::proves(const BernsteinPoints<4>& relative, const Span& span) const {
  const double step = (span.distance_to - span.distance_from) / 3.0;
  for (std::size_t i = 0; i < relative.size(); ++i) {
    const double demanded = span.distance_from + static_cast<double>(i) * step;
    if (!(normal.dot(relative[i]) - offset >= demanded)) return false;
  }
  return true;
}

bool ObstacleProof::provesWith(const Vector3& normal, const BernsteinPoints<4>& relative, const Span& span) {
  if (!(normal.squaredNorm() > 0.5)) return false;
  const Plane plane{normal, supportBound(body_, normal)};
  if (!plane.proves(relative, span)) return false;
  plane_ = plane;
  return true;
}

ClearanceFinding ObstacleProof::prove(const BernsteinPoints<4>& relative, double from, double to, double distance_from,
                                      double distance_to) {
  return prove(relative, Span{from, to, distance_from, distance_to}, 0);
}

ClearanceFinding ObstacleProof::prove(const BernsteinPoints<4>& relative, const Span& span, int depth) {
  if (plane_.proves(relative, span)) return {};
  const double demanded = std::max(span.distance_from, span.distance_to);
  Box box;
  for (const Vector3& r : relative) box.include(r);
  if (gaps(box, {-body_.halfExtents(), body_.halfExtents()}).squaredNorm() > demanded * demanded) return {};

  const Vector3 middle = curveMiddle(relative);
  double squared_radius = 0.0;
  for (const Vector3& r : relative) squared_radius = std::max(squared_radius, (r - middle).squaredNorm());
  const bool is_long = squared_radius > middle.squaredNorm();
  if (provesWith(guessNormal(body_, relative, is_long), relative, span)) return {};

  const double middle_time = 0.5 * (span.from + span.to);
  const double middle_demand = 0.5 * (span.distance_from + span.distance_to);
  // The distance is the costliest: not for a curve that is too long for it and not too close there.
  if (!is_long || body_.distanceLowerBound(body_.center() + middle) <= demanded) {
    Vector3 normal;
    const double distance = body_.signedDistance(body_.center() + middle, normal);
    const double error = kRelativeError * (middle.norm() + body_.boundingRadius());
    if (!(distance + error >= middle_demand)) return {false, false, middle_time};
    if (distance - error - std::sqrt(squared_radius) >= demanded) return {};
    if (provesWith(normal, relative, span)) return {};
  }
  if (depth == kMaxDepth || ++nodes_ > kMaxNodes) return {false, true, middle_time};

  BernsteinPoints<4> left;
  BernsteinPoints<4> right;
  halve(relative, left, right);
  const ClearanceFinding first = prove(left, {span.from, middle_time, span.distance_from, middle_demand}, depth + 1);
  if (!first.clear) return first;
  return prove(right, {middle_time, span.to, middle_demand, span.distance_to}, depth + 1);
}

PairProof::PairProof(double horizontal, double vertical) : scale_(1.0 / horizontal, 1.0 / horizontal, 1.0 / vertical) {}

bool PairProof::areApart(const Box& a, const Box& b) const {
  constexpr double kEnough = 1.0 + 1e-6;  // for what CommittedMotion::boxOver leaves out
  return gaps(a, b).cwiseProduct(scale_).squaredNorm() > kEnough;
}

ClearanceFinding PairProof::prove(const BernsteinPoints<4>& relative, double from, double to) {
  BernsteinPoints<4> scaled;
  for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] = relative[i].cwiseProduct(scale_);
  return proveScaled(scaled, from, to, 0);
}

ClearanceFinding PairProof::proveScaled(const BernsteinPoints<4>& scaled, double from, double to, int depth) {
  if (leastSquaredNorm(scaled) >= 1.0) return {};
  if (!(scaled[0].squaredNorm() >= 1.0)) return {false, false, from};
  const double middle = 0.5 * (from + to);
  if (!(curveMiddle(scaled).squaredNorm() >= 1.0)) return {false, false, middle};
  if (!(scaled[3].squaredNorm() >= 1.0)) return {false, false, to};
  if (depth == kMaxDepth || ++nodes_ > kMaxNodes) return {false, true, middle};
  BernsteinPoints<4> left;
  BernsteinPoints<4> right;
  halve(scaled, left, right);
  const ClearanceFinding first = proveScaled(left, from, middle, depth + 1);
  return first.clear ? proveScaled(right, middle, to, depth + 1) : first;
}

}  // namespace swarm_planner
