// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/passing_side.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr int kDirections = 8;
constexpr double kRightBonus = 0.1;   // of the distance to keep: decides draws, never a clear case
constexpr double kLevelBonus = 0.01;  // likewise, between above and below
constexpr double kMinMotion = 1e-3;   // relative motion over a segment below which there is no passage [m]

/// How far a point must move from `origin` along `direction` to leave the body [m]; 0 if it is outside.
double wayOut(const MovingBody& body, const Vector3& origin, const Vector3& direction) {
  const auto clearance = [&](double distance) {
    const Vector3 r = origin + distance * direction;
    return body.supportingHalfSpace(r).clearance(r);
  };
  if (clearance(1e-6) >= 0.0) return 0.0;
  double inside = 0.0;
  double outside = 2.0 * body.radius() + origin.norm();
  const double tolerance = 1e-3 * body.radius();
  while (outside - inside > tolerance) {
    const double middle = 0.5 * (inside + outside);
    (clearance(middle) < 0.0 ? inside : outside) = middle;
  }
  return outside;
}

/// 1 or -1, opposite for opposite directions: eastbound is 1, as for flight levels.
double eastbound(const Vector3& along) {
  constexpr double kTurned = 1e-3;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(along[axis]) > kTurned) return std::copysign(1.0, along[axis]);
  }
  return std::copysign(1.0, along.z());
}

bool contains(const Workspace& workspace, const Vector3& point) {
  return (point.array() >= workspace.min.array()).all() && (point.array() <= workspace.max.array()).all();
}

}  // namespace

std::optional<PassingSide> PassingSide::choose(const MovingBody& body, const SegmentPoints& relative,
                                               const Vector3& position, double reach, const Workspace& workspace) {
  const Vector3 motion = relative[3] - relative[0];
  if (motion.norm() < kMinMotion) return std::nullopt;
  const Vector3 along = motion.normalized();
  const Vector3 across = along.cross(upward());
  const Vector3 right =
      across.norm() > 1e-3 ? Vector3(across.normalized()) : Vector3(std::copysign(1.0, along.z()) * Vector3::UnitY());
  const Vector3 above = right.cross(along);
  const Vector3 r = midpoint(relative);
  const Vector3 origin = r.dot(along) * along;

  const double level_bonus = kLevelBonus * eastbound(along);

  std::optional<PassingSide> best;
  double best_cost = reach;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * i / kDirections;
    const Vector3 sideways = std::cos(angle) * right + std::sin(angle) * above;
    const double shift = wayOut(body, origin, sideways) - r.dot(sideways);
    const double cost = shift - body.distance() * (kRightBonus * std::cos(angle) + level_bonus * std::sin(angle));
    if (cost >= best_cost || !contains(workspace, position + shift * sideways)) continue;
    best_cost = cost;
    best = PassingSide(along, sideways);
  }
  return best;
}

HalfSpace PassingSide::halfSpace(const MovingBody& body, const Vector3& r) const {
  const Vector3 origin = r.dot(along_) * along_;
  const double distance = wayOut(body, origin, sideways_);
  return body.supportingHalfSpace(distance > 0.0 ? Vector3(origin + distance * sideways_) : r);
}

}  // namespace swarm_planner
