// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "optimality/reference_program.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

using Kind = ReferenceProgram::Row::Kind;
using Local = ReferenceProgram::Local;

/// Of a sum of squares under a root, so that it has derivatives at 0.
constexpr double kTiny = 1e-12;

/// S of (7) for an offset in the obstacle's own axes.
template <class Number>
Number powerSum(const Superellipsoid& obstacle, const std::array<Number, 3>& u) {
  Number sum(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    sum = sum + power(1.0 / obstacle.radii()[axis] * u[i], obstacle.exponents()[axis]);
  }
  return sum;
}

/// An offset in the obstacle's own axes.
template <class Number>
std::array<Number, 3> turned(const Superellipsoid& obstacle, const std::array<Number, 3>& u) {
  const double c = std::cos(obstacle.yaw()), s = std::sin(obstacle.yaw());
  return {c * u[0] + s * u[1], c * u[1] - s * u[0], u[2]};
}

/// g of (11) with (12).
template <class Number>
Number smoothed(const Number& t, double inner, double outer) {
  constexpr double kNegligible = 600.0;
  if (t.value <= inner) return Number(1.0);
  if (t.value >= outer) return Number(0.0);
  const Number exponent = inverse(Number(outer) - t) - inverse(t - Number(inner));
  if (exponent.value > kNegligible) return Number(0.0);
  if (exponent.value < -kNegligible) return Number(1.0);
  return inverse(Number(1.0) + exponential(exponent));
}

template <class Number>
Number squared(const Number& x) {
  return x * x;
}

}  // namespace

void ReferenceProgram::makeOutputs() {
  // Each axis by itself: how unit jerks and the start move p, v and a from stage to stage.
  const double dt = problem_.dt;
  const bool held = problem_.parameters->limits.as_paper;
  Vector3 p = problem_.start.p, v = problem_.start.v, a = problem_.start.a;
  Gains of_p = Gains::Zero(), of_v = Gains::Zero(), of_a = Gains::Zero();
  states_[0] = {addOutput(p, of_p), addOutput(v, of_v), addOutput(a, of_a)};
  for (int k = 0; k < kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    Gains change = Gains::Zero();
    change.block<3, 3>(0, 3 * k) = Eigen::Matrix3d::Identity();
    const int begin = states_[i][0];
    const int first = addOutput(p + dt / 3.0 * v, of_p + dt / 3.0 * of_v);
    const int second =
        addOutput(p + 2.0 * dt / 3.0 * v + dt * dt / 6.0 * a, of_p + 2.0 * dt / 3.0 * of_v + dt * dt / 6.0 * of_a);
    const double third = held ? dt * dt * dt / 2.0 : dt * dt * dt / 6.0;
    const double half = held ? dt * dt : dt * dt / 2.0;
    p += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
    of_p += dt * of_v + 0.5 * dt * dt * of_a + third * change;
    of_v += dt * of_a + half * change;
    of_a += dt * change;
    states_[i + 1] = {addOutput(p, of_p), addOutput(v, of_v), addOutput(a, of_a)};
    points_[i] = {begin, first, second, states_[i + 1][0]};
  }
}

int ReferenceProgram::addOutput(const Vector3& free, const Gains& gains) {
  outputs_.push_back({free, gains});
  return static_cast<int>(outputs_.size()) - 1;
}

void ReferenceProgram::addRow(Row row) {
  const bool is_equality = row.kind == Kind::kSurface || row.kind == Kind::kUnitLength;
  if (!is_equality) row.slack = slacks_++;
  rows_.push_back(row);
}

