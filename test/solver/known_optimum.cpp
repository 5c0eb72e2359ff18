// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "known_optimum.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

class Random {
 public:
  explicit Random(std::mt19937_64& engine) : engine_(engine) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool oneIn(int n) { return uniform(0.0, n) < 1.0; }
  Matrix3 rotation() { return Eigen::AngleAxisd(uniform(-M_PI, M_PI), vector(1.0).normalized()).toRotationMatrix(); }
  Vector3 vector(double scale) { return scale * Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); }

 private:
  std::mt19937_64& engine_;
};

struct Costate {
  Vector3 p = Vector3::Zero(), v = Vector3::Zero(), a = Vector3::Zero();
};

void addRows(KnownOptimum& known, std::size_t k, const RowMix& mix, Random& random) {
  const int total = mix.active + mix.softened + mix.inactive;
  for (int i = 0; i < total; ++i) {
    const auto output = static_cast<Output>(static_cast<int>(random.uniform(0.0, kOutputCount - 1e-9)));
    known.qp.addRow(static_cast<int>(k), output, random.vector(1.0).normalized(), 0.0);
    double multiplier = 0.0;
    if (i < mix.active) multiplier = random.uniform(0.05, 0.95) * known.qp.model.slack_linear;
    if (i >= mix.active && i < mix.active + mix.softened)
      multiplier = random.uniform(1.1, 2.0) * known.qp.model.slack_linear;
    known.multipliers[k][static_cast<std::size_t>(i)] = multiplier;
  }
}

/// Offsets that make each row what its multiplier says.
void setOffsets(KnownOptimum& known, const Trajectory& x, std::size_t k, Random& random) {
  Qp& qp = known.qp;
  QpStage& stage = qp.stages[k];
  for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) {
    QpRow& row = stage.rows[i];
    const double value = row.n.dot(outputValue(qp.outputs[static_cast<std::size_t>(row.output)], x.knots[k]));
    const double multiplier = known.multipliers[k][i];
    row.d = value + std::max(0.0, multiplier - qp.model.slack_linear) / qp.model.slack_quadratic;
    if (multiplier == 0.0) row.d = value - random.uniform(0.05, 2.0);
  }
}

QpModel randomModel(Random& random) {
  QpModel model;
  model.dt = random.uniform(0.1, 0.4);
  model.along_weight = random.uniform(0.05, 1.0);
  model.across_weight = random.uniform(0.05, 1.0);
  model.velocity_weight = random.uniform(0.0, 1.0);
  model.final_velocity_weight = random.oneIn(3)   ? model.velocity_weight
                                : random.oneIn(3) ? 0.0
                                                  : random.uniform(0.0, 50.0);
  model.final_acceleration_weight = random.oneIn(3) ? 0.0 : random.uniform(0.0, 50.0);
  model.jerk_weight = random.uniform(0.05, 1.0);
  model.drag_over_mass = random.uniform(0.0, 1.0);
  model.slack_linear = random.uniform(1.0, 5.0);
  model.slack_quadratic = random.uniform(1.0, 20.0);
  return model;
}

/// Puts what the weight w of the last acceleration does into jerks that were chosen without it. It adds w a_N to the
/// acceleration's costate at every stage, so each jerk changes by -dt w a_N / jerk_weight, and a_N is what then
/// results.
void holdFinalAcceleration(KnownOptimum& known) {
  const QpModel& model = known.qp.model;
  Vector3 without = known.qp.start.a;
  for (const Vector3& jerk : known.solution.jerks) without += model.dt * jerk;
  const double pull = model.dt * model.final_acceleration_weight / model.jerk_weight;
  const Vector3 final_acceleration = without / (1.0 + kHorizon * model.dt * pull);
  for (Vector3& jerk : known.solution.jerks) jerk -= pull * final_acceleration;
}

}  // namespace

KnownOptimum makeKnownOptimum(const RowMix& mix, std::mt19937_64& engine) {
  Random random(engine);
  KnownOptimum known;
  Qp& qp = known.qp;
  qp.setModel(randomModel(random));
  const double dt = qp.model.dt;
  qp.axes = random.rotation();
  qp.start = {random.vector(10.0), random.vector(3.0), random.vector(2.0)};

  Costate costate;
  for (std::size_t k = kHorizon; k >= 1; --k) {
    addRows(known, k, mix, random);
    QpStage& stage = qp.stages[k];
    if (k % 3 == 0) qp.addCurvature(static_cast<int>(k), random.vector(1.0).normalized(), random.uniform(0.1, 2.0));
    // The acceleration has no free gradient: its costate follows from the next stage's; the others are chosen.
    costate.a += 0.5 * dt * dt * costate.p + dt * costate.v;
    for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) {
      const double multiplier = known.multipliers[k][i];
      costate.a -= multiplier * qp.outputs[static_cast<std::size_t>(stage.rows[i].output)].a * stage.rows[i].n;
    }
    // What the stage's gradients have to make up for is kept in them until the states are known.
    stage.position_gradient = -costate.p;
    stage.velocity_gradient = -(costate.v + dt * costate.p);
    costate.p = random.vector(2.0);
    costate.v = random.vector(2.0);
    stage.position_gradient += costate.p;
    stage.velocity_gradient += costate.v;
    known.solution.jerks[k - 1] =
        -(dt * dt * dt / 6.0 * costate.p + 0.5 * dt * dt * costate.v + dt * costate.a) / qp.model.jerk_weight;
  }
  holdFinalAcceleration(known);
  Trajectory x;
  x.dt = dt;
  x.jerks = known.solution.jerks;
  rollOut(qp.start, x);
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const int number = static_cast<int>(k);
    QpStage& stage = qp.stages[k];
    stage.position_gradient -= qp.positionHessian(number) * x.knots[k].p;
    stage.velocity_gradient -= qp.model.velocityWeight(number) * x.knots[k].v;
    for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) {
      const OutputGains& gains = qp.outputs[static_cast<std::size_t>(stage.rows[i].output)];
      const Vector3 pull = known.multipliers[k][i] * stage.rows[i].n;
      stage.position_gradient += gains.p * pull;
      stage.velocity_gradient += gains.v * pull;
    }
    setOffsets(known, x, k, random);
  }
  return known;
}

double objective(const Qp& qp, const std::array<Vector3, kHorizon>& jerks) {
  Trajectory x;
  x.dt = qp.model.dt;
  x.jerks = jerks;
  rollOut(qp.start, x);
  double sum = 0.0;
  for (std::size_t k = 1; k <= kHorizon; ++k) {
    const QpStage& stage = qp.stages[k];
    const KinematicState& s = x.knots[k];
    const int number = static_cast<int>(k);
    sum += 0.5 * s.p.dot(qp.positionHessian(number) * s.p) + stage.position_gradient.dot(s.p);
    sum += 0.5 * qp.model.velocityWeight(number) * s.v.squaredNorm() + stage.velocity_gradient.dot(s.v);
    sum += 0.5 * qp.model.accelerationWeight(number) * s.a.squaredNorm();
    sum += 0.5 * qp.model.jerk_weight * jerks[k - 1].squaredNorm();
    for (std::size_t i = 0; i < static_cast<std::size_t>(stage.row_count); ++i) {
      const QpRow& row = stage.rows[i];
      const double slack =
          std::max(0.0, row.d - row.n.dot(outputValue(qp.outputs[static_cast<std::size_t>(row.output)], s)));
      sum += qp.model.slack_linear * slack + 0.5 * qp.model.slack_quadratic * slack * slack;
    }
  }
  return sum;
}

}  // namespace swarm_planner
