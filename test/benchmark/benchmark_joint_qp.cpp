// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The QPs of Problem 1 by both kinds of generated solvers, side by side: the active set on one UAV's tables, and the
// sparse kind, which is the paper's way. UAVs cross at one point; every QP that their SQP runs pose is solved by both
// from a cold start, and the answers have to agree. Compiling the sparse solver takes some seconds.
//   benchmark_joint_qp [UAVs, 6]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <sstream>
#include <vector>

#include "solver/sparse_program.hpp"
#include "support/flight_problem.hpp"
#include "swarm_planner/solver/generated_joint_solver.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/joint_sqp_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"

namespace swarm_planner {
namespace {

using codegen::SparseData;
using Eigen::MatrixXd;

constexpr int kStates = 9, kInputs = 3;
constexpr int kUavVariables = (kStates + kInputs) * kHorizon;  // x_1 .. x_N, u_0 .. u_{N-1}
constexpr int kUavEqualities = kStates * kHorizon;
constexpr double kUnbounded = 1e300;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A QP, and what the active set made of it.
struct Recorded {
  std::vector<Qp> uavs;
  std::vector<PairRow> pair_rows;
  double objective = 0.0;
  double microseconds = 0.0;
  int changes = 0;
};

double objectiveOf(const JointQp& qp, const std::array<std::array<Vector3, kHorizon>, kMostJointUavs>& jerks) {
  std::vector<Trajectory> plans(qp.count);
  for (std::size_t i = 0; i < qp.count; ++i) {
    plans[i] = makePlan(qp.uavs[i]->start, jerks[i], 0.0, qp.uavs[i]->model.dt);
  }
  return objective(qp, plans, JointComponents{}, 0);
}

/// Solves without a guess, and takes QPs of all UAVs down.
class Recorder final : public JointQpSolver {
 public:
  Recorder(std::unique_ptr<JointQpSolver> solver, std::vector<Recorded>& records)
      : solver_(std::move(solver)), records_(records) {}

  QpStatus solve(const JointQp& qp, JointQpSolution& solution) override {
    for (ActiveRows& active : solution.active) active.count = 0;
    solution.active_pairs.rows.clear();
    const Stopwatch stopwatch;
    const QpStatus status = solver_->solve(qp, solution);
    const double seconds = stopwatch.elapsed();
    const auto end = qp.is_left.begin() + static_cast<std::ptrdiff_t>(qp.count);
    if (status != QpStatus::kSolved || std::find(qp.is_left.begin(), end, true) != end) return status;
    Recorded record;
    for (std::size_t i = 0; i < qp.count; ++i) record.uavs.push_back(*qp.uavs[i]);
    record.pair_rows = qp.pair_rows;
    record.objective = objectiveOf(qp, solution.jerks);
    record.microseconds = 1e6 * seconds;
    record.changes = solution.iterations;
    records_.push_back(record);
    return status;
  }

 private:
  std::unique_ptr<JointQpSolver> solver_;
  std::vector<Recorded>& records_;
};

/// UAVs that fly to the other side of a circle, from `radius` [m] on.
void flyCrossing(int uavs, double radius, JointSqpSolver& solver) {
  std::deque<FlightProblem> flights;
  JointProblem problem;
  JointPlans plans;
  for (int i = 0; i < uavs; ++i) {
    const double angle = 2.0 * M_PI * i / uavs + 0.02 * i;
    const Vector3 from(radius * std::cos(angle), radius * std::sin(angle), 20.0 + 0.05 * i);
    flights.emplace_back(std::vector<Vector3>{from, Vector3(-from.x(), -from.y(), from.z())}, 3.0,
                         KinematicState{from, -3.0 * Vector3(std::cos(angle), std::sin(angle), 0), Vector3::Zero()});
    problem.uavs.push_back(&flights.back().problem);
    plans.plans.push_back(flights.back().coasting());
    plans.active.emplace_back();
  }
  for (std::size_t first = 0; first < flights.size(); ++first) {
    for (std::size_t second = first + 1; second < flights.size(); ++second) {
      problem.pairs.push_back({first, second, 2.0, 2.0, 0.0});
    }
  }
  solver.solve(problem, plans);
}

/// Where rows and variables of the sparse problem lie. Each UAV has room for so many rows per stage, each pair too.
struct Layout {
  int uavs = 0, own_rows = 0, pair_rows = 0;

