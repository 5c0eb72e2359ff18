// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/uav_problem.hpp"

#include <algorithm>
#include <limits>

#include "swarm_planner/problem/tracking_cost.hpp"

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void addBoundViolations(const FlightBounds& bounds, const KinematicState& x, double dt, Violation& violation) {
  violation.add(bounds.max_speed - x.v.norm());
  if (bounds.between_samples) violation.add(bounds.max_speed - (x.v + 0.5 * dt * x.a).norm());
  violation.add(bounds.max_acceleration - x.a.norm());
  const Vector3 thrust = x.a + bounds.drag_over_mass.cwiseProduct(x.v);
  violation.add(bounds.max_thrust_acceleration - (thrust + bounds.gravity).norm());
  violation.add(thrust.z() - bounds.min_vertical_thrust);
}

void addWorkspaceViolations(const FlightBounds& bounds, const SegmentPoints& points, Violation& violation) {
  const std::size_t first_free = std::max<std::size_t>(firstConstrainedPoint(bounds), 1);
  for (std::size_t i = first_free; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      violation.add(points[i][axis] - bounds.workspace.min[axis]);
      violation.add(bounds.workspace.max[axis] - points[i][axis]);
    }
  }
}

void addCorridorViolations(const UavProblem& problem, const PlanPoints& points, Violation& violation) {
  const std::size_t first = firstConstrainedPoint(problem.bounds);
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const CorridorSegment& segment = problem.corridor.segments[k];
    // The start is as it is.
    for (std::size_t i = std::max<std::size_t>(first, k == 0 ? 1 : 0); i < 4; ++i) {
      const Vector3& point = points[k][i];
      for (std::size_t j = 0; j < segment.count; ++j) violation.add(segment.planes[j].half_space.clearance(point));
      for (int axis = 0; axis < 3; ++axis) {
        violation.add(point[axis] - segment.window.min[axis]);
        violation.add(segment.window.max[axis] - point[axis]);
      }
    }
  }
}

double leastClearance(const HalfSpace& half_space, const SegmentPoints& relative) {
  double least = half_space.clearance(relative[0]);
  for (std::size_t i = 1; i < relative.size(); ++i) least = std::min(least, half_space.clearance(relative[i]));
  return least;
}

/// Lower bound of the distance from a point `r` relative to the centre to the surface S = 1 [m], which is what counts
/// as clearance: eps_s belongs to the constraint (7) alone. Just some distance above `limit` >= 0 if it is certainly
/// above.
double surfaceDistance(const Superellipsoid& obstacle, const Vector3& r, double limit) {
  const double at_least =
      std::max((r.cwiseAbs() - obstacle.halfExtents()).cwiseMax(0.0).norm(), r.norm() - obstacle.boundingRadius());
  if (at_least > limit) return at_least;
  const Gauge gauge = obstacle.gauge(r);
  return (gauge.value - 1.0) / gauge.gradient.norm();
}

}  // namespace

FlightBounds::FlightBounds(const Parameters& parameters, const Workspace* scenario_workspace) {
  const LimitParameters& limits = parameters.limits;
  const VehicleParameters& vehicle = parameters.vehicle;
  max_speed = limits.max_speed;
  max_acceleration = limits.max_acceleration;
  max_jerk = limits.as_paper ? kInfinity : limits.max_jerk;
  max_thrust_acceleration = limits.max_thrust_ratio * vehicle.gravity;
  min_vertical_thrust = (limits.min_thrust_ratio - 1.0) * vehicle.gravity;
  drag_over_mass = vehicle.dragOverMass();
  gravity = vehicle.gravity * upward();
  between_samples = limits.segment_constraints;
  workspace.min = Vector3::Constant(-kInfinity);
  workspace.max = Vector3::Constant(kInfinity);
  if (scenario_workspace == nullptr) return;
  const Vector3 margin = Vector3::Constant(limits.tracking_margin);
  workspace.min = scenario_workspace->min + margin;
  workspace.max = scenario_workspace->max - margin;
}

void findConstrainedPoints(const UavProblem& problem, const Trajectory& plan, PlanPoints& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (problem.bounds.between_samples) {
      points[k] = segmentPoints(plan.knots[k], plan.knots[k + 1], plan.dt);
    } else {
      points[k].fill(plan.knots[k + 1].p);
    }
  }
}