void ReferenceProgram::addBoundRows() {
  const FlightBounds& bounds = problem_.bounds;
  const auto norm = [this](int output, const Vector3& centre, double limit) {
    if (std::isfinite(limit)) addRow({Kind::kNorm, output, -1, -1, centre, limit, -1});
  };
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const auto [p, v, a] = states_[k];
    const Output of_v = outputs_[static_cast<std::size_t>(v)];
    const Output of_a = outputs_[static_cast<std::size_t>(a)];
    norm(v, Vector3::Zero(), bounds.max_speed);
    if (bounds.between_samples) {
      const double half = 0.5 * problem_.dt;
      norm(addOutput(of_v.free + half * of_a.free, of_v.gains + half * of_a.gains), Vector3::Zero(), bounds.max_speed);
    }
    norm(a, Vector3::Zero(), bounds.max_acceleration);
    const Vector3& drag = bounds.drag_over_mass;
    const int thrust = addOutput(of_a.free + drag.cwiseProduct(of_v.free), of_a.gains + drag.asDiagonal() * of_v.gains);
    norm(thrust, bounds.gravity, bounds.max_thrust_acceleration);
    addRow({Kind::kAtLeast, thrust, -1, -1, Vector3::Zero(), bounds.min_vertical_thrust, -1});
  }
}

ReferenceProgram::Row ReferenceProgram::bodyRow(int body, int segment, int point) const {
  const MovingBody& moving = problem_.bodies[static_cast<std::size_t>(body)];
  Row row;
  row.output = points_[static_cast<std::size_t>(segment)][static_cast<std::size_t>(point)];
  row.body = body;
  row.offset = moving.point(segment, point);
  row.limit = moving.distance() + moving.growth(segment) - moving.relief(segment);
  return row;
}

void ReferenceProgram::addBodyRows(int body, int segment) {
  const bool is_uav = problem_.bodies[static_cast<std::size_t>(body)].isUav();
  if (problem_.parameters->limits.as_paper) {
    Row row = bodyRow(body, segment, 3);
    row.kind = is_uav ? Kind::kBall : Kind::kLogarithm;
    addRow(row);
    return;
  }
  const int plane = planes_++;
  for (int point = 0; point < 4; ++point) {
    Row row = bodyRow(body, segment, point);
    row.kind = is_uav ? Kind::kPairPlane : Kind::kObstaclePlane;
    row.plane = plane;
    addRow(row);
  }
  Row row = bodyRow(body, segment, 3);
  row.kind = is_uav ? Kind::kUnitLength : Kind::kSurface;
  row.plane = plane;
  addRow(row);
}

Vector3 ReferenceProgram::shrinkage() const {
  const LimitParameters& limits = problem_.parameters->limits;
  const double margin = limits.as_paper ? 0.0 : limits.pair_margin;
  const double horizontal = limits.pair_distance + margin, vertical = limits.pair_distance_vertical + margin;
  const double shorter = std::min(horizontal, vertical);
  return Vector3(shorter / horizontal, shorter / horizontal, shorter / vertical);
}

Vector3 ReferenceProgram::valueOf(int output, const Eigen::VectorXd& z) const {
  const Output& of = outputs_[static_cast<std::size_t>(output)];
  return of.free + of.gains * z.head<kInputs>();
}

Local ReferenceProgram::value(const Row& row, const Eigen::VectorXd& z) const {
  const Vector3 y = valueOf(row.output, z);
  std::array<Local, 3> u, w;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const double offset = row.kind == Kind::kNorm ? row.offset[i] : -row.offset[i];
    u[axis] = Local(y[i], i) + Local(offset);
    if (row.plane >= 0) w[axis] = Local(z[planeIndex(row.plane) + i], 3 + i);
  }
  const auto square = [](const std::array<Local, 3>& x) { return squared(x[0]) + squared(x[1]) + squared(x[2]); };
  const auto product = [](const std::array<Local, 3>& a, const std::array<Local, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  if (row.kind == Kind::kNorm) return Local(row.limit) - squareRoot(square(u) + Local(kTiny));
  if (row.kind == Kind::kAtLeast) return Local(y.z(), 2) - Local(row.limit);
  if (row.kind == Kind::kUnitLength) return square(w) - Local(1.0);
  if (row.kind == Kind::kBall || row.kind == Kind::kPairPlane) {
    const Vector3 scale = shrinkage();
    for (std::size_t i = 0; i < 3; ++i) u[i] = scale[static_cast<Eigen::Index>(i)] * u[i];
    return (row.kind == Kind::kBall ? squareRoot(square(u) + Local(kTiny)) : product(w, u)) - Local(row.limit);
  }
  const Superellipsoid& obstacle = *problem_.bodies[static_cast<std::size_t>(row.body)].obstacle();
  const double epsilon = problem_.parameters->cost.epsilon_s;
  u = turned(obstacle, u);
  if (row.kind == Kind::kLogarithm) {
    return logarithmScale(obstacle) * (logarithm(powerSum(obstacle, u)) - Local(epsilon));
  }
  if (row.kind == Kind::kSurface) return logarithm(powerSum(obstacle, w)) - Local(epsilon);
  std::array<Local, 3> normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double p = obstacle.exponents()[axis], inverse_radius = 1.0 / obstacle.radii()[axis];
    normal[i] = p * inverse_radius * signedPower(inverse_radius * w[i], p - 1.0);
    u[i] = u[i] - w[i];
  }
  return product(normal, u) * inverse(squareRoot(square(normal))) - Local(row.limit);
}

