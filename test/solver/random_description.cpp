// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "solver/random_description.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <sstream>

namespace swarm_planner {
namespace codegen {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd numbers(const ExpressionMatrix& m) {
  MatrixXd result(m.rows, m.columns);
  for (int i = 0; i < m.rows; ++i) {
    for (int j = 0; j < m.columns; ++j) result(i, j) = m(i, j).value();
  }
  return result;
}

std::string text(const MatrixXd& m) {
  std::ostringstream out;
  out.precision(17);
  out << "[";
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    out << (i > 0 ? ", [" : "[");
    for (Eigen::Index j = 0; j < m.cols(); ++j) out << (j > 0 ? ", " : "") << m(i, j);
    out << "]";
  }
  out << "]";
  return out.str();
}

/// Entries in [-size, size], each with the given probability.
MatrixXd sparse(Random& random, int rows, int columns, double density, double size) {
  MatrixXd m = MatrixXd::Zero(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (random.uniform(0.0, 1.0) < density) m(i, j) = random.uniform(-size, size);
    }
  }
  return m;
}

MatrixXd semidefinite(Random& random, int size, double density) {
  const MatrixXd root = sparse(random, size, size, density, 1.0);
  return root * root.transpose();
}

MatrixXd kroneckerWithIdentity(const MatrixXd& m, int copies) {
  MatrixXd result = MatrixXd::Zero(m.rows() * copies, m.cols() * copies);
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      for (int l = 0; l < copies; ++l) result(i * copies + l, j * copies + l) = m(i, j);
    }
  }
  return result;
}

/// One row of an output at a stage, as a linear function of all inputs: value = gain u + constant.
struct Functional {
  VectorXd gain;
  double constant;
};

/// All stages at once: x_k = free_k + gain_k u.
class Prediction {
 public:
  Prediction(const Description& d, const VectorXd& x0) : d_(d) {
    const MatrixXd a = numbers(d.a), b = numbers(d.b);
    gain_.push_back(MatrixXd::Zero(d.states, d.horizon * d.inputs));
    free_.push_back(x0);
    for (int k = 0; k < d.horizon; ++k) {
      gain_.push_back(a * gain_.back());
      gain_.back().middleCols(k * d.inputs, d.inputs) += b;
      free_.push_back(a * free_.back());
    }
  }

  const MatrixXd& gain(int k) const { return gain_[static_cast<std::size_t>(k)]; }
  VectorXd state(int k, const VectorXd& u) const { return free_[static_cast<std::size_t>(k)] + gain(k) * u; }

  Functional functional(int output, int stage, const VectorXd& normal) const {
    const Output& o = d_.outputs[static_cast<std::size_t>(output)];
    const VectorXd of_state = numbers(o.state).transpose() * normal.head(o.size());
    Functional f{gain(stage).transpose() * of_state, of_state.dot(free_[static_cast<std::size_t>(stage)])};
    if (stage < d_.horizon) {
      f.gain.segment(stage * d_.inputs, d_.inputs) += numbers(o.input).transpose() * normal.head(o.size());
    }
    return f;
  }

 private:
  const Description& d_;
  std::vector<MatrixXd> gain_;
  std::vector<VectorXd> free_;
};

/// Gradient of the cost without linear terms in the inputs.
VectorXd costGradient(const Description& d, const Prediction& prediction, const VectorXd& u, const VectorXd& previous) {
  VectorXd gradient = VectorXd::Zero(u.size());
  const MatrixXd stage = numbers(d.stage_cost), terminal = numbers(d.terminal_cost), input = numbers(d.input_cost);
  for (int k = 1; k <= d.horizon; ++k) {
    const VectorXd slope = (k == d.horizon ? terminal : stage) * prediction.state(k, u);
    gradient += prediction.gain(k).transpose() * slope;
  }
  for (int k = 0; k < d.horizon; ++k) {
    const VectorXd own = u.segment(k * d.inputs, d.inputs);
    gradient.segment(k * d.inputs, d.inputs) += input * own;
    if (d.rate_cost.empty()) continue;
    const VectorXd before = k == 0 ? previous : VectorXd(u.segment((k - 1) * d.inputs, d.inputs));
    const VectorXd slope = numbers(d.rate_cost) * (own - before);
    gradient.segment(k * d.inputs, d.inputs) += slope;
    if (k > 0) gradient.segment((k - 1) * d.inputs, d.inputs) -= slope;
  }
  return gradient;
}

std::vector<double> list(const VectorXd& v) { return std::vector<double>(v.data(), v.data() + v.size()); }