Box planBox(const PlanPoints& points) {
  Box box;
  for (const SegmentPoints& segment : points) {
    for (const Vector3& point : segment) box.include(point);
  }
  return box;
}

void addBodyViolations(const UavProblem& problem, const MovingBody& body, std::size_t index, const PlanPoints& points,
                       SegmentPlanes::const_iterator plane, SegmentPlanes::const_iterator end, Violation& violation) {
  for (int k = 0; k < kHorizon; ++k) {
    while (plane != end && plane->body == index && plane->segment < k) ++plane;
    const bool has_plane = plane != end && plane->body == index && plane->segment == k;
    const SegmentPoints relative = relativeConstrainedPoints(problem, points, k, body);
    if (isBeyond(body, relative, 0.0)) continue;
    const bool is_safe = has_plane && body.halfSpacesAreSafe();
    const double known = is_safe ? leastClearance(plane->half_space, relative) : -kInfinity;
    if (known >= 0.0) continue;
    const SegmentClearance segment = segmentClearance(body, k, relative);
    if (segment.clearance >= 0.0) continue;
    const HalfSpace& half_space = known > segment.clearance ? plane->half_space : segment.half_space;
    for (std::size_t i = firstConstrainedPoint(problem.bounds); i < relative.size(); ++i) {
      violation.add(half_space.clearance(relative[i]));
    }
  }
}

Violation planViolation(const UavProblem& problem, const Trajectory& plan, const SegmentPlanes& planes) {
  Violation violation;
  const bool bounded = problem.bounds.workspace.max.allFinite();
  PlanPoints points;
  findConstrainedPoints(problem, plan, points);
  for (std::size_t k = 0; k < kHorizon; ++k) {
    addBoundViolations(problem.bounds, plan.knots[k + 1], plan.dt, violation);
    if (bounded) addWorkspaceViolations(problem.bounds, points[k], violation);
  }
  if (problem.corridor.active) addCorridorViolations(problem, points, violation);
  const Box box = planBox(points);
  auto plane = planes.begin();
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const MovingBody& body = problem.bodies[i];
    while (plane != planes.end() && plane->body < i) ++plane;
    if (body.box().near(box, 0.0)) addBodyViolations(problem, body, i, points, plane, planes.end(), violation);
  }
  return violation;
}

double penaltyOf(const Violation& violation, const SqpParameters& sqp) {
  return sqp.slack_linear * violation.linear + 0.5 * sqp.slack_quadratic * violation.quadratic;
}

Merit merit(const UavProblem& problem, const Trajectory& plan, const SegmentPlanes& planes) {
  const Violation violation = planViolation(problem, plan, planes);
  return {planCost(problem, plan) + penaltyOf(violation, problem.parameters->sqp), violation.largest};
}

PredictedClearance predictedClearance(const UavProblem& problem, const Trajectory& plan) {
  // The paper's obstacles have grown by it.
  const LimitParameters& limits = problem.parameters->limits;
  const double uav_radius = limits.as_paper ? 0.0 : limits.uav_radius;
  PredictedClearance least{kInfinity, kInfinity};
  Box box;
  for (const KinematicState& knot : plan.knots) box.include(knot.p);
  for (const MovingBody& body : problem.bodies) {
    const double reach = body.isUav() ? least.pair : least.obstacle + uav_radius;
    if (!body.box().near(box, std::max(reach, 0.0))) continue;
    for (int k = 0; k <= kHorizon; ++k) {
      const Vector3 reference = k < kHorizon ? body.point(k, 0) : body.point(kHorizon - 1, 3);
      const Vector3 r = plan.knots[static_cast<std::size_t>(k)].p - reference;
      if (body.isUav()) {
        least.pair = std::min(least.pair, r.norm());
      } else {
        const double limit = std::max(least.obstacle + uav_radius, 0.0);
        least.obstacle = std::min(least.obstacle, surfaceDistance(*body.obstacle(), r, limit) - uav_radius);
      }
    }
  }
  return least;
}

}  // namespace swarm_planner
