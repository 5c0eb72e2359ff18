// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/wayside.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kBearings = 16;                                                  // of directions looked at
constexpr std::array<double, 5> kElevations{0.0, 0.7, -0.7, 1.5708, -1.5708};  // [rad]
constexpr std::array<double, 7> kRadii{1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0};     // [spacing]
constexpr int kRetreats = 24;        // steps of one spacing along the other's way
constexpr double kRoom = 1.05;       // of the spacing, from ways and UAVs
constexpr double kStepAside = 1.1;   // of the spacing, after a retreat
constexpr double kLineStep = 0.25;   // between points of a line that are looked at [spacing]
constexpr double kWayLength = 40.0;  // of a way that is stayed off [spacing]
constexpr double kRounding = 1e-6;   // [m]
constexpr double kTwoPi = 6.283185307179586;
// Until then a moving obstacle must not come to the place [s].
constexpr std::array<double, 5> kLookAhead{0.0, 1.0, 2.0, 4.0, 8.0};

Vector3 direction(int bearing, double elevation) {
  const double angle = kTwoPi * bearing / kBearings;
  return {std::cos(elevation) * std::cos(angle), std::cos(elevation) * std::sin(angle), std::sin(elevation)};
}

}  // namespace

Wayside::Wayside(const Parameters& parameters, const std::optional<Workspace>& workspace, std::size_t uav_count,
                 std::size_t max_obstacles)
    : parameters_(parameters),
      spacing_{parameters.limits.pair_distance + parameters.limits.pair_margin,
               parameters.limits.pair_distance_vertical + parameters.limits.pair_margin} {
  bounds_.min = Vector3::Constant(-kInfinity);
  bounds_.max = Vector3::Constant(kInfinity);
  if (workspace) {
    const Vector3 margin = Vector3::Constant(parameters.limits.tracking_margin);
    bounds_.min = workspace->min + margin;
    bounds_.max = workspace->max - margin;
  }
  near_.reserve(max_obstacles);
  others_.reserve(uav_count);
}

void Wayside::begin(const std::vector<TrackedObstacle>& obstacles, double epoch, const VoxelMap* map) {
  obstacles_ = &obstacles;
  map_ = map;
  epoch_ = epoch;
}

void Wayside::gatherObstacles(const Vector3& from) {
  near_.clear();
  const double reach = (kRetreats + 2) * std::max(spacing_.horizontal, spacing_.vertical);
  for (const TrackedObstacle& obstacle : *obstacles_) {
    const double travel = (kLookAhead.back() + epoch_ - obstacle.stamp) * obstacle.shape.velocity().norm();
    if (obstacle.shape.distanceLowerBound(from) < reach + travel) near_.push_back(&obstacle);
  }
}

std::optional<WayAside> Wayside::find(const Request& request) {
  gatherObstacles(request.from);
  for (const bool strict : {true, false}) {
    if (const std::optional<WayAside> straight = findStraight(request, strict)) return straight;
    if (const std::optional<WayAside> back = findBack(request, strict)) return back;
  }
  return {};
}

std::optional<WayAside> Wayside::findStraight(const Request& request, bool strict) const {
  for (const double radius : kRadii) {
    std::optional<WayAside> best;
    double least = kInfinity;
    for (const double elevation : kElevations) {
      const bool is_vertical = std::abs(elevation) > 1.5;
      for (int bearing = 0; bearing < (is_vertical ? 1 : kBearings); ++bearing) {
        const Vector3 unit = direction(bearing, elevation);
        const Vector3 q = request.from + radius * kRoom *
                                             Vector3(spacing_.horizontal * unit.x(), spacing_.horizontal * unit.y(),
                                                     spacing_.vertical * unit.z());
        const double distance = (request.wanted - q).norm() + (q - request.from).norm();
        if (distance >= least || !isPlace(request, q, strict)) continue;
        if (!isPassable(request.from, q, request.from, strict)) continue;
        least = distance;
        best = WayAside{{request.from, q, q}, 2};
      }
    }
    if (best) return best;
  }
  return {};
}

