// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "solver/planner_problem.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr int kHorizon = PLANNER_QP_HORIZON;
constexpr int kOutputs = PLANNER_QP_OUTPUTS;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Position, velocity and acceleration of a stage.
struct State {
  Vector3 p = Vector3::Zero(), v = Vector3::Zero(), a = Vector3::Zero();
};

/// y = p_gain p + v_gain v + a_gain a, as the description says.
std::array<double, 3> gainsOf(const planner_qp_parameters& model, int output) {
  const double dt = model.dt;
  switch (output) {
    case PLANNER_QP_OUTPUT_POSITION:
      return {1.0, 0.0, 0.0};
    case PLANNER_QP_OUTPUT_CONTROL_POINT_1:
      return {1.0, dt / 3.0, 0.0};
    case PLANNER_QP_OUTPUT_CONTROL_POINT_2:
      return {1.0, 2.0 * dt / 3.0, dt * dt / 6.0};
    case PLANNER_QP_OUTPUT_VELOCITY:
      return {0.0, 1.0, 0.0};
    case PLANNER_QP_OUTPUT_VELOCITY_CONTROL_POINT:
      return {0.0, 1.0, dt / 2.0};
    case PLANNER_QP_OUTPUT_ACCELERATION:
      return {0.0, 0.0, 1.0};
    default:
      return {0.0, model.drag, 1.0};
  }
}

Vector3 valueOf(const planner_qp_parameters& model, int output, const State& x) {
  const std::array<double, 3> gains = gainsOf(model, output);
  return gains[0] * x.p + gains[1] * x.v + gains[2] * x.a;
}

Vector3 jerkOf(const PlannerAnswer& answer, int k) {
  return Vector3(answer.u[at(k)][0], answer.u[at(k)][1], answer.u[at(k)][2]);
}

std::array<State, kHorizon + 1> rollOut(const PlannerProblem& problem, const PlannerAnswer& answer) {
  std::array<State, kHorizon + 1> x;
  const double* x0 = problem.x0.data();
  x[0] = {Vector3(x0[0], x0[1], x0[2]), Vector3(x0[3], x0[4], x0[5]), Vector3(x0[6], x0[7], x0[8])};
  const double dt = problem.model.dt;
  for (int k = 0; k < kHorizon; ++k) {
    const State& s = x[at(k)];
    const Vector3 jerk = jerkOf(answer, k);
    x[at(k + 1)] = {s.p + dt * s.v + dt * dt / 2.0 * s.a + dt * dt * dt / 6.0 * jerk,
                    s.v + dt * s.a + dt * dt / 2.0 * jerk, s.a + dt * jerk};
  }
  return x;
}

Vector3 positionWeights(const planner_qp_parameters& model) { return Vector3(model.along, model.across, model.across); }

double velocityWeight(const planner_qp_parameters& model, int stage) {
  return stage == kHorizon ? model.final_velocity : model.velocity;
}

double accelerationWeight(const planner_qp_parameters& model, int stage) {
  return stage == kHorizon ? model.final_acceleration : 0.0;
}

Vector3 linear(const PlannerProblem& problem, int k, int first) {
  const double* q = problem.state_linear[at(k - 1)].data() + first;
  return Vector3(q[0], q[1], q[2]);
}

int mostRows(int output) {
  return output <= PLANNER_QP_OUTPUT_CONTROL_POINT_2 ? PLANNER_QP_MAX_ROWS_POSITION : PLANNER_QP_MAX_ROWS_VELOCITY;
}

/// Chooses the rows of one output at one stage around the value that the reference has there.
class RowChooser {
 public:
  RowChooser(PlannerProblem& problem, Random& random) : problem_(problem), random_(random) {
    tightness_ = random.logUniform(0.003, 0.5);
  }

  void choose(int output, int stage, int count, const Vector3& value, double size) {
    left_ = std::min(count, mostRows(output));
    while (left_ > 0) {
      PlannerProblem::Row row;
      row.output = output;
      row.stage = stage;
      row.n = random_.integer(0, 3) == 0 ? Vector3(Vector3::Unit(random_.integer(0, 2))) : random_.direction();
      row.d = row.n.dot(value) - size * random_.uniform(-0.3 * tightness_, 3.0);
      put(row);
      if (random_.integer(0, 19) == 0) putRelated(row, size);
    }
  }

