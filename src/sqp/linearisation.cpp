// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/sqp/linearisation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "swarm_planner/problem/tracking_cost.hpp"
#include "swarm_planner/sqp/separating_planes.hpp"

namespace swarm_planner {
namespace {

constexpr double kNormBand = 0.6;  // of a norm limit, below which the iterate gets no tangent plane

/// Sources of rows: the limits' own at the iterate, their cuts by the number of the answer, the workspace's faces, and
/// two per body, since a knot belongs to two segments.
constexpr RowSource kIterateSource = 0, kWorkspaceSource = 100, kBodySource = 200, kCorridorSource = 1U << 31U;

// A knot's position has rows of two segments and of two faces of the workspace per axis.
static_assert(2 * (kMostSegmentPlanes + FreePolyhedron::kMostPlanes) + 2 * 6 <= kMaxBodyRows,
              "a stage cannot hold what is nearest");

/// Row for control point i = 0..3 of segment k; those of the first segment that the start fixes get none.
void addControlPointRow(Qp& qp, int k, int i, const Vector3& n, double d, RowSource source) {
  const std::optional<RowPlace> place = controlPointPlace(k, i);
  if (place) qp.addRow(place->stage, place->output, n, d, source + place->source);
}

/// The plane that touches |value + centre| <= limit towards `value`, if `value` is at least `from` of the limit.
void addTangent(Qp& qp, int stage, Output output, const Vector3& value, const Vector3& centre, double limit,
                double from, RowSource source) {
  const Vector3 outward = value + centre;
  const double norm = outward.norm();
  if (!(norm > from * limit)) return;
  const Vector3 n = -outward / norm;
  qp.addRow(stage, output, n, -limit - n.dot(centre), source);
}

/// What the model's mean drag leaves out of A of (3) where the axes' drags differ [m/s^2]; taken as constant.
Vector3 unequalDrag(const FlightBounds& bounds, const KinematicState& x, const Qp& qp) {
  return bounds.drag_over_mass.cwiseProduct(x.v) - qp.model.drag_over_mass * x.v;
}

void addNormTangents(const FlightBounds& bounds, const KinematicState& x, int stage, double from, RowSource source,
                     Qp& qp) {
  const Vector3 none = Vector3::Zero();
  addTangent(qp, stage, Output::kVelocity, x.v, none, bounds.max_speed, from, source);
  if (bounds.between_samples) {
    addTangent(qp, stage, Output::kVelocityControlPoint, x.v + 0.5 * qp.model.dt * x.a, none, bounds.max_speed, from,
               source);
  }
  addTangent(qp, stage, Output::kAcceleration, x.a, none, bounds.max_acceleration, from, source);
  addTangent(qp, stage, Output::kThrustAcceleration, x.a + qp.model.drag_over_mass * x.v,
             bounds.gravity + unequalDrag(bounds, x, qp), bounds.max_thrust_acceleration, from, source);
}

void addBoundRows(const FlightBounds& bounds, const KinematicState& x, int stage, Qp& qp) {
  addNormTangents(bounds, x, stage, kNormBand, kIterateSource, qp);
  const double vertical_thrust = x.a.z() + bounds.drag_over_mass.z() * x.v.z();
  if (vertical_thrust < (1.0 - kNormBand) * bounds.min_vertical_thrust) {
    qp.addRow(stage, Output::kThrustAcceleration, upward(), bounds.min_vertical_thrust - unequalDrag(bounds, x, qp).z(),
              kIterateSource + 1);
  }
}

void addWorkspaceRows(const FlightBounds& bounds, int k, const SegmentPoints& points, double band, Qp& qp) {
  const Workspace& workspace = bounds.workspace;
  for (int i = std::max(static_cast<int>(firstConstrainedPoint(bounds)), 1); i < 4; ++i) {
    const Vector3& point = points[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 n = Vector3::Unit(axis);
      const RowSource source = kWorkspaceSource + 4 * static_cast<RowSource>(axis);
      if (point[axis] - workspace.min[axis] < band) addControlPointRow(qp, k, i, n, workspace.min[axis], source);
      if (workspace.max[axis] - point[axis] < band) addControlPointRow(qp, k, i, -n, -workspace.max[axis], source + 2);
    }
  }
}

void addBodyRows(const UavProblem& problem, const SegmentPlanes& planes, Qp& qp) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const SegmentPlane& plane = planes[i];
    const MovingBody& body = problem.bodies[plane.body];
    const HalfSpace& half_space = plane.half_space;
    for (int j = firstRowPoint(problem.bounds, planes, i); j < 4; ++j) {
      addControlPointRow(qp, plane.segment, j, half_space.n,
                         half_space.offset + half_space.n.dot(body.point(plane.segment, j)),
                         kBodySource + 2 * body.identity());
    }
  }
}

/// Whether the segment before has a plane that asks as much.
bool isRepeated(const CorridorSegment& before, const CorridorPlane& plane) {
  constexpr double kSame = 1e-9;
  const auto end = before.planes.begin() + static_cast<std::ptrdiff_t>(before.count);
  return std::any_of(before.planes.begin(), end, [&plane](const CorridorPlane& other) {
    return other.identity == plane.identity && other.half_space.offset >= plane.half_space.offset - kSame &&
           (other.half_space.n - plane.half_space.n).cwiseAbs().maxCoeff() <= kSame;
  });
}

