// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "solver/recorded_file.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <set>

namespace swarm_planner {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kStages = 20;
constexpr int kSize = 3 * kStages;    ///< of controls, positions and velocities each
constexpr std::size_t kTouching = 3;  ///< half-spaces that hold with equality, and as many softened ones

std::vector<float> rounded(const VectorXd& values) {
  const Eigen::VectorXf single = values.cast<float>();
  return std::vector<float>(single.data(), single.data() + single.size());
}

std::vector<float> rounded(const std::vector<double>& values) {
  return std::vector<float>(values.begin(), values.end());
}

VectorXd exact(const std::vector<float>& values) {
  return Eigen::Map<const Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size())).cast<double>();
}

std::vector<double> zeros(int count) { return std::vector<double>(static_cast<std::size_t>(count), 0.0); }

/// Positions and velocities of stages 1..N as matrices in the controls, and the cost's weights.
struct Model {
  MatrixXd position = MatrixXd::Zero(kSize, kSize), velocity = MatrixXd::Zero(kSize, kSize);
  MatrixXd difference = MatrixXd::Identity(kSize, kSize);  ///< a_k - a_{k-1}
  VectorXd position_weight = VectorXd::Constant(kSize, recorded::kPositionWeight);
  VectorXd velocity_weight = VectorXd::Constant(kSize, recorded::kVelocityWeight);
  MatrixXd hessian;

  Model() {
    const double dt = recorded::kTimeStep;
    for (int r = 0; r < kSize; ++r) {
      for (int c = r % 3; c <= r; c += 3) {
        velocity(r, c) = dt;
        position(r, c) = dt * dt * ((r - c) / 3 + 0.5);
      }
      if (r >= 3) difference(r, r - 3) = -1.0;
    }
    position_weight.tail(3).setConstant(recorded::kFinalPositionWeight);
    velocity_weight.tail(3).setConstant(recorded::kFinalVelocityWeight);
    hessian = position.transpose() * position_weight.asDiagonal() * position +
              velocity.transpose() * velocity_weight.asDiagonal() * velocity +
              recorded::kRateWeight * difference.transpose() * difference;
    hessian.diagonal().array() += recorded::kInputWeight;
  }

  VectorXd positions(const RecordedProblem& problem, const VectorXd& input) const {
    VectorXd p = position * input;
    for (int k = 0; k < kStages; ++k) {
      p.segment<3>(3 * k) += exact(problem.p0) + (k + 1) * recorded::kTimeStep * exact(problem.v0);
    }
    return p;
  }
  VectorXd velocities(const RecordedProblem& problem, const VectorXd& input) const {
    return velocity * input + exact(problem.v0).replicate(kStages, 1);
  }
  VectorXd rates(const RecordedProblem& problem, const VectorXd& input) const {
    VectorXd rate = difference * input;
    rate.head(3) -= exact(problem.a_previous);
    return rate;
  }
  /// Gradient of the cost without penalties.
  VectorXd gradient(const RecordedProblem& problem, const VectorXd& input, const VectorXd& p_ref,
                    const VectorXd& v_ref) const {
    return position.transpose() * position_weight.cwiseProduct(positions(problem, input) - p_ref) +
           velocity.transpose() * velocity_weight.cwiseProduct(velocities(problem, input) - v_ref) +
           recorded::kInputWeight * input + recorded::kRateWeight * difference.transpose() * rates(problem, input);
  }
};

/// A row `normal . input >= right` that is active, and where its multiplier goes.
struct ActiveRow {
  VectorXd normal;
  double right = 0.0;
  double multiplier = 0.0;
  bool softened = false;
  double* place = nullptr;
};

class Builder {
 public:
  Builder(int rows, Random& random) : rows_(rows), random_(random) {}

  KnownRecordedProblem build() {
    result_.multipliers = {zeros(kStages * rows_), zeros(2 * kSize), zeros(2 * kSize), zeros(kStages)};
    chooseMotion();
    chooseThrust();
    chooseHalfSpaces();
    chooseReferences();
    solveExactly();
    return result_;
  }

 private:
  RecordedProblem& problem() { return result_.problem; }

  void addRow(const VectorXd& normal, double right, double multiplier, bool softened, double& place) {
    active_.push_back({normal, right, multiplier, softened, &place});
  }