/// Chooses rows one by one and keeps what their multipliers exert.
class RowMaker {
 public:
  RowMaker(const Description& d, const Prediction& prediction, const VectorXd& u, const KnownProblemOptions& options,
           Random& random)
      : d_(d),
        prediction_(prediction),
        u_(u),
        options_(options),
        random_(random),
        force_(VectorXd::Zero(u.size())),
        hard_(u.size(), 0) {
    for (const Output& output : d.outputs) components_ = std::max(components_, output.size());
    used_.assign(d.outputs.size(), std::vector<int>(static_cast<std::size_t>(d.horizon + 1), 0));
  }

  void add(bool active) {
    ProblemData::Row row;
    row.output = random_.integer(0, static_cast<int>(d_.outputs.size()) - 1);
    const Output& output = d_.outputs[static_cast<std::size_t>(row.output)];
    row.stage = random_.integer(output.touchesInput() ? 0 : 1, output.touchesInput() ? d_.horizon - 1 : d_.horizon);
    row.penalty = random_.integer(0, static_cast<int>(d_.penalties.size()));
    VectorXd normal = VectorXd::Zero(components_);
    for (int i = 0; i < output.size(); ++i) normal(i) = options_.row_scale * random_.uniform(-1.0, 1.0);
    const Functional f = prediction_.functional(row.output, row.stage, normal);
    const double value = f.gain.dot(u_) + f.constant;
    row.normal = list(normal);
    row.offset = value - options_.row_scale * random_.uniform(0.1, 3.0);
    const bool is_active = active && activate(row, f, value);
    if (!put(row) || !is_active || !options_.duplicates) return;
    put(row);
    row.offset = -row.offset - options_.row_scale;
    for (double& n : row.normal) n = -n;
    if (row.penalty == 0) put(row);
  }

  /// A term of the cost; what it exerts at the optimum joins the rows'.
  ProblemData::Quadratic quadratic() {
    ProblemData::Quadratic term;
    term.output = random_.integer(0, static_cast<int>(d_.outputs.size()) - 1);
    const Output& output = d_.outputs[static_cast<std::size_t>(term.output)];
    term.stage = random_.integer(output.touchesInput() ? 0 : 1, output.touchesInput() ? d_.horizon - 1 : d_.horizon);
    VectorXd normal = VectorXd::Zero(components_);
    for (int i = 0; i < output.size(); ++i) normal(i) = random_.uniform(-1.0, 1.0);
    const Functional f = prediction_.functional(term.output, term.stage, normal);
    term.normal = list(normal);
    term.offset = random_.uniform(-1.0, 1.0);
    term.weight = random_.logUniform(1e-3, 1e3);
    force_ -= term.weight * (f.gain.dot(u_) + f.constant - term.offset) * f.gain;
    return term;
  }

  const VectorXd& force() const { return force_; }
  const std::vector<ProblemData::Row>& rows() const { return rows_; }

 private:
  bool put(const ProblemData::Row& row) {
    const Output& output = d_.outputs[static_cast<std::size_t>(row.output)];
    int& used = used_[static_cast<std::size_t>(row.output)][static_cast<std::size_t>(row.stage)];
    if (used == output.max_rows) return false;
    ++used;
    rows_.push_back(row);
    return true;
  }

  /// Hard: any multiplier. Soft: within the linear part, or beyond with the slack that belongs to it. Two equal rows
  /// share a multiplier in the linear part, and have the same one each beyond.
  bool activate(ProblemData::Row& row, const Functional& f, double value) {
    const Output& output = d_.outputs[static_cast<std::size_t>(row.output)];
    const int copies = options_.duplicates ? 2 : 1;
    if (used_[static_cast<std::size_t>(row.output)][static_cast<std::size_t>(row.stage)] + copies > output.max_rows)
      return false;
    if (row.penalty == 0 && options_.independent && !isIndependent(f.gain)) return false;
    double multiplier = random_.uniform(0.1, 5.0) / options_.row_scale;
    row.offset = value;
    if (row.penalty > 0) {
      const Penalty& penalty = d_.penalties[static_cast<std::size_t>(row.penalty - 1)];
      multiplier = copies * penalty.linear.value() * random_.uniform(0.05, 0.95);
      if (random_.integer(0, 2) == 0) {
        const double slack = options_.row_scale * random_.uniform(0.01, 0.5);
        multiplier = copies * (penalty.linear.value() + penalty.quadratic.value() * slack);
        row.offset = value + slack;
      }
    }
    force_ += multiplier * f.gain;
    return true;
  }