  int stateAt(int uav, int stage) const { return uav * kUavVariables + kStates * (stage - 1); }
  int inputAt(int uav, int stage) const { return uav * kUavVariables + kStates * kHorizon + kInputs * stage; }
  int firstOwnRow() const { return uavs * kUavEqualities; }
  int firstPairRow() const { return firstOwnRow() + uavs * kHorizon * own_rows; }
  int pairs() const { return uavs * (uavs - 1) / 2; }
  int rows() const { return firstPairRow() + pairs() * kHorizon * pair_rows; }
  int variables() const { return uavs * kUavVariables; }
  int pairOf(int first, int second) const { return first * uavs - first * (first + 1) / 2 + second - first - 1; }
};

Layout layoutOf(const std::vector<Recorded>& records) {
  Layout layout{static_cast<int>(records.front().uavs.size()), 0, 0};
  for (const Recorded& record : records) {
    for (const Qp& qp : record.uavs) {
      for (const QpStage& stage : qp.stages) layout.own_rows = std::max(layout.own_rows, stage.row_count);
    }
    std::vector<int> rows(at(layout.pairs() * (kHorizon + 1)));
    for (const PairRow& row : record.pair_rows) {
      const int pair = layout.pairOf(static_cast<int>(row.first), static_cast<int>(row.second));
      layout.pair_rows = std::max(layout.pair_rows, ++rows[at(pair * (kHorizon + 1) + row.stage)]);
    }
  }
  return layout;
}

std::string descriptionOf(const Layout& layout, const QpModel& model) {
  std::ostringstream text;
  text.precision(17);
  text << "name: joint_by_sparsity\nvariables: " << layout.variables()
       << "\npenalties: {slack: {linear: " << model.slack_linear << ", quadratic: " << model.slack_quadratic
       << "}}\nlinear: varies\nhessian:\n";
  for (int uav = 0; uav < layout.uavs; ++uav) {
    for (int k = 1; k <= kHorizon; ++k) {
      const int x = layout.stateAt(uav, k);
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column <= row; ++column) {
          text << "  - [" << x + row << ", " << x + column << ", varies]\n";
        }
        text << "  - [" << x + 3 + row << ", " << x + 3 + row << ", " << model.velocityWeight(k) << "]\n";
        if (k == kHorizon)
          text << "  - [" << x + 6 + row << ", " << x + 6 + row << ", " << model.accelerationWeight(k) << "]\n";
        const int u = layout.inputAt(uav, k - 1) + row;
        text << "  - [" << u << ", " << u << ", " << model.jerk_weight << "]\n";
      }
    }
  }
  const double dt = model.dt;
  const double from_state[3][3] = {{1, dt, dt * dt / 2}, {0, 1, dt}, {0, 0, 1}};
  const double from_input[3] = {dt * dt * dt / 6, dt * dt / 2, dt};
  text << "equalities:\n  dynamics:\n    rows: " << layout.firstOwnRow() << "\n    right: varies\n    matrix:\n";
  for (int uav = 0; uav < layout.uavs; ++uav) {
    for (int k = 1; k <= kHorizon; ++k) {
      for (int part = 0; part < 3; ++part) {
        for (int axis = 0; axis < 3; ++axis) {
          const int row = uav * kUavEqualities + kStates * (k - 1) + 3 * part + axis;
          text << "      - [" << row << ", " << layout.stateAt(uav, k) + 3 * part + axis << ", 1]\n      - [" << row
               << ", " << layout.inputAt(uav, k - 1) + axis << ", " << -from_input[part] << "]\n";
          for (int other = part; other < 3 && k > 1; ++other) {
            text << "      - [" << row << ", " << layout.stateAt(uav, k - 1) + 3 * other + axis << ", "
                 << -from_state[part][other] << "]\n";
          }
        }
      }
    }
  }
  text << "inequalities:\n";
  const auto rowsOf = [&](int rows, int x) {
    text << "      - {at: [0, " << x << "], size: [" << rows << ", " << kStates
         << "], value: varies, repeat: " << kHorizon << ", step: [" << rows << ", " << kStates << "]}\n";
  };
  const auto head = [&](const std::string& name, int rows) {
    text << "  " << name << ":\n    rows: " << kHorizon * rows
         << "\n    lower: varies\n    penalty: slack\n    matrix:\n";
  };
  for (int uav = 0; uav < layout.uavs; ++uav) {
    head("own_" + std::to_string(uav), layout.own_rows);
    rowsOf(layout.own_rows, layout.stateAt(uav, 1));
  }
  for (int first = 0; first < layout.uavs && layout.pair_rows > 0; ++first) {
    for (int second = first + 1; second < layout.uavs; ++second) {
      head("pair_" + std::to_string(first) + "_" + std::to_string(second), layout.pair_rows);
      for (const int uav : {first, second}) rowsOf(layout.pair_rows, layout.stateAt(uav, 1));
    }
  }
  return text.str();
}