ReferenceProgram::Stage ReferenceProgram::robustness(int stage, const std::array<Stage, 9>& x) const {
  const CostParameters& cost = problem_.parameters->cost;
  Stage sum;
  for (const MovingBody& body : problem_.bodies) {
    if (body.isUav()) continue;
    const Superellipsoid& obstacle = *body.obstacle();
    const Vector3 centre = obstacle.center() + stage * problem_.dt * obstacle.velocity();
    const std::array<Stage, 3> u = turned(
        obstacle, std::array<Stage, 3>{x[0] - Stage(centre.x()), x[1] - Stage(centre.y()), x[2] - Stage(centre.z())});
    const Stage inside = powerSum(obstacle, u);
    if (inside.value >= cost.robustness_outer) continue;
    // (8) with (9) and (10), without the constant.
    const double radius = obstacle.radii().maxCoeff();
    const Stage distance = squared(u[0]) + squared(u[1]) + squared(u[2]);
    const Stage h_bar = logarithm(1.0 / (radius * radius) * distance);
    sum = sum + cost.robustness_gain * smoothed(inside, cost.robustness_inner, cost.robustness_outer) *
                    exponential(Stage(cost.epsilon_s) - h_bar);
  }
  return sum;
}

/// (16) at one stage times dt, without the change of the control.
ReferenceProgram::Stage ReferenceProgram::stageCost(int stage, const Eigen::VectorXd& z) const {
  const Parameters& parameters = *problem_.parameters;
  const CostParameters& cost = parameters.cost;
  const auto k = static_cast<std::size_t>(stage);
  std::array<Stage, 9> x;
  for (std::size_t part = 0; part < 3; ++part) {
    const Vector3 value = valueOf(states_[k][part], z);
    for (int i = 0; i < 3; ++i) {
      const int index = 3 * static_cast<int>(part) + i;
      x[static_cast<std::size_t>(index)] = Stage(value[i], index);
    }
  }
  const PathPoint line = problem_.path->at(0.0);
  const Vector3& along = line.tangent;
  const Vector3 across = Vector3::UnitZ().cross(along).normalized();
  const Vector3 above = along.cross(across);
  const auto component = [&x](const Vector3& direction, const Vector3& from) {
    return direction.x() * (x[0] - Stage(from.x())) + direction.y() * (x[1] - Stage(from.y())) +
           direction.z() * (x[2] - Stage(from.z()));
  };
  Stage sum =
      cost.alpha * squared(component(across, line.position)) + cost.beta * squared(component(above, line.position));
  const bool rests = stage == kHorizon && !parameters.limits.as_paper;
  const TargetState& target = problem_.targets[k];
  const double time = cost.velocity_time;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    sum = sum + cost.eta * squared(x[i] - Stage(target.p[axis]));
    if (rests) {
      const double third = problem_.dt / 3.0;
      sum = sum + cost.stop_weight * time * time * (squared(x[3 + i]) + third * third * squared(x[6 + i]));
    } else {
      sum = sum + cost.eta * time * time * squared(x[3 + i] - Stage(target.v[axis]));
    }
  }
  return problem_.dt * (sum + robustness(stage, x));
}