  /// Controls within their bounds or on them, such that velocities are within theirs or on them.
  void chooseMotion() {
    const auto single = [&](double bound) { return static_cast<float>(random_.uniform(-bound, bound)); };
    for (int i = 0; i < 3; ++i) {
      problem().p0.push_back(single(10.0));
      problem().v0.push_back(single(0.9 * recorded::kMaxVelocity[i]));
      problem().a_previous.push_back(single(recorded::kMaxAcceleration[i]));
    }
    VectorXd v = exact(problem().v0);
    for (int j = 0; j < kSize; ++j) {
      const int i = j % 3;
      const double limit_v = recorded::kMaxVelocity[i], limit_a = recorded::kMaxAcceleration[i];
      double a = random_.uniform(-0.85 * limit_a, 0.85 * limit_a);
      const double side = a > 0.0 ? 1.0 : -1.0;
      const auto place = static_cast<std::size_t>(6 * (j / 3) + i + (side > 0.0 ? 3 : 0));
      const auto inside = [&](double input) { return side * (v[i] + recorded::kTimeStep * input) < 0.95 * limit_v; };
      if (!inside(a)) {
        a = (side * limit_v - v[i]) / recorded::kTimeStep;
        const VectorXd row = -side * model_.velocity.row(j).transpose();
        addRow(row, side * static_cast<double>(problem().v0[static_cast<std::size_t>(i)]) - limit_v,
               random_.uniform(1.0, 20.0), false, result_.multipliers.velocity[place]);
      } else if (inside(side * limit_a) && random_.uniform(0.0, 1.0) < 0.15) {
        a = side * limit_a;
        addRow(-side * VectorXd::Unit(kSize, j), -limit_a, random_.uniform(1.0, 20.0), false,
               result_.multipliers.acceleration[place]);
      }
      input_[j] = a;
      v[i] += recorded::kTimeStep * a;
    }
  }

  /// Limits that every fourth stage's control touches.
  void chooseThrust() {
    VectorXd normals(kSize), offsets(kStages);
    for (int k = 0; k < kStages; ++k) {
      const bool touching = k % 4 == 2;
      const Vector3d n = (random_.vector(-0.5, 0.5) + Vector3d::UnitZ()).normalized();
      normals.segment<3>(3 * k) = n;
      offsets[k] = n.dot(input_.segment<3>(3 * k)) + (touching ? 0.0 : random_.uniform(0.1, 2.0));
    }
    problem().thrust_normal = rounded(normals);
    problem().thrust_offset = rounded(offsets);
    for (int k = 2; k < kStages; k += 4) {
      VectorXd row = VectorXd::Zero(kSize);
      row.segment<3>(3 * k) = -exact(problem().thrust_normal).segment<3>(3 * k);
      const auto stage = static_cast<std::size_t>(k);
      addRow(row, -static_cast<double>(problem().thrust_offset[stage]), random_.uniform(1.0, 10.0), false,
             result_.multipliers.thrust[stage]);
    }
  }

  void chooseHalfSpaces() {
    std::set<int> rigid, soft;  // stages with a row that touches
    while (rigid.size() < kTouching) rigid.insert(random_.integer(5, kStages - 1));
    while (soft.size() < kTouching) {
      const int k = random_.integer(5, kStages - 1);
      if (rigid.count(k) == 0) soft.insert(k);
    }
    const VectorXd p = model_.positions(problem(), input_);
    VectorXd normals(3 * rows_ * kStages), offsets(rows_ * kStages);
    std::vector<std::pair<int, double>> touching;  // row, slack
    for (int k = 0; k < kStages; ++k) {
      const int chosen = rows_ * k + random_.integer(0, rows_ - 1);
      for (int r = rows_ * k; r < rows_ * (k + 1); ++r) {
        const Vector3d c = random_.direction();
        double slack = -random_.uniform(0.1, 5.0);
        if (r == chosen && rigid.count(k) > 0) slack = 0.0;
        if (r == chosen && soft.count(k) > 0) slack = random_.uniform(0.1, 0.5);
        normals.segment<3>(3 * r) = c;
        offsets[r] = c.dot(p.segment<3>(3 * k)) + slack;
        if (slack >= 0.0) touching.emplace_back(r, slack);
      }
    }
    problem().normal = rounded(normals);
    problem().offset = rounded(offsets);
    for (const auto& row : touching) addHalfSpace(row.first, row.second);
  }

  void addHalfSpace(int r, double slack) {
    const int k = r / rows_;
    const Vector3d c = exact(problem().normal).segment<3>(3 * r);
    const VectorXd row = model_.position.middleRows<3>(3 * k).transpose() * c;
    const VectorXd free = model_.positions(problem(), VectorXd::Zero(kSize));
    const bool softened = slack > 0.0;
    const double multiplier =
        softened ? recorded::kLinearPenalty + recorded::kQuadraticPenalty * slack : random_.uniform(5.0, 45.0);
    const auto place = static_cast<std::size_t>(r);
    addRow(row, static_cast<double>(problem().offset[place]) - c.dot(free.segment<3>(3 * k)), multiplier, softened,
           result_.multipliers.half_space[place]);
    if (softened) ++result_.softened;
  }

  /// Near the motion, and such that cost and multipliers balance: the smallest change of both that does it.
  void chooseReferences() {
    const auto noise = [&] { return random_.uniform(-1.0, 1.0); };
    VectorXd reference(2 * kSize);
    reference << model_.positions(problem(), input_) + VectorXd::NullaryExpr(kSize, noise),
        model_.velocities(problem(), input_) + VectorXd::NullaryExpr(kSize, noise);
    VectorXd force = model_.gradient(problem(), input_, reference.head(kSize), reference.tail(kSize));
    for (const ActiveRow& row : active_) force -= row.multiplier * row.normal;
    MatrixXd effect(kSize, 2 * kSize);
    effect << model_.position.transpose() * model_.position_weight.asDiagonal(),
        model_.velocity.transpose() * model_.velocity_weight.asDiagonal();
    reference += effect.completeOrthogonalDecomposition().solve(force);
    problem().p_ref = rounded(VectorXd(reference.head(kSize)));
    problem().v_ref = rounded(VectorXd(reference.tail(kSize)));
  }