void addCorridorRows(const UavProblem& problem, const Trajectory& iterate, double band, Qp& qp) {
  const auto first_point = static_cast<int>(firstConstrainedPoint(problem.bounds));
  for (int k = 0; k < kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const CorridorSegment& segment = problem.corridor.segments[i];
    const SegmentPoints points = segmentPoints(iterate.knots[i], iterate.knots[i + 1], iterate.dt);
    for (std::size_t plane = 0; plane < segment.count; ++plane) {
      const CorridorPlane& limit = segment.planes[plane];
      const bool is_repeated = k > 0 && isRepeated(problem.corridor.segments[i - 1], limit);
      const RowSource source = kCorridorSource + 2 * limit.identity;
      for (int j = first_point + (is_repeated && first_point == 0 ? 1 : 0); j < 4; ++j) {
        if (limit.half_space.clearance(points[static_cast<std::size_t>(j)]) > band) continue;
        addControlPointRow(qp, k, j, limit.half_space.n, limit.half_space.offset, source);
      }
    }
  }
}

bool hasOneTangent(const StageFrames& frames) {
  constexpr double kSameDirection = 1e-9;
  return std::all_of(frames.begin() + 1, frames.end(), [&](const StageFrame& frame) {
    return (frame.foot.tangent - frames[1].foot.tangent).squaredNorm() < kSameDirection * kSameDirection;
  });
}

/// Gives the QP the positive eigenvalues of a stage's robustness Hessian; one as a rule.
void addCurvatures(const Matrix3& hessian, int stage, Qp& qp) {
  constexpr double kNegligible = 1e-3;  // of the curvature that is there anyway
  if (hessian.isZero(0.0)) return;
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(hessian);
  for (Eigen::Index i = 2; i >= 0; --i) {
    const double weight = eigen.eigenvalues()[i];
    if (weight > kNegligible * qp.model.along_weight) qp.addCurvature(stage, eigen.eigenvectors().col(i), weight);
  }
}

void setCost(const UavProblem& problem, const Trajectory& iterate, Qp& qp) {
  StageFrames frames;
  findStageFrames(problem, iterate, frames);
  const bool straight = hasOneTangent(frames);
  const QpModels models = makeQpModels(*problem.parameters);
  qp.setModel(straight ? models.straight : models.corner);
  qp.axes.setIdentity();
  if (straight) qp.axes << frames[1].foot.tangent, frames[1].horizontal, frames[1].vertical;
  for (int k = 1; k <= kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const KinematicState& x = iterate.knots[i];
    const StageCost cost = stageCost(problem, k, frames[i], x);
    addCurvatures(cost.robustness_hessian, k, qp);
    QpStage& stage = qp.stages[i];
    stage.position_gradient = cost.position_gradient - qp.positionHessian(k) * x.p;
    stage.velocity_gradient = cost.velocity_gradient - qp.model.velocityWeight(k) * x.v;
  }
}

}  // namespace

std::optional<RowPlace> controlPointPlace(int k, int i) {
  if (i == 3) return RowPlace{k + 1, Output::kPosition, 1};
  if (k == 0) return {};
  constexpr std::array<Output, 3> kOutputs{Output::kPosition, Output::kControlPoint1, Output::kControlPoint2};
  return RowPlace{k, kOutputs[static_cast<std::size_t>(i)], 0};
}

QpModels makeQpModels(const Parameters& parameters) {
  const CostParameters& cost = parameters.cost;
  const double dt = parameters.time.sampling_time;
  QpModel model;
  model.dt = dt;
  model.along_weight = 2.0 * dt * cost.eta;
  model.across_weight = 2.0 * dt * (std::max(cost.alpha, cost.beta) + cost.eta);
  model.velocity_weight = velocityWeight(parameters, 1);
  model.final_velocity_weight = velocityWeight(parameters, kHorizon);
  model.final_acceleration_weight = accelerationWeight(parameters, kHorizon);
  model.jerk_weight = jerkWeight(parameters);
  model.drag_over_mass = parameters.vehicle.dragOverMass().mean();
  model.slack_linear = parameters.sqp.slack_linear;
  model.slack_quadratic = parameters.sqp.slack_quadratic;
  model.holds_acceleration = parameters.limits.as_paper;
  QpModels models{model, model};
  models.corner.along_weight = model.across_weight;
  return models;
}

void linearise(const UavProblem& problem, const Trajectory& iterate, double band, Qp& qp, SegmentPlanes& planes) {
  qp.start = problem.start;
  qp.clear();
  setCost(problem, iterate, qp);

  const bool bounded = problem.bounds.workspace.max.allFinite();
  for (int k = 0; k < kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const SegmentPoints points = segmentPoints(iterate.knots[i], iterate.knots[i + 1], iterate.dt);
    addBoundRows(problem.bounds, iterate.knots[i + 1], k + 1, qp);
    if (bounded) addWorkspaceRows(problem.bounds, k, points, band, qp);
  }
  findSeparatingPlanes(problem, iterate, band, planes);
  addBodyRows(problem, planes, qp);
  if (problem.corridor.active) addCorridorRows(problem, iterate, band, qp);
}

bool leansOnBodies(const ActiveRows& active) {
  return std::any_of(active.rows.begin(), active.rows.begin() + active.count,
                     [](const ActiveRow& row) { return row.source >= kBodySource && row.source < kCorridorSource; });
}

void addNormCuts(const UavProblem& problem, const Trajectory& answer, int number, Qp& qp) {
  for (int k = 1; k <= kHorizon; ++k) {
    addNormTangents(problem.bounds, answer.knots[static_cast<std::size_t>(k)], k, 1.0,
                    kIterateSource + 2 + static_cast<RowSource>(number), qp);
  }
}

}  // namespace swarm_planner