 private:
  void put(const PlannerProblem::Row& row) {
    if (left_-- > 0) problem_.rows.push_back(row);
  }

  void putRelated(PlannerProblem::Row row, double size) {
    const int kind = random_.integer(0, 5);
    if (kind == 1) row.d += size * random_.uniform(-0.1, 0.1);  // parallel; otherwise a duplicate
    if (kind == 2) {                                            // nearly parallel
      row.n = (row.n + random_.logUniform(1e-13, 1e-2) * random_.direction()).normalized();
    }
    if (kind >= 3) {  // opposed: touching, which pins n . y, with room, or in contradiction
      row.n = -row.n;
      row.d = -row.d;
    }
    if (kind == 4) row.d -= size * random_.logUniform(1e-12, 1.0);
    if (kind == 5) row.d += size * random_.logUniform(1e-12, 1.0);
    put(row);
    if (kind == 0) put(row);
  }

  PlannerProblem& problem_;
  Random& random_;
  double tightness_ = 0.0;
  int left_ = 0;
};

double positive(double value) { return std::max(0.0, value); }

struct RowSums {
  std::vector<double> multiplier, slack;  ///< by the solver's identity
};

RowSums byIdentity(const PlannerProblem& problem, const PlannerAnswer& answer) {
  std::size_t identities = PLANNER_QP_ENTRIES + PLANNER_QP_MAX_QUADRATIC;
  for (const PlannerProblem::Row& row : problem.rows) identities = std::max(identities, at(row.id + 1));
  RowSums sums{std::vector<double>(identities, 0.0), std::vector<double>(identities, 0.0)};
  for (std::size_t i = 0; i < answer.active_id.size(); ++i) {
    sums.multiplier[at(answer.active_id[i])] = answer.multiplier[i];
    sums.slack[at(answer.active_id[i])] = answer.slack[i];
  }
  return sums;
}

}  // namespace

planner_qp_parameters randomPlannerModel(Random& random) {
  planner_qp_parameters model{};
  model.dt = random.logUniform(0.05, 1.0);
  const double eta = random.logUniform(0.01, 3.0);
  model.along = 2.0 * model.dt * eta;
  model.across = 2.0 * model.dt * (eta + (random.integer(0, 4) == 0 ? 0.0 : random.logUniform(0.03, 5.0)));
  model.velocity = random.integer(0, 4) == 0 ? 0.0 : model.along * random.logUniform(0.01, 3.0);
  model.final_velocity = random.integer(0, 2) == 0 ? model.velocity : model.along * random.logUniform(0.01, 1e3);
  if (random.integer(0, 4) == 0) model.final_velocity = 0.0;
  const double squared_time = std::pow(model.dt * random.logUniform(0.5, 10.0), 2.0);
  model.final_acceleration =
      random.integer(0, 2) == 0 ? 0.0 : squared_time * model.along * random.logUniform(0.01, 1e3);
  model.jerk = 2.0 * model.dt * 0.2 * std::pow(model.dt / 0.3, 6.0) * random.logUniform(0.03, 30.0);
  model.drag = random.uniform(0.0, 2.0);
  model.slack_linear = random.logUniform(1.0, 1e4);
  model.slack_quadratic = random.logUniform(1.0, 1e4);
  return model;
}

