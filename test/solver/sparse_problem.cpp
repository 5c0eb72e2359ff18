// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "solver/sparse_problem.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace swarm_planner {
namespace codegen {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

VectorXd vectorOf(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

std::vector<double> listOf(const VectorXd& v) { return std::vector<double>(v.data(), v.data() + v.size()); }

/// The matrix with `varying` in the places of the entries that vary.
MatrixXd dense(const SparseMatrix& m, const std::vector<double>& varying) {
  MatrixXd result = MatrixXd::Zero(m.rows, m.columns);
  std::size_t next = 0;
  for (const SparseEntry& e : m.entries)
    result(e.row, e.column) = e.datum.varies ? varying[next++] : e.datum.value.value();
  return result;
}

MatrixXd denseHessian(const SparseDescription& d, const std::vector<double>& varying) {
  const MatrixXd lower = dense(d.hessian, varying);
  MatrixXd result = lower + lower.transpose();
  result.diagonal() -= lower.diagonal();
  return result;
}

const Penalty* penaltyOf(const SparseDescription& d, const SparseData& data, int row) {
  const int penalty = data.row_penalty[at(row)];
  return penalty == 0 ? nullptr : &d.penalties[at(penalty - 1)];
}

/// Text of one random sparse problem.
class DescriptionWriter {
 public:
  DescriptionWriter(Random& random, const RandomSparseOptions& options) : random_(random), options_(options) {}

  std::string write(int number) {
    const int n = random_.integer(1, options_.most_variables);
    out_.precision(17);
    out_ << "name: sparse_" << number << "\nvariables: " << n << "\nparameters: {half: 0.5}\nhessian:\n";
    writeHessian(n);
    out_ << "linear: varies\npenalties:\n  light: {linear: 2, quadratic: 10}\n  heavy: {linear: 30, quadratic: 100}\n"
            "  square: {linear: 0, quadratic: 20}\nbounds:\n";
    writeVector("  lower", n);
    writeVector("  upper", n);
    const int equalities = options_.equalities ? random_.integer(0, (n - 1) / 3) : 0;
    if (equalities > 0) {
      out_ << "equalities:\n  balance:\n    rows: " << equalities << "\n    right: varies\n    matrix:\n";
      writeRows(equalities, n);
    }
    const int rows = random_.integer(0, 2 * n);
    if (rows == 0) return out_.str();
    out_ << "inequalities:\n  limits:\n    rows: " << rows << "\n    matrix:\n";
    writeRows(rows, n);
    writeVector("    lower", rows);
    writeVector("    upper", rows);
    out_ << "    penalty: [";
    const char* const names[] = {"hard", "light", "heavy", "square"};
    for (int r = 0; r < rows; ++r) out_ << (r > 0 ? ", " : "") << names[random_.integer(0, 3)];
    out_ << "]\n";
    return out_.str();
  }

 private:
  /// A factor's square of some of the variables, which leaves H singular; or entries that vary, with their diagonal.
  void writeHessian(int n) {
    const int kind = options_.varying ? 1 : random_.integer(0, 2);
    if (kind == 0) {
      writeSquare(n);
    } else if (kind == 1) {
      out_ << "  - {at: [0, 0], size: [" << n << ", " << n << "], diagonals: {0: varies}}\n";
      std::set<std::pair<int, int>> entries;
      for (int k = random_.integer(0, 2 * n); k > 0; --k) {
        const int i = random_.integer(0, n - 1), j = random_.integer(0, n - 1);
        if (i != j && entries.insert({std::max(i, j), std::min(i, j)}).second) {
          out_ << "  - [" << i << ", " << j << ", varies]\n";
        }
      }
    } else {
      out_ << "  - {at: [0, 0], block: [[half * 3]], repeat: " << (n + 1) / 2 << ", step: [1, 1]}\n";
    }
  }

  void writeSquare(int n) {
    const int rank = random_.integer(0, n);
    MatrixXd root = MatrixXd::Zero(rank, n);
    for (int i = 0; i < rank; ++i) {
      for (int k = random_.integer(1, 3); k > 0; --k) root(i, random_.integer(0, n - 1)) = random_.uniform(-1.0, 1.0);
    }
    const MatrixXd square = root.transpose() * root;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j) {
        if (square(i, j) != 0.0) out_ << "  - [" << i << ", " << j << ", " << square(i, j) << "]\n";
      }
    }
    if (square.isZero(0.0)) out_ << "  []\n";
  }