  /// The optimum of the rounded data, the active rows being known; and what a file says about it.
  void solveExactly() {
    const auto count = static_cast<Eigen::Index>(active_.size());
    const VectorXd p_ref = exact(problem().p_ref), v_ref = exact(problem().v_ref);
    MatrixXd kkt = MatrixXd::Zero(kSize + count, kSize + count);
    VectorXd right(kSize + count);
    kkt.topLeftCorner(kSize, kSize) = model_.hessian;
    right.head(kSize) = -model_.gradient(problem(), VectorXd::Zero(kSize), p_ref, v_ref);
    for (Eigen::Index i = 0; i < count; ++i) {
      const ActiveRow& row = active_[static_cast<std::size_t>(i)];
      kkt.block(0, kSize + i, kSize, 1) = -row.normal;
      kkt.block(kSize + i, 0, 1, kSize) = row.normal.transpose();
      right[kSize + i] = row.right;
      if (!row.softened) continue;
      kkt(kSize + i, kSize + i) = 1.0 / recorded::kQuadraticPenalty;
      right[kSize + i] += recorded::kLinearPenalty / recorded::kQuadraticPenalty;
    }
    const Eigen::FullPivLU<MatrixXd> factor(kkt);
    VectorXd answer = factor.solve(right);
    answer += factor.solve(right - kkt * answer);
    input_ = answer.head(kSize);
    for (Eigen::Index i = 0; i < count; ++i) *active_[static_cast<std::size_t>(i)].place = answer[kSize + i];

    problem().optimal_input.assign(input_.data(), input_.data() + kSize);
    problem().optimal_cost = cost(p_ref, v_ref);
    problem().warm_input = rounded(input_);
    problem().warm_half_space = rounded(result_.multipliers.half_space);
    problem().warm_velocity = rounded(result_.multipliers.velocity);
    problem().warm_acceleration = rounded(result_.multipliers.acceleration);
    problem().warm_thrust = rounded(result_.multipliers.thrust);
  }

  double cost(const VectorXd& p_ref, const VectorXd& v_ref) {
    const VectorXd dp = model_.positions(problem(), input_) - p_ref, dv = model_.velocities(problem(), input_) - v_ref;
    double total = dp.dot(model_.position_weight.cwiseProduct(dp)) + dv.dot(model_.velocity_weight.cwiseProduct(dv)) +
                   recorded::kInputWeight * input_.squaredNorm() +
                   recorded::kRateWeight * model_.rates(problem(), input_).squaredNorm();
    for (const ActiveRow& row : active_) {
      if (!row.softened) continue;
      const double slack = row.right - row.normal.dot(input_);
      total += 2.0 * recorded::kLinearPenalty * slack + recorded::kQuadraticPenalty * slack * slack;
    }
    return 0.5 * total;
  }

  int rows_;
  Random& random_;
  Model model_;
  KnownRecordedProblem result_;
  VectorXd input_ = VectorXd::Zero(kSize);
  std::vector<ActiveRow> active_;
};

template <typename T>
void write(std::ofstream& out, const std::vector<T>& values) {
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

}  // namespace

KnownRecordedProblem makeRecordedProblem(int rows, Random& random) {
  // Where rows nearly depend on each other, rounding the data may change which of them are active: one in seventy.
  constexpr int kDraws = 5;
  RecordedProblems file;
  file.horizon = kStages;
  file.rows = rows;
  for (int draw = 1;; ++draw) {
    KnownRecordedProblem known = Builder(rows, random).build();
    const double residual = recordedKktResidual(file, known.problem, known.problem.optimal_input, known.multipliers);
    if (residual <= 1e-8 || draw == kDraws) return known;
  }
}

void writeRecordedProblems(const std::string& path, const RecordedProblems& file) {
  std::ofstream out(path, std::ios::binary);
  out << "QMPCQP01";
  write<std::int32_t>(out, {static_cast<std::int32_t>(file.problems.size()), file.horizon, file.rows, 0});
  for (const RecordedProblem& p : file.problems) {
    for (const auto* field :
         {&p.p0, &p.v0, &p.a_previous, &p.p_ref, &p.v_ref, &p.normal, &p.offset, &p.thrust_normal, &p.thrust_offset,
          &p.warm_input, &p.warm_half_space, &p.warm_velocity, &p.warm_acceleration, &p.warm_thrust}) {
      write(out, *field);
    }
    write<double>(out, {p.optimal_cost});
    write(out, p.optimal_input);
    write<double>(out, {0.0});                       // KKT residual of the reference
    write<std::int32_t>(out, {-1, -1, -1, -1, -1});  // numbers of active rows; nobody reads them
  }
}

}  // namespace swarm_planner