/// The entries of `matrix` that vary, in the order in which they are given.
std::vector<double> varying(const codegen::SparseMatrix& pattern, const MatrixXd& matrix) {
  std::vector<double> values;
  for (const codegen::SparseEntry& entry : pattern.entries) {
    if (entry.datum.varies) values.push_back(matrix(entry.row, entry.column));
  }
  return values;
}

void putRow(const OutputGains& gains, const Vector3& n, int row, int x, MatrixXd& matrix) {
  matrix.block<1, 3>(row, x) = gains.p * n.transpose();
  matrix.block<1, 3>(row, x + 3) = gains.v * n.transpose();
  matrix.block<1, 3>(row, x + 6) = gains.a * n.transpose();
}

SparseData dataOf(const Recorded& record, const Layout& layout, const codegen::SparseDescription& description) {
  SparseData data;
  data.linear.assign(at(layout.variables()), 0.0);
  data.lower.assign(at(layout.variables()), -kUnbounded);
  data.upper.assign(at(layout.variables()), kUnbounded);
  data.row_lower.assign(at(layout.rows()), -kUnbounded);
  data.row_upper.assign(at(layout.rows()), kUnbounded);
  data.row_penalty.assign(at(layout.rows()), 1);
  MatrixXd hessian = MatrixXd::Zero(layout.variables(), layout.variables());
  MatrixXd matrix = MatrixXd::Zero(layout.rows(), layout.variables());
  std::fill_n(data.row_lower.begin(), layout.firstOwnRow(), 0.0);
  std::fill_n(data.row_penalty.begin(), layout.firstOwnRow(), 0);
  for (int uav = 0; uav < layout.uavs; ++uav) {
    const Qp& qp = record.uavs[at(uav)];
    const KinematicState moved = propagate(qp.start, Vector3::Zero(), qp.model.dt);
    double* const right = &data.row_lower[at(uav * kUavEqualities)];
    Eigen::Map<Vector3>(right, 3) = moved.p;
    Eigen::Map<Vector3>(right + 3, 3) = moved.v;
    Eigen::Map<Vector3>(right + 6, 3) = moved.a;
    for (int k = 1; k <= kHorizon; ++k) {
      const QpStage& stage = qp.stages[at(k)];
      const int x = layout.stateAt(uav, k);
      hessian.block<3, 3>(x, x) = qp.positionHessian(k);
      Eigen::Map<Vector3>(&data.linear[at(x)], 3) = stage.position_gradient;
      Eigen::Map<Vector3>(&data.linear[at(x) + 3], 3) = stage.velocity_gradient;
      for (int i = 0; i < stage.row_count; ++i) {
        const QpRow& row = stage.rows[at(i)];
        const int place = layout.firstOwnRow() + (uav * kHorizon + k - 1) * layout.own_rows + i;
        putRow(qp.outputs[static_cast<std::size_t>(row.output)], row.n, place, x, matrix);
        data.row_lower[at(place)] = row.d;
      }
    }
  }
  std::vector<int> used(at(layout.pairs() * kHorizon));
  for (const PairRow& row : record.pair_rows) {
    const auto first = static_cast<int>(row.first), second = static_cast<int>(row.second);
    const int block = layout.pairOf(first, second) * kHorizon + row.stage - 1;
    const int place = layout.firstPairRow() + block * layout.pair_rows + used[at(block)]++;
    const OutputGains& gains = record.uavs[at(first)].outputs[static_cast<std::size_t>(row.output)];
    putRow(gains, row.n, place, layout.stateAt(first, row.stage), matrix);
    putRow(gains, -row.n, place, layout.stateAt(second, row.stage), matrix);
    data.row_lower[at(place)] = row.d;
  }
  data.hessian = varying(description.hessian, hessian);
  data.matrix = varying(description.matrix, matrix);
  return data;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

int run(int uavs) {
  const QpModels models = makeQpModels(Parameters());
  const std::vector<QpModel> both{models.straight, models.corner};
  std::vector<Recorded> records;
  JointSqpSolver sqp(
      std::make_unique<Recorder>(std::make_unique<GeneratedJointSolver>(
                                     both, std::make_unique<GeneratedSolver>(std::make_shared<GeneratedTables>(both))),
                                 records));
  for (double radius = 20.0; radius >= 4.0; radius -= 2.0) flyCrossing(uavs, radius, sqp);
  const Layout layout = layoutOf(records);
  const codegen::SparseDescription description =
      codegen::parseSparseDescription(descriptionOf(layout, models.straight));
  std::vector<SparseData> data;
  for (const Recorded& record : records) data.push_back(dataOf(record, layout, description));
  const auto answers = codegen::SparseProgram(description, "-O3 -march=native").solve(data);

  std::vector<double> active_set, sparse, ratio;
  double worst = 0.0, changes = 0.0, newton_steps = 0.0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double error =
        std::abs(answers[i].cold.objective - records[i].objective) / (1.0 + std::abs(records[i].objective));
    worst = answers[i].cold.status == 0 ? std::max(worst, error) : INFINITY;
    active_set.push_back(records[i].microseconds);
    sparse.push_back(answers[i].microseconds);
    ratio.push_back(sparse.back() / active_set.back());
    changes += records[i].changes;
    newton_steps += answers[i].cold.iterations;
  }
  const auto count = static_cast<double>(records.size());
  std::printf("%zu QPs of %d UAVs: %d variables, %d equalities, %d inequalities\n", records.size(), uavs,
              layout.variables(), layout.firstOwnRow(), layout.rows() - layout.firstOwnRow());
  std::printf("active set   median %9.1f us, %5.1f changes\n", median(active_set), changes / count);
  std::printf("sparse kind  median %9.1f us, %5.1f Newton steps\n", median(sparse), newton_steps / count);
  std::printf("ratio        median %9.1f; costs agree within %.1e\n", median(ratio), worst);
  return worst < 1e-6 ? 0 : 1;
}

}  // namespace
}  // namespace swarm_planner

int main(int argc, char** argv) {
  const int uavs = argc > 1 ? std::atoi(argv[1]) : 6;
  if (uavs < 2 || uavs > static_cast<int>(swarm_planner::kMostJointUavs)) return 2;
  return swarm_planner::run(uavs);
}
