// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/landing_sites.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {
namespace {

constexpr int kRings = 18;             // of sites around the place itself: about a thousand
constexpr double kRingSpacing = 1.02;  // of spacing: neighbours on a ring are then far enough apart, rounding included
constexpr double kLookAhead = 20.0;    // that an obstacle must not come to a site [s]; the check's
constexpr double kSweepStep = 0.5;     // between places of a moving obstacle [m]
constexpr double kMostSweepSteps = 200;
constexpr double kMapStep = 0.5;  // of the distance to keep, between places of a column
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTwoPi = 6.283185307179586;

/// Where in a vertical segment a superellipsoid that stands upright is nearest: its sections shrink with the distance
/// from the plane through its centre.
Vector3 nearestOnColumn(const Superellipsoid& body, const Vector3& bottom, double top) {
  return Vector3(bottom.x(), bottom.y(), std::clamp(body.center().z(), bottom.z(), std::max(bottom.z(), top)));
}

}  // namespace

LandingSites::LandingSites(const Parameters& parameters, const std::optional<Workspace>& workspace,
                           std::size_t uav_count)
    : parameters_(parameters), spacing_(parameters.limits.pair_distance + parameters.limits.pair_margin) {
  const double margin = parameters.limits.tracking_margin;
  bounds_.min = Vector3::Constant(-kInfinity);
  bounds_.max = Vector3::Constant(kInfinity);
  if (workspace) {
    bounds_.min = workspace->min + Vector3::Constant(margin);
    bounds_.max = workspace->max - Vector3::Constant(margin);
  }
  taken_.reserve(uav_count);
}

void LandingSites::begin(const std::vector<TrackedObstacle>& obstacles, double epoch, const VoxelMap* map) {
  obstacles_ = &obstacles;
  map_ = map;
  epoch_ = epoch;
  taken_.clear();
  effort_ = 0;
}

std::optional<Vector3> LandingSites::find(std::size_t uav, const Vector3& place, double ground) const {
  Vector3 site(place.x(), place.y(), std::min(ground, place.z()));
  if (isInside(site) && isFree(uav, site, place.z(), spacing_)) return site;
  const Vector3 centre = site;
  for (int ring = 1; ring <= kRings; ++ring) {
    const double radius = ring * kRingSpacing * spacing_;
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = kTwoPi * i / (6 * ring);
      site = centre + radius * Vector3(std::cos(angle), std::sin(angle), 0.0);
      if (isInside(site) && isFree(uav, site, place.z(), spacing_)) return site;
    }
  }
  return {};
}

bool LandingSites::canKeep(std::size_t uav, const Vector3& site, double top) const {
  return isFree(uav, site, top, parameters_.limits.pair_distance);
}

bool LandingSites::isFree(std::size_t uav, const Vector3& bottom, double top, double apart) const {
  for (const Column& column : taken_) {
    ++effort_;
    if (column.uav != uav && (column.place - bottom).head<2>().squaredNorm() < apart * apart) return false;
  }
  if (isMapped(bottom, top)) return false;
  return std::none_of(obstacles_->begin(), obstacles_->end(), [&](const TrackedObstacle& obstacle) {
    ++effort_;
    return isBlockedBy(obstacle, bottom, top);
  });
}

bool LandingSites::isInside(const Vector3& site) const {
  return (site.head<2>().array() >= bounds_.min.head<2>().array()).all() &&
         (site.head<2>().array() <= bounds_.max.head<2>().array()).all();
}

bool LandingSites::isMapped(const Vector3& bottom, double top) const {
  if (map_ == nullptr) return false;
  const double least = parameters_.limits.uav_radius + parameters_.limits.tracking_margin;
  // The ground itself may be mapped, as thick as a voxel: a UAV comes down as far as the check lets it.
  const double foot = bottom.z() + least + 2.0 * map_->resolution();
  for (double z = top; z > foot; z -= kMapStep * least) {
    if (map_->distance(Vector3(bottom.x(), bottom.y(), z), least) < least) return true;
  }
  return false;
}

bool LandingSites::isBlockedBy(const TrackedObstacle& obstacle, const Vector3& bottom, double top) const {
  const double age = epoch_ - obstacle.stamp;
  const TrackInflation inflation = inflationOf(obstacle, parameters_.input);
  const double least =
      parameters_.limits.uav_radius + parameters_.limits.tracking_margin + inflation.at(inflation.growth_time);
  const double way = kLookAhead * obstacle.shape.velocity().norm();
  const double steps = std::clamp(std::ceil(way / kSweepStep), 1.0, kMostSweepSteps);
  // Between two places the distance differs from theirs by half a step at most.
  const double demanded = least + (way > 0.0 ? 0.5 * way / steps : 0.0);
  for (int i = 0; i <= (way > 0.0 ? static_cast<int>(steps) : 0); ++i) {
    const Superellipsoid body = obstacle.shape.movedBy(age + i * kLookAhead / steps);
    const Vector3 nearest = nearestOnColumn(body, bottom, top);
    if (body.distanceLowerBound(nearest) < demanded && body.signedDistance(nearest) < demanded) return true;
  }
  return false;
}

}  // namespace swarm_planner
