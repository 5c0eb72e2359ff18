// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/obstacles/superellipsoid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "swarm_planner/obstacles/closest_point.hpp"
#include "swarm_planner/obstacles/power_sum.hpp"

namespace swarm_planner {

namespace {

/// Largest value of a . y over |y_0|^p + |y_1|^p <= 1: the dual norm of a >= 0.
double support(double a0, double a1, double p) {
  const double largest = std::max(a0, a1);
  const double ratio = std::min(a0, a1) / largest;
  const double q = p / (p - 1.0);
  return largest * std::pow(1.0 + std::pow(ratio, q), 1.0 / q);
}

/// Radius of the smallest sphere around a body with all exponents p (Hoelder's inequality). A body with smaller
/// exponents lies within.
double circumscribedRadius(const Vector3& radii, double p) {
  const double largest = radii.maxCoeff();
  const double q = 2.0 * p / (p - 2.0);  // infinite for p = 2: the largest radius
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += std::pow(radii[i] / largest, q);
  return largest * std::pow(sum, 1.0 / q);
}

}  // namespace

Superellipsoid::Superellipsoid(int id, const Vector3& center, const Vector3& radii, const Vector3& exponents,
                               double yaw, const Vector3& velocity)
    : id_(id),
      center_(center),
      radii_(radii),
      inverse_radii_(radii.cwiseInverse()),
      exponents_(exponents),
      yaw_(yaw),
      cos_yaw_(std::cos(yaw)),
      sin_yaw_(std::sin(yaw)),
      velocity_(velocity) {
  if (!center.allFinite() || !velocity.allFinite() || !std::isfinite(yaw)) {
    throw std::invalid_argument("superellipsoid: centre, velocity and yaw must be finite");
  }
  if (!radii.allFinite() || !inverse_radii_.allFinite() || radii.minCoeff() <= 0.0) {
    throw std::invalid_argument("superellipsoid: radii must be finite and > 0");
  }
  if (!exponents.allFinite() || exponents.minCoeff() < 2.0) {
    throw std::invalid_argument("superellipsoid: exponents must be finite and >= 2");
  }

  bool small_integers = true;
  for (std::size_t i = 0; i < 3; ++i) {
    powers_[i] = Exponent(exponents[static_cast<int>(i)]);
    small_integers = small_integers && powers_[i].isSmallInteger();
  }
  const bool equal = exponents.minCoeff() == exponents.maxCoeff();
  shape_ = equal && exponents[0] == 2.0 ? Shape::kEllipsoid
           : equal                      ? Shape::kEqualExponents
           : small_integers             ? Shape::kSmallIntegers
                                        : Shape::kGeneral;

  const double horizontal = std::max(exponents.x(), exponents.y());
  const double c = std::abs(cos_yaw_);
  const double s = std::abs(sin_yaw_);
  half_extents_ = Vector3(support(c * radii.x(), s * radii.y(), horizontal),
                          support(s * radii.x(), c * radii.y(), horizontal), radii.z());
  bounding_radius_ = circumscribedRadius(radii, exponents.maxCoeff());
}

Superellipsoid Superellipsoid::movedBy(double dt) const {
  Superellipsoid moved = *this;
  moved.center_ += dt * velocity_;
  return moved;
}

Superellipsoid Superellipsoid::atLevel(double level) const {
  Vector3 radii = radii_;
  for (int axis = 0; axis < 3; ++axis) radii[axis] *= std::pow(level, 1.0 / exponents_[axis]);
  return Superellipsoid(id_, center_, radii, exponents_, yaw_, velocity_);
}

Superellipsoid Superellipsoid::grownBy(double distance) const {
  return Superellipsoid(id_, center_, radii_ + Vector3::Constant(distance), exponents_, yaw_, velocity_);
}

Vector3 Superellipsoid::toBody(const Vector3& u) const {
  return Vector3(cos_yaw_ * u.x() + sin_yaw_ * u.y(), cos_yaw_ * u.y() - sin_yaw_ * u.x(), u.z());
}

Vector3 Superellipsoid::toWorld(const Vector3& u) const {
  return Vector3(cos_yaw_ * u.x() - sin_yaw_ * u.y(), sin_yaw_ * u.x() + cos_yaw_ * u.y(), u.z());
}

double Superellipsoid::sum(const Vector3& u) const {
  const Vector3 x = toBody(u).cwiseAbs().cwiseProduct(inverse_radii_);
  return powers_[0].power(x[0]) + powers_[1].power(x[1]) + powers_[2].power(x[2]);
}

double Superellipsoid::sum(const Vector3& u, Vector3& gradient, Matrix3& hessian) const {
  const Vector3 x = toBody(u).cwiseProduct(inverse_radii_);
  double value = 0.0;
  Vector3 first;
  Vector3 second;  // the Hessian is diagonal in the body frame
  for (int i = 0; i < 3; ++i) {
    const Exponent& power = powers_[static_cast<std::size_t>(i)];
    const double p = power.value();
    const double lowered = power.power(std::abs(x[i]), 2);
    value += lowered * x[i] * x[i];
    first[i] = p * lowered * x[i] * inverse_radii_[i];
    second[i] = p * (p - 1.0) * lowered * inverse_radii_[i] * inverse_radii_[i];
  }
  gradient = toWorld(first);
  const double c = cos_yaw_;
  const double s = sin_yaw_;
  hessian.setZero();
  hessian(0, 0) = c * c * second[0] + s * s * second[1];
  hessian(1, 1) = s * s * second[0] + c * c * second[1];
  hessian(0, 1) = hessian(1, 0) = c * s * (second[0] - second[1]);
  hessian(2, 2) = second[2];
  return value;
}

Gauge Superellipsoid::gauge(const Vector3& u, double level) const {
  Gauge gauge = bodyGauge(toBody(u), level);
  gauge.gradient = toWorld(gauge.gradient);
  return gauge;
}

Gauge Superellipsoid::gaugeAtCenter(double level) const {
  int shortest = 0;
  radii_.minCoeff(&shortest);
  Gauge gauge;
  gauge.gradient[shortest] = inverse_radii_[shortest] * std::pow(level, -1.0 / exponents_[shortest]);
  return gauge;
}

Gauge Superellipsoid::ellipsoidGauge(const Vector3& body, double squared_norm, double level) const {
  Gauge gauge;
  gauge.value = std::sqrt(squared_norm / level);
  gauge.gradient = body.cwiseProduct(inverse_radii_).cwiseProduct(inverse_radii_) / (gauge.value * level);
  return gauge;
}

Gauge Superellipsoid::bodyGauge(const Vector3& body, double level) const {
  const Vector3 x = body.cwiseAbs().cwiseProduct(inverse_radii_);
  if (shape_ == Shape::kEllipsoid) {
    constexpr double kUnderflow = 1e-200;  // below it squares lose digits
    const double squared_norm = x.squaredNorm();
    if (squared_norm > kUnderflow) return ellipsoidGauge(body, squared_norm, level);
  }

  // Scaled by the largest coordinate no power overflows, however far the point.
  int largest = 0;
  const double scale = x.maxCoeff(&largest);
  if (scale == 0.0) return gaugeAtCenter(level);
  const Vector3 y = x / scale;

  // v = scale / phi solves sum (y_i v)^p_i = level.
  double v = 0.0;
  std::array<double, 3> terms;
  if (shape_ == Shape::kGeneral) {
    const double log_level = std::log(level);
    const LogPowerSum<3> root =
        solveLogPowerSum<3>({exponents_[0] * std::log(y[0]) - log_level, exponents_[1] * std::log(y[1]) - log_level,
                             exponents_[2] * std::log(y[2]) - log_level},
                            {exponents_[0], exponents_[1], exponents_[2]});
    v = std::exp(root.sigma);
    terms = root.terms;
  } else {
    for (std::size_t i = 0; i < 3; ++i) terms[i] = powers_[i].power(y[static_cast<int>(i)]);
    if (shape_ == Shape::kSmallIntegers) {
      v = solveIntegerPowerSum(terms, powers_, static_cast<std::size_t>(largest), level);
      for (std::size_t i = 0; i < 3; ++i) terms[i] *= powers_[i].power(v);
    } else {
      v = powers_[0].root(level / (terms[0] + terms[1] + terms[2]));
    }
  }

  // Implicit function theorem, with the terms t_i of the sum at the surface up to a common factor:
  // dphi/du_i = phi (p_i t_i / u_i) / sum_j p_j t_j.
  Gauge gauge;
  gauge.value = scale / v;
  const double weight = gauge.value / (exponents_[0] * terms[0] + exponents_[1] * terms[1] + exponents_[2] * terms[2]);
  for (int i = 0; i < 3; ++i) {
    // Exponents >= 2: an axis without offset has no slope.
    gauge.gradient[i] = body[i] == 0.0 ? 0.0 : weight * exponents_[i] * (terms[static_cast<std::size_t>(i)] / body[i]);
  }
  return gauge;
}

double Superellipsoid::signedDistance(const Vector3& point) const {
  Vector3 normal;
  return signedDistance(point, normal);
}

double Superellipsoid::signedDistance(const Vector3& point, Vector3& normal) const {
  const Vector3 body = toBody(point - center_);
  const Gauge gauge = bodyGauge(body, 1.0);
  const double to_plane = (gauge.value - 1.0) / gauge.gradient.norm();
  // So near the surface, and inside, the supporting plane is the surface.
  constexpr double kNear = 1e-9;
  if (gauge.value < 1.0 + kNear) {
    normal = toWorld(gauge.gradient).normalized();
    return to_plane;
  }
  Vector3 offset;
  const double distance = bodyDistance(body, radii_, exponents_, gauge, offset);
  normal = toWorld(offset).normalized();
  return distance;
}

double Superellipsoid::distanceLowerBound(const Vector3& point) const {
  return ((point - center_).cwiseAbs() - half_extents_).cwiseMax(0.0).norm();
}

}  // namespace swarm_planner
