// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/recorded_problems.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace swarm_planner {
namespace {

using recorded::kTimeStep;

class FileReader {
 public:
  explicit FileReader(const std::string& path) : path_(path), stream_(path, std::ios::binary) {
    if (!stream_) throw std::runtime_error(path + ": cannot be read");
  }

  template <typename T>
  std::vector<T> read(int count) {
    std::vector<T> values(static_cast<std::size_t>(count));
    stream_.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
    if (!stream_) throw std::runtime_error(path_ + ": ends too early");
    return values;
  }

 private:
  std::string path_;
  std::ifstream stream_;
};

RecordedProblem readProblem(FileReader& in, int n, int m) {
  RecordedProblem p;
  p.p0 = in.read<float>(3);
  p.v0 = in.read<float>(3);
  p.a_previous = in.read<float>(3);
  p.p_ref = in.read<float>(3 * n);
  p.v_ref = in.read<float>(3 * n);
  p.normal = in.read<float>(3 * n * m);
  p.offset = in.read<float>(n * m);
  p.thrust_normal = in.read<float>(3 * n);
  p.thrust_offset = in.read<float>(n);
  p.warm_input = in.read<float>(3 * n);
  p.warm_half_space = in.read<float>(n * m);
  p.warm_velocity = in.read<float>(6 * n);
  p.warm_acceleration = in.read<float>(6 * n);
  p.warm_thrust = in.read<float>(n);
  p.optimal_cost = in.read<double>(1)[0];
  p.optimal_input = in.read<double>(3 * n);
  in.read<double>(1);        // KKT residual of the reference
  in.read<std::int32_t>(5);  // numbers of active rows
  return p;
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Positions and velocities of stages 0..N.
struct States {
  std::vector<double> p, v;
};

States rollOut(int n, const RecordedProblem& problem, const std::vector<double>& a) {
  States s{std::vector<double>(at(3 * n + 3)), std::vector<double>(at(3 * n + 3))};
  for (int i = 0; i < 3; ++i) {
    s.p[at(i)] = static_cast<double>(problem.p0[at(i)]);
    s.v[at(i)] = static_cast<double>(problem.v0[at(i)]);
  }
  for (int i = 0; i < 3 * n; ++i) {
    s.p[at(i + 3)] = s.p[at(i)] + kTimeStep * s.v[at(i)] + 0.5 * kTimeStep * kTimeStep * a[at(i)];
    s.v[at(i + 3)] = s.v[at(i)] + kTimeStep * a[at(i)];
  }
  return s;
}

double dot3(const float* n, const double* y) {
  return static_cast<double>(n[0]) * y[0] + static_cast<double>(n[1]) * y[1] + static_cast<double>(n[2]) * y[2];
}

/// Weights at stage k = 1..N.
double positionWeight(int k, int n) { return k == n ? recorded::kFinalPositionWeight : recorded::kPositionWeight; }
double velocityWeight(int k, int n) { return k == n ? recorded::kFinalVelocityWeight : recorded::kVelocityWeight; }

double previousInput(const RecordedProblem& problem, const std::vector<double>& a, int i) {
  return i < 3 ? static_cast<double>(problem.a_previous[at(i)]) : a[at(i - 3)];
}

/// Gradient of the cost and the rows' forces in the states of stages 1..N, at index 3 k + i.
States stateGradient(const RecordedProblems& file, const RecordedProblem& problem, const States& s,
                     const RecordedMultipliers& lambda) {
  const int n = file.horizon;
  States g{std::vector<double>(s.p.size()), std::vector<double>(s.v.size())};
  for (int k = 1; k <= n; ++k) {
    for (int i = 0; i < 3; ++i) {
      const auto j = at(3 * k + i), r = at(3 * k - 3 + i);
      g.p[j] = positionWeight(k, n) * (s.p[j] - static_cast<double>(problem.p_ref[r]));
      g.v[j] = velocityWeight(k, n) * (s.v[j] - static_cast<double>(problem.v_ref[r]));
      g.v[j] += lambda.velocity[at(6 * (k - 1) + 3 + i)] - lambda.velocity[at(6 * (k - 1) + i)];
    }
    for (int r = (k - 1) * file.rows; r < k * file.rows; ++r) {
      for (int i = 0; i < 3; ++i) {
        g.p[at(3 * k + i)] -= lambda.half_space[at(r)] * static_cast<double>(problem.normal[at(3 * r + i)]);
      }
    }
  }
  return g;
}

/// Largest entry of the Lagrangian's gradient in the controls: an adjoint sweep.
double stationarity(const RecordedProblems& file, const RecordedProblem& problem, const std::vector<double>& a,
                    const RecordedMultipliers& lambda) {
  const int n = file.horizon;
  const States g = stateGradient(file, problem, rollOut(n, problem, a), lambda);
  double worst = 0.0;
  double p[3] = {0.0, 0.0, 0.0}, v[3] = {0.0, 0.0, 0.0};
  for (int k = n - 1; k >= 0; --k) {
    for (int i = 0; i < 3; ++i) {
      const auto j = at(3 * k + i);
      v[i] += kTimeStep * p[i] + g.v[j + 3];  // costate of stage k + 1, velocity before position
      p[i] += g.p[j + 3];
      const double h = 0.5 * kTimeStep * kTimeStep;
      double gradient = h * p[i] + kTimeStep * v[i] + recorded::kInputWeight * a[j];
      gradient += recorded::kRateWeight * (a[j] - previousInput(problem, a, 3 * k + i));
      if (k + 1 < n) gradient -= recorded::kRateWeight * (a[j + 3] - a[j]);
      gradient += lambda.acceleration[at(6 * k + 3 + i)] - lambda.acceleration[at(6 * k + i)];
      gradient += lambda.thrust[at(k)] * static_cast<double>(problem.thrust_normal[j]);
      worst = std::max(worst, std::abs(gradient));
    }
  }
  return worst;
}

/// Hard row value >= 0 with its multiplier.
double hardRow(double value, double lambda) {
  return std::max({-value, -lambda, std::min(std::abs(value), std::abs(lambda))});
}

/// Soft row value + s >= 0: the multiplier is at most rho1 where it holds and rho1 + rho2 s where it does not.
double softRow(double value, double lambda) {
  const double slack = std::max(0.0, (lambda - recorded::kLinearPenalty) / recorded::kQuadraticPenalty);
  return hardRow(value + slack, lambda);
}

}  // namespace

RecordedProblems readRecordedProblems(const std::string& path) {
  FileReader in(path);
  const std::vector<char> magic = in.read<char>(8);
  if (std::memcmp(magic.data(), "QMPCQP01", 8) != 0) throw std::runtime_error(path + ": expected a QMPCQP01 file");
  const std::vector<std::int32_t> header = in.read<std::int32_t>(4);
  RecordedProblems file;
  file.horizon = header[1];
  file.rows = header[2];
  if (header[0] < 0 || header[0] > 1000000 || header[1] < 1 || header[1] > 1000 || header[2] < 0 || header[2] > 10000) {
    throw std::runtime_error(path + ": sizes out of range");
  }
  for (int i = 0; i < header[0]; ++i) file.problems.push_back(readProblem(in, file.horizon, file.rows));
  return file;
}

double recordedCost(const RecordedProblems& file, const RecordedProblem& problem, const std::vector<double>& a) {
  const int n = file.horizon;
  const States s = rollOut(n, problem, a);
  double cost = 0.0;
  for (int k = 1; k <= n; ++k) {
    for (int i = 0; i < 3; ++i) {
      const double dp = s.p[at(3 * k + i)] - static_cast<double>(problem.p_ref[at(3 * k - 3 + i)]);
      const double dv = s.v[at(3 * k + i)] - static_cast<double>(problem.v_ref[at(3 * k - 3 + i)]);
      cost += 0.5 * (positionWeight(k, n) * dp * dp + velocityWeight(k, n) * dv * dv);
    }
    for (int r = (k - 1) * file.rows; r < k * file.rows; ++r) {
      const double value =
          static_cast<double>(problem.offset[at(r)]) - dot3(&problem.normal[at(3 * r)], &s.p[at(3 * k)]);
      const double slack = std::max(0.0, value);
      cost += recorded::kLinearPenalty * slack + 0.5 * recorded::kQuadraticPenalty * slack * slack;
    }
  }
  for (int i = 0; i < 3 * n; ++i) {
    const double rate = a[at(i)] - previousInput(problem, a, i);
    cost += 0.5 * (recorded::kInputWeight * a[at(i)] * a[at(i)] + recorded::kRateWeight * rate * rate);
  }
  return cost;
}

double recordedKktResidual(const RecordedProblems& file, const RecordedProblem& problem, const std::vector<double>& a,
                           const RecordedMultipliers& lambda) {
  const States s = rollOut(file.horizon, problem, a);
  double worst = stationarity(file, problem, a, lambda);
  for (int k = 0; k < file.horizon; ++k) {
    const double thrust = static_cast<double>(problem.thrust_offset[at(k)]);
    worst =
        std::max(worst, hardRow(thrust - dot3(&problem.thrust_normal[at(3 * k)], &a[at(3 * k)]), lambda.thrust[at(k)]));
    for (int i = 0; i < 3; ++i) {
      const double v = s.v[at(3 * k + 3 + i)], limit_v = recorded::kMaxVelocity[i];
      const double input = a[at(3 * k + i)], limit_a = recorded::kMaxAcceleration[i];
      worst = std::max({worst, hardRow(v + limit_v, lambda.velocity[at(6 * k + i)]),
                        hardRow(limit_v - v, lambda.velocity[at(6 * k + 3 + i)]),
                        hardRow(input + limit_a, lambda.acceleration[at(6 * k + i)]),
                        hardRow(limit_a - input, lambda.acceleration[at(6 * k + 3 + i)])});
    }
    for (int r = k * file.rows; r < (k + 1) * file.rows; ++r) {
      const double value =
          dot3(&problem.normal[at(3 * r)], &s.p[at(3 * k + 3)]) - static_cast<double>(problem.offset[at(r)]);
      worst = std::max(worst, softRow(value, lambda.half_space[at(r)]));
    }
  }
  return worst;
}

}  // namespace swarm_planner