  void writeRows(int rows, int n) {
    for (int r = 0; r < rows; ++r) {
      std::set<int> columns;
      for (int k = random_.integer(1, random_.integer(1, 8)); k > 0; --k) columns.insert(random_.integer(0, n - 1));
      for (const int j : columns) {
        out_ << "      - [" << r << ", " << j << ", ";
        if (options_.varying || random_.integer(0, 2) == 0) {
          out_ << "varies]\n";
        } else {
          out_ << random_.uniform(-1.0, 1.0) << "]\n";
        }
      }
    }
  }

  /// Bounds that vary, and none.
  void writeVector(const char* key, int size) {
    out_ << key << ": [";
    for (int i = 0; i < size; ++i) out_ << (i > 0 ? ", " : "") << (random_.integer(0, 1) == 0 ? "varies" : "none");
    out_ << "]\n";
  }

  Random& random_;
  const RandomSparseOptions& options_;
  std::ostringstream out_;
};

/// Chooses the optimum of one problem.
class ProblemMaker {
 public:
  ProblemMaker(const SparseDescription& d, const KnownSparseOptions& options, Random& random)
      : d_(d), options_(options), random_(random), hard_(d.variables, 0) {}

  KnownSparseProblem make() {
    chooseMatrices();
    x_ = VectorXd::NullaryExpr(d_.variables, [&]() { return random_.uniform(-2.0, 2.0); });
    pull_ = VectorXd::Zero(d_.variables);
    for (int r = 0; r < d_.rows(); ++r) chooseRow(r);
    for (int j = 0; j < d_.variables; ++j) chooseBounds(j);
    p_.data.linear = listOf(pull_ - hessian_ * x_);
    p_.objective = sparseObjective(d_, p_.data, x_);
    scale();
    return p_;
  }

 private:
  void chooseMatrices() {
    for (const SparseEntry& e : d_.matrix.entries) {
      if (e.datum.varies) p_.data.matrix.push_back(random_.uniform(-1.0, 1.0));
    }
    for (const SparseEntry& e : d_.hessian.entries) {
      if (e.datum.varies) p_.data.hessian.push_back(e.row == e.column ? 0.0 : random_.uniform(-1.0, 1.0));
    }
    hessian_ = denseHessian(d_, p_.data.hessian);
    std::size_t next = 0;
    for (const SparseEntry& e : d_.hessian.entries) {
      if (!e.datum.varies) continue;
      // Diagonally dominant, just so or with something to spare: positive semidefinite.
      if (e.row == e.column) {
        p_.data.hessian[next] = hessian_.row(e.row).cwiseAbs().sum() + (random_.integer(0, 2) == 0 ? 1.0 : 0.0);
      }
      ++next;
    }
    hessian_ = denseHessian(d_, p_.data.hessian);
    matrix_ = dense(d_.matrix, p_.data.matrix);
  }

  void chooseRow(int r) {
    const VectorXd gradient = matrix_.row(r).transpose();
    const double value = gradient.dot(x_);
    // Most rows have the description's penalty, some another one or none.
    const bool described = r < d_.equalities || random_.integer(0, 3) > 0;
    const int others = static_cast<int>(d_.penalties.size());
    p_.data.row_penalty.push_back(described ? d_.row_penalty[at(r)] + 1 : random_.integer(0, others));
    if (r < d_.equalities) {
      p_.data.row_lower.push_back(value);
      p_.data.row_upper.push_back(value);
      pull_ += random_.uniform(-2.0, 2.0) * gradient;
      isIndependent(gradient);
      return;
    }
    choose(gradient, value, d_.row_lower[at(r)].varies, d_.row_upper[at(r)].varies, penaltyOf(d_, p_.data, r),
           p_.data.row_lower, p_.data.row_upper);
  }

