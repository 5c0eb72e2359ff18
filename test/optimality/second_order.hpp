// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace swarm_planner {

/// A function of N variables at a point, with exact gradient and Hessian: automatic differentiation, forward.
template <int N>
struct SecondOrder {
  using Gradient = Eigen::Matrix<double, N, 1>;
  using Hessian = Eigen::Matrix<double, N, N>;

  double value = 0.0;
  Gradient gradient = Gradient::Zero();
  Hessian hessian = Hessian::Zero();

  SecondOrder() = default;
  SecondOrder(double constant) : value(constant) {}  // NOLINT: constants mix with variables
  /// Variable `index` at `x`.
  SecondOrder(double x, int index) : value(x) { gradient[index] = 1.0; }

  /// f(this) from f and its two derivatives at the value.
  SecondOrder chain(double f, double first, double second) const {
    SecondOrder result(f);
    result.gradient = first * gradient;
    result.hessian = first * hessian + second * gradient * gradient.transpose();
    return result;
  }
  SecondOrder operator-() const { return chain(-value, -1.0, 0.0); }
};

template <int N>
SecondOrder<N> operator+(const SecondOrder<N>& a, const SecondOrder<N>& b) {
  SecondOrder<N> sum(a.value + b.value);
  sum.gradient = a.gradient + b.gradient;
  sum.hessian = a.hessian + b.hessian;
  return sum;
}

template <int N>
SecondOrder<N> operator-(const SecondOrder<N>& a, const SecondOrder<N>& b) {
  return a + (-b);
}

template <int N>
SecondOrder<N> operator*(const SecondOrder<N>& a, const SecondOrder<N>& b) {
  SecondOrder<N> product(a.value * b.value);
  product.gradient = a.value * b.gradient + b.value * a.gradient;
  product.hessian = a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() +
                    b.gradient * a.gradient.transpose();
  return product;
}

template <int N>
SecondOrder<N> operator*(double factor, const SecondOrder<N>& x) {
  return x.chain(factor * x.value, factor, 0.0);
}

template <int N>
SecondOrder<N> inverse(const SecondOrder<N>& x) {
  const double y = 1.0 / x.value;
  return x.chain(y, -y * y, 2.0 * y * y * y);
}

template <int N>
SecondOrder<N> squareRoot(const SecondOrder<N>& x) {
  const double y = std::sqrt(x.value);
  return x.chain(y, 0.5 / y, -0.25 / (y * x.value));
}

template <int N>
SecondOrder<N> logarithm(const SecondOrder<N>& x) {
  return x.chain(std::log(x.value), 1.0 / x.value, -1.0 / (x.value * x.value));
}

template <int N>
SecondOrder<N> exponential(const SecondOrder<N>& x) {
  const double y = std::exp(x.value);
  return x.chain(y, y, y);
}

/// |x|^p, p >= 2.
template <int N>
SecondOrder<N> power(const SecondOrder<N>& x, double p) {
  const double size = std::abs(x.value);
  const double sign = x.value < 0.0 ? -1.0 : 1.0;
  return x.chain(std::pow(size, p), sign * p * std::pow(size, p - 1.0), p * (p - 1.0) * std::pow(size, p - 2.0));
}

/// sgn(x) |x|^q, q >= 1; where q < 2 the second derivative has a pole at 0, which is cut off.
template <int N>
SecondOrder<N> signedPower(const SecondOrder<N>& x, double q) {
  const double size = std::abs(x.value);
  const double sign = x.value < 0.0 ? -1.0 : 1.0;
  const double second = q == 1.0 ? 0.0 : sign * q * (q - 1.0) * std::pow(std::max(size, 1e-3), q - 2.0);
  return x.chain(sign * std::pow(size, q), q * std::pow(size, q - 1.0), second);
}

}  // namespace swarm_planner