std::optional<WayAside> Wayside::findBack(const Request& request, bool strict) const {
  const Way& way = *request.way;
  const double foot = way.arcOf(request.from, kWayLength * spacing_.horizontal);
  for (int step = 1; step <= kRetreats; ++step) {
    const double arc = foot + step * spacing_.horizontal;
    if (arc > way.path().length()) return {};
    const Vector3 back = way.path().at(arc).position;
    if (!isPassable(request.from, back, request.from, strict)) return {};
    std::optional<WayAside> best;
    double least = kInfinity;
    for (const double elevation : {0.0, kElevations[3], kElevations[4]}) {
      for (int bearing = 0; bearing < (elevation == 0.0 ? kBearings : 1); ++bearing) {
        const Vector3 unit = direction(bearing, elevation);
        const Vector3 q = back + kStepAside * Vector3(spacing_.horizontal * unit.x(), spacing_.horizontal * unit.y(),
                                                      spacing_.vertical * unit.z());
        const double distance = (request.wanted - q).norm();
        if (distance >= least || !isPlace(request, q, strict) || !isPassable(back, q, request.from, strict)) continue;
        least = distance;
        best = WayAside{{request.from, back, q}, 3};
      }
    }
    if (best) return best;
  }
  return {};
}

bool Wayside::isPlace(const Request& request, const Vector3& q, bool strict) const {
  if ((q.array() < bounds_.min.array()).any() || (q.array() > bounds_.max.array()).any()) return false;
  // Without a workspace nobody knows where the ground is.
  const double floor = std::min(request.from.z(), request.wanted.z()) - kRounding;
  if (!std::isfinite(bounds_.min.z()) && q.z() < floor) return false;
  const double length = kWayLength * spacing_.horizontal;
  for (const Way* way : {request.way, request.second}) {
    if (way != nullptr && way->gaugeTo(q, length, spacing_) < kRoom) return false;
  }
  for (const Other& other : others_) {
    if ((strict || !other.may_be_asked) && spacing_.gauge(q - other.place) < kRoom) return false;
  }
  return isClearOfObstacles(q, true);
}

bool Wayside::isPassable(const Vector3& from, const Vector3& to, const Vector3& start, bool strict) const {
  const double length = (to - from).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length / (kLineStep * spacing_.horizontal))));
  for (int i = 1; i <= steps; ++i) {
    const Vector3 q = from + (to - from) * (static_cast<double>(i) / steps);
    if (!isClearOfObstacles(q, false)) return false;
    for (const Other& other : others_) {
      if (!strict && other.may_be_asked) continue;
      // Who stands beside it at the start is in the way only if it comes nearer.
      const double least = std::min(1.0, spacing_.gauge(start - other.place));
      if (spacing_.gauge(q - other.place) < 0.98 * least) return false;
    }
  }
  return true;
}

bool Wayside::isClearOfObstacles(const Vector3& q, bool for_long) const {
  const LimitParameters& limits = parameters_.limits;
  // A UAV that waits may have used its margin up.
  const double least = limits.uav_radius + (for_long ? limits.tracking_margin : limits.tracking_error);
  if (map_ != nullptr && map_->distance(q, least) < least) return false;
  return std::none_of(near_.begin(), near_.end(), [&](const TrackedObstacle* obstacle) {
    const bool moves = for_long && obstacle->shape.velocity().squaredNorm() > 0.0;
    for (std::size_t i = 0; i < (moves ? kLookAhead.size() : 1); ++i) {
      const double age = epoch_ - obstacle->stamp + kLookAhead[i];
      const double demanded = least + inflationOf(*obstacle, parameters_.input).at(age);
      const Vector3 place = q - age * obstacle->shape.velocity();
      if (obstacle->shape.distanceLowerBound(place) >= demanded) continue;
      if (obstacle->shape.signedDistance(place) < demanded) return true;
    }
    return false;
  });
}

}  // namespace swarm_planner