  void chooseBounds(int j) {
    choose(VectorXd::Unit(d_.variables, j), x_(j), d_.lower[at(j)].varies, d_.upper[at(j)].varies, nullptr,
           p_.data.lower, p_.data.upper);
  }

  /// Bounds around the value, of which one may be active: with a multiplier, and a slack if it is soft.
  void choose(const VectorXd& gradient, double value, bool has_lower, bool has_upper, const Penalty* penalty,
              std::vector<double>& lower, std::vector<double>& upper) {
    lower.push_back(has_lower ? value - random_.uniform(0.1, 3.0) : -kUnbounded);
    upper.push_back(has_upper ? value + random_.uniform(0.1, 3.0) : kUnbounded);
    if (!has_lower && !has_upper) return;
    if (random_.uniform(0.0, 1.0) > options_.active) return;
    if (penalty == nullptr && options_.independent && !isIndependent(gradient)) return;
    double multiplier = random_.uniform(0.1, 3.0), slack = 0.0;
    if (penalty == nullptr && has_lower && has_upper && random_.integer(0, 3) == 0) {
      lower.back() = upper.back() = value;
      pull_ += (random_.integer(0, 1) == 0 ? multiplier : -multiplier) * gradient;
      return;
    }
    if (penalty != nullptr) {
      multiplier = penalty->linear.value() * random_.uniform(0.05, 0.95);
      if (random_.integer(0, 1) == 0) {
        slack = random_.uniform(0.01, 0.5);
        multiplier = penalty->linear.value() + penalty->quadratic.value() * slack;
      }
    }
    if (has_lower && (!has_upper || random_.integer(0, 1) == 0)) {
      lower.back() = value + slack;
      if (has_upper) upper.back() = lower.back() + random_.uniform(0.1, 3.0);
      pull_ += multiplier * gradient;
    } else {
      upper.back() = value - slack;
      if (has_lower) lower.back() = upper.back() - random_.uniform(0.1, 3.0);
      pull_ -= multiplier * gradient;
    }
  }

  /// Adds the direction to those of the hard active rows if it does not depend on them.
  bool isIndependent(const VectorXd& gradient) {
    VectorXd rest = gradient.normalized();
    for (int sweep = 0; sweep < 2; ++sweep) rest -= hard_ * (hard_.transpose() * rest);
    if (!(rest.norm() > 0.05)) return false;
    hard_.conservativeResize(gradient.size(), hard_.cols() + 1);
    hard_.rightCols(1) = rest.normalized();
    return true;
  }

  void scale() {
    p_.variable_scale = VectorXd::Ones(d_.variables);
    p_.row_scale = VectorXd::Ones(d_.rows());
    if (options_.scales == 1.0) return;
    const double most = options_.scales;
    for (double& scale : p_.variable_scale) scale = random_.logUniform(1.0 / most, most);
    for (int r = 0; r < d_.rows(); ++r) {
      if (p_.data.row_penalty[at(r)] == 0) p_.row_scale(r) = random_.logUniform(1.0 / most, most);
    }
    std::size_t next = 0;
    for (const SparseEntry& e : d_.hessian.entries) {
      if (e.datum.varies) p_.data.hessian[next++] /= p_.variable_scale(e.row) * p_.variable_scale(e.column);
    }
    next = 0;
    for (const SparseEntry& e : d_.matrix.entries) {
      if (e.datum.varies) p_.data.matrix[next++] *= p_.row_scale(e.row) / p_.variable_scale(e.column);
    }
    const auto times = [](double bound, double factor) {
      return std::abs(bound) < kUnbounded ? bound * factor : bound;
    };
    for (int j = 0; j < d_.variables; ++j) {
      p_.data.linear[at(j)] /= p_.variable_scale(j);
      p_.data.lower[at(j)] = times(p_.data.lower[at(j)], p_.variable_scale(j));
      p_.data.upper[at(j)] = times(p_.data.upper[at(j)], p_.variable_scale(j));
    }
    for (int r = 0; r < d_.rows(); ++r) {
      p_.data.row_lower[at(r)] = times(p_.data.row_lower[at(r)], p_.row_scale(r));
      p_.data.row_upper[at(r)] = times(p_.data.row_upper[at(r)], p_.row_scale(r));
    }
  }

