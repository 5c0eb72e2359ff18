// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/moving_body.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

// A plane that loses less of the distance is not replaced by the one at the nearest point.
constexpr double kAsGood = 1.2;
// Smaller ones make round bodies.
constexpr double kLeastEdgeExponent = 3.0;

/// Whether the body has edges, and not only rims as a cylinder has: at least two exponents are large.
bool hasEdges(const Superellipsoid& body) {
  const Vector3& p = body.exponents();
  return p.sum() - p.minCoeff() - p.maxCoeff() > kLeastEdgeExponent;
}

/// Of the distance to keep; a segment that comes closer to the reference point than that leads through the body.
constexpr double kThrough = 0.1;

/// The point nearest to the origin on the way from one point to another.
Vector3 nearestBetween(const Vector3& from, const Vector3& to) {
  const Vector3 way = to - from;
  const double squared_length = way.squaredNorm();
  if (!(squared_length > 0.0)) return from;
  return from + std::clamp(-from.dot(way) / squared_length, 0.0, 1.0) * way;
}

}  // namespace

double logarithmScale(const Superellipsoid& obstacle) {
  return obstacle.radii().minCoeff() / obstacle.exponents().maxCoeff();
}

MovingBody MovingBody::fromObstacle(const Superellipsoid& obstacle, double dt, double level, double distance,
                                    const DistanceGrowth& growth) {
  MovingBody body;
  body.obstacle_ = &obstacle;
  body.step_ = dt * obstacle.velocity();
  body.level_ = level;
  body.distance_ = distance;
  body.growth_ = growth;
  // S(u) = level lies within the surface S = 1 stretched by the largest factor that an exponent of at least 2 gives.
  const double stretch = std::sqrt(level);
  const double most = distance + body.growth(kHorizon - 1);
  body.radius_ = stretch * obstacle.boundingRadius() + most;
  body.extent_ = stretch * obstacle.halfExtents() + Vector3::Constant(most);
  const Vector3 end = obstacle.center() + kHorizon * body.step_;
  body.box_.min = obstacle.center().cwiseMin(end) - body.extent_;
  body.box_.max = obstacle.center().cwiseMax(end) + body.extent_;
  return body;
}

MovingBody MovingBody::fromUav(const PredictedMotion& motion, double horizontal, double vertical, const Vector3& apart,
                               const DistanceGrowth& growth) {
  MovingBody body;
  body.motion_ = &motion;
  body.distance_ = std::min(horizontal, vertical);
  body.scale_ = body.distance_ * Vector3(1.0 / horizontal, 1.0 / horizontal, 1.0 / vertical);
  body.apart_ = apart;
  body.growth_ = growth;
  const double most = 1.0 + body.growth(kHorizon - 1) / body.distance_;
  body.radius_ = most * std::max(horizontal, vertical);
  body.extent_ = most * Vector3(horizontal, horizontal, vertical);
  body.box_.min = motion.box.min - body.extent_;
  body.box_.max = motion.box.max + body.extent_;
  return body;
}

MovingBody MovingBody::grownTo(int k) const {
  MovingBody body = *this;
  body.distance_ += growth(k);
  body.growth_ = {};
  return body;
}

HalfSpace MovingBody::supportingHalfSpace(const Vector3& r) const {
  if (motion_ != nullptr) {
    // In coordinates shrunk to the ellipsoid's shorter semi-axis it is a ball, and no distance is longer there.
    const Vector3 shrunk = scale_.cwiseProduct(r);
    const double length = shrunk.norm();
    const Vector3 direction = length > 1e-9 ? Vector3(shrunk / length) : apart_;
    return {scale_.cwiseProduct(direction), distance_};
  }
  if (logarithmic_) return logarithmicHalfSpace(r);
  const Gauge gauge = obstacle_->gauge(r, level_);
  const double steepness = gauge.gradient.norm();
  // The distance to the surface lies between that to the plane and that along the line to the centre.
  const bool asks_more = precise_ && gauge.value > 1.0 && hasEdges(*obstacle_);
  if (asks_more && r.norm() * (1.0 - 1.0 / gauge.value) > kAsGood * (gauge.value - 1.0) / steepness) {
    Vector3 normal;
    const double distance = obstacle_->signedDistance(obstacle_->center() + r, normal);
    return {normal, normal.dot(r) - distance + distance_};
  }
  return {gauge.gradient / steepness, 1.0 / steepness + distance_};
}

HalfSpace MovingBody::logarithmicHalfSpace(const Vector3& r) const {
  // At the centre ln S has a pole, and nothing leads out.
  constexpr double kCore = 1e-6;
  Vector3 gradient;
  Matrix3 hessian;
  const double sum = std::max(obstacle_->sum(r, gradient, hessian), kCore);
  const double scale = logarithmScale(*obstacle_);
  const Vector3 n = scale / sum * gradient;
  return {n, n.dot(r) - scale * std::log(sum / level_)};
}

HalfSpace MovingBody::separatingHalfSpace(const SegmentPoints& relative) const {
  if (motion_ == nullptr) return supportingHalfSpace(midpoint(relative));
  SegmentPoints shrunk;
  for (std::size_t i = 0; i < shrunk.size(); ++i) shrunk[i] = scale_.cwiseProduct(relative[i]);
  const Vector3 nearest = nearestPoint(shrunk);
  const double length = nearest.norm();
  // Where the segment leads through the middle of the body no plane separates them.
  if (length < kThrough * distance_) return supportingHalfSpace(midpoint(relative));
  return {scale_.cwiseProduct(nearest) / length, distance_};
}

void MovingBody::relieve(const Vector3& r, double margin) {
  // Where the ellipsoid is long the clearance counts less than metres: so much of it costs the margin there.
  relief_ = std::clamp(-supportingHalfSpace(r).clearance(r), 0.0, scale_.minCoeff() * margin);
}

Vector3 nearestPoint(const SegmentPoints& points) {
  constexpr int kMostSteps = 6;
  constexpr double kEnough = 0.02;  // of the squared distance, that another control point may gain
  // Segments are nearly straight: most of the way is along the chord (Frank and Wolfe's method with exact steps).
  Vector3 nearest = nearestBetween(points[0], points[3]);
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector3* best = &points[0];
    for (const Vector3& point : points) {
      if (point.dot(nearest) < best->dot(nearest)) best = &point;
    }
    if (best->dot(nearest) > (1.0 - kEnough) * nearest.squaredNorm()) break;
    nearest = nearestBetween(nearest, *best);
  }
  return nearest;
}

SegmentClearance segmentClearance(const MovingBody& body, int k, const SegmentPoints& relative) {
  SegmentClearance result;
  result.half_space = body.separatingHalfSpace(relative);
  result.half_space.offset += body.growth(k) - body.relief(k);
  result.clearance = result.half_space.clearance(relative[0]);
  for (std::size_t i = 1; i < 4; ++i)
    result.clearance = std::min(result.clearance, result.half_space.clearance(relative[i]));
  return result;
}

}  // namespace swarm_planner