PlannerProblem randomPlannerProblem(const planner_qp_parameters& model, Random& random) {
  PlannerProblem problem;
  problem.model = model;
  const double off = random.integer(0, 9) == 0 ? random.logUniform(1.0, 100.0) : random.logUniform(0.01, 3.0);
  const double speed = random.uniform(0.0, 10.0);
  const double time = 20.0 * model.dt;
  const double size = 0.3 + 0.3 * speed * time;
  for (int i = 0; i < 3; ++i) {
    problem.x0[at(i)] = off * random.uniform(-1.0, 1.0);
    problem.x0[at(3 + i)] = speed * (i == 0 ? 1.0 : 0.0) + off * random.uniform(-1.0, 1.0);
    problem.x0[at(6 + i)] = off * random.uniform(-1.0, 1.0);
  }
  const int most = std::array<int, 8>{0, 1, 1, 1, 2, 4, 12, 60}[at(random.integer(0, 7))];
  const double used = random.uniform(0.0, 1.0);
  RowChooser rows(problem, random);
  for (int k = 1; k <= kHorizon; ++k) {
    State reference;
    reference.p.x() = speed * model.dt * k;
    reference.v.x() = speed;
    const Vector3 p = positionWeights(model).cwiseProduct(reference.p), v = velocityWeight(model, k) * reference.v;
    for (int i = 0; i < 3; ++i) {
      problem.state_linear[at(k - 1)][at(i)] = -p(i);
      problem.state_linear[at(k - 1)][at(3 + i)] = -v(i);
    }
    for (int output = 0; output < kOutputs; ++output) {
      if (random.uniform(0.0, 1.0) > used) continue;
      const double scale = output <= PLANNER_QP_OUTPUT_CONTROL_POINT_2 ? size : 1.0 + speed;
      rows.choose(output, k, random.integer(0, most), valueOf(model, output, reference), scale);
    }
    if (random.integer(0, 9) != 0) continue;
    problem.quadratics.push_back({k, random.direction(), random.integer(0, 1) * random.uniform(-1.0, 1.0),
                                  model.across * random.logUniform(1e-3, 1e3)});
  }
  return problem;
}

Vector3 valueOf(const planner_qp_parameters& model, int output, const double* state) {
  const Eigen::Map<const Vector3> p(state), v(state + 3), a(state + 6);
  return valueOf(model, output, State{p, v, a});
}

void load(PlannerProblem& problem, planner_qp_solver& solver) {
  planner_qp_clear_rows(&solver);
  std::copy(problem.x0.begin(), problem.x0.end(), solver.x0);
  for (int k = 0; k < kHorizon; ++k) {
    std::copy(problem.state_linear[at(k)].begin(), problem.state_linear[at(k)].end(), solver.state_linear[k]);
  }
  for (PlannerProblem::Row& row : problem.rows) {
    row.id = planner_qp_add_row(&solver, row.output, row.stage, row.n.data(), row.d, row.penalty);
  }
  solver.quadratic_count = 0;
  for (const PlannerProblem::Quadratic& term : problem.quadratics) {
    const int i = solver.quadratic_count++;
    solver.quadratic_output[i] = PLANNER_QP_OUTPUT_POSITION;
    solver.quadratic_index[i] = term.stage - PLANNER_QP_FIRST_STAGE_POSITION;
    std::copy(term.n.data(), term.n.data() + 3, solver.quadratic_normal[i]);
    solver.quadratic_offset[i] = term.c;
    solver.quadratic_weight[i] = term.weight;
  }
}

PlannerAnswer::PlannerAnswer(const planner_qp_solver& solver)
    : active_id(solver.active_id, solver.active_id + solver.active_count),
      multiplier(solver.multiplier, solver.multiplier + solver.active_count),
      slack(solver.slack, solver.slack + solver.active_count) {
  for (int k = 0; k < kHorizon; ++k) std::copy(solver.u[k], solver.u[k] + PLANNER_QP_INPUTS, u[at(k)].begin());
}