  const SparseDescription& d_;
  const KnownSparseOptions& options_;
  Random& random_;
  KnownSparseProblem p_;
  MatrixXd hessian_, matrix_;
  MatrixXd hard_;  ///< orthonormal basis of the hard active rows' gradients
  VectorXd x_, pull_;
};

/// Violation of bounds, and multipliers that push the wrong way or without contact, as a share of `size`.
double boundError(double value, double lower, double upper, double multiplier, double scale, double size) {
  double error = std::max({0.0, lower - value, value - upper}) / scale / (1.0 + std::abs(value / scale));
  const double room = multiplier > 0.0 ? value - lower : upper - value;
  error = std::max(error, std::abs(multiplier) * std::max(room, 0.0) / size);
  return error;
}

}  // namespace

std::string randomSparseDescription(Random& random, int number, const RandomSparseOptions& options) {
  return DescriptionWriter(random, options).write(number);
}

KnownSparseProblem makeKnownSparseProblem(const SparseDescription& d, const KnownSparseOptions& options,
                                          Random& random) {
  return ProblemMaker(d, options, random).make();
}

double sparseObjective(const SparseDescription& d, const SparseData& data, const VectorXd& x) {
  double sum = 0.5 * x.dot(denseHessian(d, data.hessian) * x) + vectorOf(data.linear).dot(x);
  const VectorXd values = dense(d.matrix, data.matrix) * x;
  for (int r = d.equalities; r < d.rows(); ++r) {
    const Penalty* penalty = penaltyOf(d, data, r);
    const double slack = std::max({0.0, data.row_lower[at(r)] - values(r), values(r) - data.row_upper[at(r)]});
    if (penalty != nullptr) sum += slack * (penalty->linear.value() + 0.5 * penalty->quadratic.value() * slack);
  }
  return sum;
}

double optimalityError(const SparseDescription& d, const KnownSparseProblem& p, const SparseAnswer& answer) {
  const VectorXd x = vectorOf(answer.x), y = vectorOf(answer.row_multiplier), z = vectorOf(answer.bound_multiplier);
  const MatrixXd matrix = dense(d.matrix, p.data.matrix);
  const VectorXd slope = denseHessian(d, p.data.hessian) * x + vectorOf(p.data.linear);
  const VectorXd scaled_slope = slope.cwiseProduct(p.variable_scale);
  const VectorXd rest = (slope - matrix.transpose() * y - z).cwiseProduct(p.variable_scale);
  const double size = 1.0 + std::abs(p.objective);
  double error = rest.lpNorm<Eigen::Infinity>() / (1.0 + scaled_slope.lpNorm<Eigen::Infinity>());
  error = std::max(error, std::abs(sparseObjective(d, p.data, x) - p.objective) / size);
  error = std::max(error, std::abs(answer.objective - p.objective) / size);
  const VectorXd values = matrix * x;
  for (int r = 0; r < d.rows(); ++r) {
    if (p.data.row_penalty[at(r)] > 0) continue;
    error = std::max(error, boundError(values(r), p.data.row_lower[at(r)], p.data.row_upper[at(r)],
                                       r < d.equalities ? 0.0 : y(r), p.row_scale(r), size));
  }
  for (int j = 0; j < d.variables; ++j) {
    error =
        std::max(error, boundError(x(j), p.data.lower[at(j)], p.data.upper[at(j)], z(j), p.variable_scale(j), size));
  }
  return error;
}

}  // namespace codegen
}  // namespace swarm_planner