double ReferenceProgram::objective(const Eigen::VectorXd& z) const {
  double sum = problem_.dt * problem_.parameters->cost.zeta * z.head<kInputs>().squaredNorm();
  for (int stage = 1; stage <= kHorizon; ++stage) sum += stageCost(stage, z).value;
  const Eigen::VectorXd slack = z.segment(kInputs, slacks_);
  return sum + slackLinear() * slack.sum() + 0.5 * slackQuadratic() * slack.squaredNorm();
}

Eigen::VectorXd ReferenceProgram::gradient(const Eigen::VectorXd& z) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(z.size());
  sum.head<kInputs>() = 2.0 * problem_.dt * problem_.parameters->cost.zeta * z.head<kInputs>();
  for (int stage = 1; stage <= kHorizon; ++stage) {
    const Stage cost = stageCost(stage, z);
    for (int part = 0; part < 3; ++part) {
      const int output = states_[static_cast<std::size_t>(stage)][static_cast<std::size_t>(part)];
      sum.head<kInputs>() +=
          outputs_[static_cast<std::size_t>(output)].gains.transpose() * cost.gradient.segment<3>(3 * part);
    }
  }
  sum.segment(kInputs, slacks_).array() = slackLinear() + slackQuadratic() * z.segment(kInputs, slacks_).array();
  return sum;
}

Eigen::MatrixXd ReferenceProgram::inputHessian(const Eigen::VectorXd& z) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(kInputs, kInputs);
  sum *= 2.0 * problem_.dt * problem_.parameters->cost.zeta;
  Eigen::Matrix<double, 9, kInputs> gains;
  for (int stage = 1; stage <= kHorizon; ++stage) {
    for (int part = 0; part < 3; ++part) {
      const int output = states_[static_cast<std::size_t>(stage)][static_cast<std::size_t>(part)];
      gains.middleRows<3>(3 * part) = outputs_[static_cast<std::size_t>(output)].gains;
    }
    sum += gains.transpose() * stageCost(stage, z).hessian * gains;
  }
  return sum;
}

Vector3 ReferenceProgram::touchPoint(const Row& row, const Eigen::VectorXd& z) const {
  const MovingBody& body = problem_.bodies[static_cast<std::size_t>(row.body)];
  Vector3 middle = Vector3::Zero();
  for (const Row& other : rows_) {
    if (other.plane == row.plane && other.slack >= 0) middle += 0.25 * (valueOf(other.output, z) - other.offset);
  }
  if (middle.norm() < 1e-6) middle = Vector3::UnitX();
  if (body.isUav()) return shrinkage().cwiseProduct(middle).normalized();
  const Superellipsoid& obstacle = *body.obstacle();
  const double c = std::cos(obstacle.yaw()), s = std::sin(obstacle.yaw());
  const Vector3 own(c * middle.x() + s * middle.y(), c * middle.y() - s * middle.x(), middle.z());
  return own / obstacle.gauge(middle, std::exp(problem_.parameters->cost.epsilon_s)).value;
}

Eigen::VectorXd ReferenceProgram::startAt(const Trajectory& plan) const {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(variableCount());
  for (int k = 0; k < kHorizon; ++k) z.segment<3>(3 * k) = plan.jerks[static_cast<std::size_t>(k)];
  for (const Row& row : rows_) {
    if (row.plane >= 0 && row.slack < 0) z.segment<3>(planeIndex(row.plane)) = touchPoint(row, z);
  }
  for (const Row& row : rows_) {
    if (row.slack >= 0) z[slackIndex(row.slack)] = std::max(0.0, -value(row, z).value);
  }
  return z;
}

Trajectory ReferenceProgram::planOf(const Eigen::VectorXd& z) const {
  Trajectory plan;
  plan.epoch = problem_.epoch;
  plan.dt = problem_.dt;
  plan.holds_acceleration = problem_.parameters->limits.as_paper;
  for (int k = 0; k < kHorizon; ++k) plan.jerks[static_cast<std::size_t>(k)] = z.segment<3>(3 * k);
  rollOut(problem_.start, plan);
  return plan;
}

}  // namespace swarm_planner