  /// Adds the direction to those of the hard active rows if it does not depend on them.
  bool isIndependent(const VectorXd& gain) {
    VectorXd rest = gain.normalized();
    for (int sweep = 0; sweep < 2; ++sweep) rest -= hard_ * (hard_.transpose() * rest);
    if (rest.norm() < 0.05) return false;
    hard_.conservativeResize(gain.size(), hard_.cols() + 1);
    hard_.rightCols(1) = rest.normalized();
    return true;
  }

  const Description& d_;
  const Prediction& prediction_;
  const VectorXd& u_;
  const KnownProblemOptions& options_;
  Random& random_;
  VectorXd force_;
  MatrixXd hard_;  ///< orthonormal basis of the hard active rows' gradients
  std::vector<ProblemData::Row> rows_;
  std::vector<std::vector<int>> used_;
  int components_ = 0;
};

}  // namespace

std::string randomDescription(Random& random, int number, double row_scale) {
  const int kind = random.integer(0, 2);  // dense, sparse, Kronecker
  const int copies = kind == 2 ? random.integer(2, 4) : 1;
  const int states = random.integer(1, kind == 2 ? 3 : 5), inputs = random.integer(1, kind == 2 ? 1 : 3);
  const double density = kind == 0 ? 1.0 : 0.4;
  const auto spread = [&](const MatrixXd& m) { return kroneckerWithIdentity(m, copies); };
  MatrixXd a = sparse(random, states, states, density, 0.3) + MatrixXd::Identity(states, states);
  const MatrixXd b = sparse(random, states, inputs, std::max(density, 0.6), 1.0);
  std::ostringstream out;
  out << "name: random_" << number << "\nhorizon: " << random.integer(1, 14) << "\nstates: " << states * copies
      << "\ninputs: " << inputs * copies << "\ndynamics: {A: " << text(spread(a)) << ", B: " << text(spread(b))
      << "}\ncost:\n  state: " << text(spread(semidefinite(random, states, density)))
      << "\n  terminal: " << text(spread(semidefinite(random, states, density)))
      << "\n  input: " << text(spread(semidefinite(random, inputs, density) + 0.5 * MatrixXd::Identity(inputs, inputs)))
      << "\n  input_linear: true\n";
  if (random.integer(0, 1) == 1) out << "  rate: " << text(spread(semidefinite(random, inputs, 1.0))) << "\n";
  const double square = row_scale * row_scale;
  out << "penalties:\n  light: {linear: " << 2.0 / row_scale << ", quadratic: " << 10.0 / square
      << "}\n  heavy: {linear: " << 30.0 / row_scale << ", quadratic: " << 100.0 / square << "}\noutputs:\n";
  const int outputs = random.integer(1, 3);
  for (int o = 0; o < outputs; ++o) {
    const int rows = random.integer(1, 2);
    MatrixXd c = sparse(random, rows, states, 0.7, 1.0);
    c.col(0).setOnes();
    out << "  y" << o << ":\n    state: " << text(spread(c)) << "\n";
    if (random.integer(0, 1) == 1) out << "    input: " << text(spread(sparse(random, rows, inputs, 0.5, 1.0))) << "\n";
    out << "    rows: {most_per_stage: " << random.integer(2, 20) << "}\n";
  }
  out << "limits: {active: " << random.integer(20, 40) << ", changes: 400, quadratic_terms: 4}\n";
  return out.str();
}

KnownProblem makeKnownProblem(const Description& d, const KnownProblemOptions& options, Random& random) {
  const auto vector = [&](int size) {
    VectorXd v(size);
    for (int i = 0; i < size; ++i) v(i) = random.uniform(-1.0, 1.0);
    return v;
  };
  const VectorXd x0 = vector(d.states), previous = vector(d.inputs), u = vector(d.horizon * d.inputs);
  const VectorXd state_linear = vector(d.horizon * d.states);
  const Prediction prediction(d, x0);
  RowMaker rows(d, prediction, u, options, random);
  for (int i = 0; i < options.active; ++i) rows.add(true);
  for (int i = 0; i < options.inactive; ++i) rows.add(false);
  KnownProblem problem;
  for (int i = 0; i < options.quadratics; ++i) problem.data.quadratics.push_back(rows.quadratic());
  VectorXd gradient = costGradient(d, prediction, u, previous) - rows.force();
  for (int k = 1; k <= d.horizon; ++k) {
    gradient += prediction.gain(k).transpose() * state_linear.segment((k - 1) * d.states, d.states);
  }
  problem.data.x0 = list(x0);
  problem.data.u_previous = list(previous);
  problem.data.state_linear = list(state_linear);
  problem.data.input_linear = list(-gradient);
  problem.data.rows = rows.rows();
  problem.u = list(u);
  return problem;
}

}  // namespace codegen
}  // namespace swarm_planner
