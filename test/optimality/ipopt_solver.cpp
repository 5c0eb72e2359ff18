// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "optimality/ipopt_solver.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>

namespace swarm_planner {
namespace {

using Ipopt::Index;
using Ipopt::Number;
using Row = ReferenceProgram::Row;

constexpr int kInputs = ReferenceProgram::kInputs;
constexpr double kInfinity = 1e20;  // as Ipopt has it

/// Entries of a sparse matrix in the one order in which Ipopt asks for their places first, with no `values`, and for
/// the values then.
class Entries {
 public:
  Entries(Index* rows, Index* columns, Number* values) : rows_(rows), columns_(columns), values_(values) {}

  void operator()(Index row, Index column, double value) {
    if (values_ != nullptr) {
      values_[place_] = value;
    } else {
      rows_[place_] = row;
      columns_[place_] = column;
    }
    ++place_;
  }

 private:
  Index* rows_;
  Index* columns_;
  Number* values_;
  Index place_ = 0;
};

/// Every row has all jerks, its slack and its plane's point; the Hessian all pairs of jerks, of a plane's point with
/// itself and with the jerks, and the slacks' diagonal.
class Adapter : public Ipopt::TNLP {
 public:
  Adapter(const ReferenceProgram& program, Eigen::VectorXd start, ReferenceOptimum& optimum)
      : program_(program), start_(std::move(start)), optimum_(optimum) {}

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = program_.variableCount();
    m = static_cast<Index>(program_.rows().size());
    jacobian = 0;
    for (const Row& row : program_.rows()) jacobian += kInputs + (row.slack >= 0 ? 1 : 0) + (row.plane >= 0 ? 3 : 0);
    hessian = kInputs * (kInputs + 1) / 2 + program_.slackCount() + program_.planeCount() * (3 * kInputs + 6);
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* row_lower, Number* row_upper) override {
    for (Index i = 0; i < n; ++i) {
      const bool is_slack = i >= kInputs && i < kInputs + program_.slackCount();
      lower[i] = is_slack ? 0.0 : -kInfinity;
      upper[i] = kInfinity;
    }
    for (Index i = 0; i < m; ++i) {
      row_lower[i] = 0.0;
      row_upper[i] = program_.rows()[static_cast<std::size_t>(i)].slack >= 0 ? kInfinity : 0.0;
    }
    return true;
  }

  bool get_starting_point(Index n, bool, Number* z, bool, Number*, Number*, Index, bool, Number*) override {
    Eigen::Map<Eigen::VectorXd>(z, n) = start_;
    return true;
  }

  bool eval_f(Index n, const Number* z, bool, Number& value) override {
    value = program_.objective(at(z, n));
    return std::isfinite(value);
  }

  bool eval_grad_f(Index n, const Number* z, bool, Number* gradient) override {
    Eigen::Map<Eigen::VectorXd>(gradient, n) = program_.gradient(at(z, n));
    return true;
  }

  bool eval_g(Index n, const Number* z, bool, Index m, Number* values) override {
    const Eigen::VectorXd x = at(z, n);
    for (Index i = 0; i < m; ++i) {
      const Row& row = program_.rows()[static_cast<std::size_t>(i)];
      values[i] = program_.value(row, x).value + (row.slack >= 0 ? x[program_.slackIndex(row.slack)] : 0.0);
      if (!std::isfinite(values[i])) return false;
    }
    return true;
  }

  bool eval_jac_g(Index n, const Number* z, bool, Index m, Index, Index* rows, Index* columns,
                  Number* values) override {
    Entries set(rows, columns, values);
    const Eigen::VectorXd x = values != nullptr ? at(z, n) : Eigen::VectorXd();
    for (Index i = 0; i < m; ++i) {
      const Row& row = program_.rows()[static_cast<std::size_t>(i)];
      Eigen::Matrix<double, 1, kInputs> inputs = Eigen::Matrix<double, 1, kInputs>::Zero();
      Vector3 point = Vector3::Zero();
      if (values != nullptr) {
        const ReferenceProgram::Local local = program_.value(row, x);
        inputs = local.gradient.head<3>().transpose() * program_.output(row).gains;
        point = local.gradient.tail<3>();
      }
      for (Index j = 0; j < kInputs; ++j) set(i, j, inputs[j]);
      if (row.slack >= 0) set(i, program_.slackIndex(row.slack), 1.0);
      for (Index j = 0; row.plane >= 0 && j < 3; ++j) set(i, program_.planeIndex(row.plane) + j, point[j]);
    }
    return true;
  }