PlannerKkt kktOf(const PlannerProblem& problem, const PlannerAnswer& answer) {
  PlannerKkt kkt;
  const planner_qp_parameters& m = problem.model;
  const std::array<State, kHorizon + 1> x = rollOut(problem, answer);
  const RowSums sums = byIdentity(problem, answer);
  std::array<State, kHorizon + 1> g, size;  // gradients in the stage's state, and the sizes of their terms
  double outputs = 1.0;
  for (int k = 1; k <= kHorizon; ++k) {
    const Vector3 p = positionWeights(m).cwiseProduct(x[at(k)].p), v = velocityWeight(m, k) * x[at(k)].v;
    const Vector3 a = accelerationWeight(m, k) * x[at(k)].a;
    g[at(k)] = {p + linear(problem, k, 0), v + linear(problem, k, 3), a};
    size[at(k)] = {p.cwiseAbs() + linear(problem, k, 0).cwiseAbs(), v.cwiseAbs() + linear(problem, k, 3).cwiseAbs(),
                   a.cwiseAbs()};
    outputs = std::max({outputs, x[at(k)].p.norm(), x[at(k)].v.norm(), x[at(k)].a.norm()});
  }
  for (const PlannerProblem::Quadratic& term : problem.quadratics) {
    const double along = term.weight * (term.n.dot(x[at(term.stage)].p) - term.c);
    g[at(term.stage)].p += along * term.n;
    size[at(term.stage)].p += (along * term.n).cwiseAbs();
  }
  for (const PlannerProblem::Row& row : problem.rows) {
    const double lambda = sums.multiplier[at(row.id)], slack = sums.slack[at(row.id)];
    const double room = row.n.dot(valueOf(m, row.output, x[at(row.stage)])) - row.d + slack;
    kkt.rows = std::max({kkt.rows, -room, lambda > 0.0 ? std::abs(room) : 0.0});
    kkt.price += room > 0.0 ? lambda * room : std::max(lambda, m.slack_linear) * -room;
    const double right_slack = positive(lambda - m.slack_linear) / m.slack_quadratic;
    kkt.multipliers = std::max({kkt.multipliers, -lambda / m.slack_linear,
                                std::abs(slack - right_slack) * m.slack_quadratic / (m.slack_linear + lambda)});
    const std::array<double, 3> gains = gainsOf(m, row.output);
    const Vector3 force = lambda * row.n;
    g[at(row.stage)].p -= gains[0] * force;
    g[at(row.stage)].v -= gains[1] * force;
    g[at(row.stage)].a -= gains[2] * force;
    size[at(row.stage)].p += (gains[0] * force).cwiseAbs();
    size[at(row.stage)].v += (gains[1] * force).cwiseAbs();
    size[at(row.stage)].a += (gains[2] * force).cwiseAbs();
  }
  kkt.rows /= outputs;
  State costate, terms;
  double worst = 0.0, largest = 0.0;
  for (int k = kHorizon; k >= 1; --k) {
    const double dt = m.dt;
    const auto back = [&](State& c, const State& own) {
      c.a += dt * c.v + dt * dt / 2.0 * c.p + own.a;
      c.v += dt * c.p + own.v;
      c.p += own.p;
    };
    back(costate, g[at(k)]);
    back(terms, size[at(k)]);
    const auto slope = [&](const State& c) -> Vector3 {
      return dt * dt * dt / 6.0 * c.p + dt * dt / 2.0 * c.v + dt * c.a;
    };
    const Vector3 own = m.jerk * jerkOf(answer, k - 1);
    worst = std::max(worst, (own + slope(costate)).cwiseAbs().maxCoeff());
    largest = std::max(largest, (own.cwiseAbs() + slope(terms)).maxCoeff());
  }
  kkt.stationarity = largest > 0.0 ? worst / largest : 0.0;
  return kkt;
}

PlannerCost costOf(const PlannerProblem& problem, const PlannerAnswer& answer) {
  PlannerCost cost;
  const auto add = [&](double term) {
    cost.value += term;
    cost.size += std::abs(term);
  };
  const planner_qp_parameters& m = problem.model;
  const std::array<State, kHorizon + 1> x = rollOut(problem, answer);
  for (int k = 1; k <= kHorizon; ++k) {
    const State& s = x[at(k)];
    add(0.5 * s.p.dot(positionWeights(m).cwiseProduct(s.p)));
    add(linear(problem, k, 0).dot(s.p));
    add(0.5 * velocityWeight(m, k) * s.v.squaredNorm());
    add(0.5 * accelerationWeight(m, k) * s.a.squaredNorm());
    add(linear(problem, k, 3).dot(s.v));
    add(0.5 * m.jerk * jerkOf(answer, k - 1).squaredNorm());
  }
  for (const PlannerProblem::Quadratic& term : problem.quadratics) {
    add(0.5 * term.weight * std::pow(term.n.dot(x[at(term.stage)].p) - term.c, 2.0));
  }
  for (const PlannerProblem::Row& row : problem.rows) {
    const double slack = positive(row.d - row.n.dot(valueOf(m, row.output, x[at(row.stage)])));
    add(m.slack_linear * slack + 0.5 * m.slack_quadratic * slack * slack);
  }
  return cost;
}

}  // namespace swarm_planner