  bool eval_h(Index n, const Number* z, bool, Number factor, Index m, const Number* multipliers, bool, Index,
              Index* rows, Index* columns, Number* values) override {
    // Blocks first, then their entries in the one order that structure and values share.
    Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(kInputs, kInputs);
    const auto planes = static_cast<std::size_t>(program_.planeCount());
    std::vector<Eigen::Matrix<double, 3, kInputs>> mixed(planes, Eigen::Matrix<double, 3, kInputs>::Zero());
    std::vector<Eigen::Matrix3d> points(planes, Eigen::Matrix3d::Zero());
    if (values != nullptr) {
      const Eigen::VectorXd x = at(z, n);
      inputs = factor * program_.inputHessian(x);
      for (Index i = 0; i < m; ++i) {
        if (multipliers[i] != 0.0)
          addRow(program_.rows()[static_cast<std::size_t>(i)], multipliers[i], x, inputs, mixed, points);
      }
    }
    Entries set(rows, columns, values);
    for (Index i = 0; i < kInputs; ++i) {
      for (Index j = 0; j <= i; ++j) set(i, j, inputs(i, j));
    }
    for (int slack = 0; slack < program_.slackCount(); ++slack) {
      const Index i = program_.slackIndex(slack);
      set(i, i, factor * program_.slackQuadratic());
    }
    for (std::size_t plane = 0; plane < planes; ++plane) {
      const Index first = program_.planeIndex(static_cast<int>(plane));
      for (Index i = 0; i < 3; ++i) {
        for (Index j = 0; j < kInputs; ++j) set(first + i, j, mixed[plane](i, j));
        for (Index j = 0; j <= i; ++j) set(first + i, first + j, points[plane](i, j));
      }
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* z, const Number*, const Number*, Index,
                         const Number*, const Number*, Number cost, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    optimum_.found = status == Ipopt::SUCCESS || status == Ipopt::STOP_AT_ACCEPTABLE_POINT;
    optimum_.cost = cost;
    optimum_.variables = at(z, n);
    const auto slack = optimum_.variables.segment(kInputs, program_.slackCount());
    optimum_.slack = slack.size() > 0 ? slack.maxCoeff() : 0.0;
  }

 private:
  static Eigen::VectorXd at(const Number* z, Index n) { return Eigen::Map<const Eigen::VectorXd>(z, n); }

  void addRow(const Row& row, double multiplier, const Eigen::VectorXd& x, Eigen::MatrixXd& inputs,
              std::vector<Eigen::Matrix<double, 3, kInputs>>& mixed, std::vector<Eigen::Matrix3d>& points) const {
    const Eigen::Matrix<double, 6, 6> local = multiplier * program_.value(row, x).hessian;
    const ReferenceProgram::Gains& gains = program_.output(row).gains;
    inputs += gains.transpose() * local.topLeftCorner<3, 3>() * gains;
    if (row.plane < 0) return;
    mixed[static_cast<std::size_t>(row.plane)] += local.bottomLeftCorner<3, 3>() * gains;
    points[static_cast<std::size_t>(row.plane)] += local.bottomRightCorner<3, 3>();
  }

  const ReferenceProgram& program_;
  Eigen::VectorXd start_;
  ReferenceOptimum& optimum_;
};

}  // namespace

ReferenceOptimum solveByIpopt(const ReferenceProgram& program, const Trajectory& start) {
  ReferenceOptimum optimum;
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication(false);
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");  // no banner
  ipopt->Options()->SetIntegerValue("max_iter", 300);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);  // slacks below zero would be paid for
  ipopt->Options()->SetNumericValue("tol", 1e-8);
  if (ipopt->Initialize("") != Ipopt::Solve_Succeeded) return optimum;
  const Ipopt::SmartPtr<Ipopt::TNLP> adapter = new Adapter(program, program.startAt(start), optimum);
  ipopt->OptimizeTNLP(adapter);
  return optimum;
}

}  // namespace swarm_planner
