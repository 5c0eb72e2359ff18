// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Closed-loop convergence without obstacles for one horizon: this program is built once for each, with a solver that is
// generated from the planner's description with another number of stages. One UAV flies after its moving target from
// perturbed starts; without obstacles and others the nonlinear program is the QP of the planner with tangents to the
// limits of speed and thrust. Vehicles follow the model exactly.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <vector>

#include "planner_qp.h"
#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/model/kinematics.hpp"

namespace swarm_planner {
namespace {

constexpr int kStages = PLANNER_QP_HORIZON;
constexpr int kCycles = 300;  // 90 s
constexpr int kStarts = 50;
constexpr double kTargetSpeed = 3.0;   // as in section 4 [m/s]
constexpr double kTargetStart = 20.0;  // [m]
constexpr double kSettled = 0.01;      // the error's last changes are smaller [m]
constexpr int kLast = 20;              // cycles, in which the error has to stay the same
constexpr double kTangentsFrom = 0.6;  // of a limit

/// Table 3.
CostParameters paperWeights() {
  CostParameters cost;
  cost.alpha = cost.beta = 0.5;
  cost.eta = 0.1;
  cost.zeta = 0.2;
  cost.velocity_time = 1.0;
  return cost;
}

/// Model predictive control of one UAV along x, its reference the x axis.
class Controller {
 public:
  explicit Controller(bool as_paper)
      : as_paper_(as_paper),
        tables_(std::make_unique<planner_qp_tables>()),
        solver_(std::make_unique<planner_qp_solver>()) {
    const CostParameters cost = paperWeights();
    planner_qp_parameters& p = weights_;
    p.dt = kDt;
    p.along = 2.0 * kDt * cost.eta;
    p.across = 2.0 * kDt * (cost.alpha + cost.eta);
    p.velocity = 2.0 * kDt * cost.eta;
    p.final_velocity = as_paper ? p.velocity : 2.0 * kDt * cost.stop_weight;
    p.final_acceleration = as_paper ? 0.0 : p.final_velocity * kDt * kDt / 9.0;
    p.jerk = 2.0 * kDt * cost.zeta;
    p.drag = vehicle_.dragOverMass().mean();
    p.slack_linear = p.slack_quadratic = 200.0;
    p.held = as_paper ? 1.0 : 0.0;
    if (planner_qp_setup_baseline(tables_.get(), &p, PLANNER_QP_HASH) != PLANNER_QP_SOLVED) std::abort();
    planner_qp_init_baseline(solver_.get(), tables_.get());
  }

  /// The state one cycle later, the target being at `target` [m] along x now.
  KinematicState step(const KinematicState& x, double target) {
    planner_qp_solver& s = *solver_;
    Eigen::Map<Vector3>(s.x0, 3) = x.p;
    Eigen::Map<Vector3>(s.x0 + 3, 3) = x.v;
    Eigen::Map<Vector3>(s.x0 + 6, 3) = x.a;
    for (int k = 1; k <= kStages; ++k) {
      double* linear = s.state_linear[k - 1];
      const bool rests = k == kStages && !as_paper_;
      linear[0] = -weights_.along * (target + kTargetSpeed * kDt * k);
      linear[3] = rests ? 0.0 : -weights_.velocity * kTargetSpeed;
    }
    planner_qp_clear_rows(&s);
    s.warm_count = 0;
    for (int iteration = 0; iteration < SqpParameters().max_iterations; ++iteration) {
      if (planner_qp_solve_baseline(tables_.get(), &s) != PLANNER_QP_SOLVED) std::abort();
      if (!addTangents(x)) break;
    }
    return next(x, Eigen::Map<const Vector3>(s.u[0]));
  }

 private:
  static constexpr double kDt = 0.3;  // Table 3 [s]

  KinematicState next(const KinematicState& x, const Vector3& jerk) const {
    return as_paper_ ? propagateHeld(x, x.a + kDt * jerk, kDt) : propagate(x, jerk, kDt);
  }

  bool addTangent(int output, int stage, const Vector3& value, const Vector3& centre, double limit) {
    const Vector3 outward = value + centre;
    if (outward.norm() <= kTangentsFrom * limit) return false;
    const Vector3 n = -outward.normalized();
    planner_qp_add_row(solver_.get(), output, stage, n.data(), -limit - n.dot(centre), PLANNER_QP_PENALTY_SLACK);
    return outward.norm() > limit + 1e-6;
  }

  /// Tangents to the limits near the newest answer; true if that exceeds one.
  bool addTangents(KinematicState x) {
    bool exceeded = false;
    const Vector3 gravity(0.0, 0.0, vehicle_.gravity);
    std::array<Vector3, kStages> inputs;
    for (int k = 0; k < kStages; ++k) inputs[static_cast<std::size_t>(k)] = Eigen::Map<const Vector3>(solver_->u[k]);
    for (int k = 1; k <= kStages; ++k) {
      x = next(x, inputs[static_cast<std::size_t>(k - 1)]);
      exceeded |= addTangent(PLANNER_QP_OUTPUT_VELOCITY, k, x.v, Vector3::Zero(), limits_.max_speed);
      exceeded |= addTangent(PLANNER_QP_OUTPUT_THRUST_ACCELERATION, k, x.a + weights_.drag * x.v, gravity,
                             limits_.max_thrust_ratio * vehicle_.gravity);
    }
    return exceeded;
  }

  const bool as_paper_;
  const VehicleParameters vehicle_;
  const LimitParameters limits_;
  planner_qp_parameters weights_{};
  std::unique_ptr<planner_qp_tables> tables_;
  std::unique_ptr<planner_qp_solver> solver_;
};

KinematicState perturbedStart(std::mt19937_64& random) {
  // Portable, unlike the standard's distributions.
  const auto uniform = [&random](double limit) {
    return limit * (2.0 * static_cast<double>(random() >> 11) / 9007199254740992.0 - 1.0);
  };
  KinematicState x;
  for (int axis = 0; axis < 3; ++axis) {
    x.p[axis] = uniform(20.0);
    x.v[axis] = uniform(2.5);
    x.a[axis] = uniform(2.0);
  }
  return x;
}

void study(bool as_paper, bool last) {
  Controller controller(as_paper);
  std::mt19937_64 random(1);
  std::vector<double> worst(kCycles, 0.0);
  int still = 0;
  double settling_time = 0.0, final_distance = 0.0;
  for (int start = 0; start < kStarts; ++start) {
    KinematicState x = perturbedStart(random);
    std::vector<double> distance;
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      const double target = kTargetStart + kTargetSpeed * 0.3 * cycle;
      distance.push_back((x.p - Vector3(target, 0.0, 0.0)).norm());
      worst[static_cast<std::size_t>(cycle)] = std::max(worst[static_cast<std::size_t>(cycle)], distance.back());
      x = controller.step(x, target);
    }
    int settled = kCycles - 1;
    while (settled > 0 && std::abs(distance[static_cast<std::size_t>(settled - 1)] - distance.back()) < kSettled)
      --settled;
    const bool is_still = settled < kCycles - kLast;
    still += is_still ? 1 : 0;
    settling_time = std::max(settling_time, 0.3 * settled);
    final_distance = std::max(final_distance, distance.back());
  }
  std::printf(
      "{\"horizon\": %d, \"method\": \"%s\", \"starts\": %d, \"settled\": %d, \"settling_time_s\": %.1f, "
      "\"final_distance_m\": %.6g, \"worst_distance_m\": [",
      kStages, as_paper ? "as_paper" : "ours", kStarts, still, settling_time, final_distance);
  for (int cycle = 0; cycle < kCycles; ++cycle)
    std::printf("%s%.5g", cycle > 0 ? ", " : "", worst[static_cast<std::size_t>(cycle)]);
  std::printf("]}%s\n", last ? "" : ",");
}

}  // namespace
}  // namespace swarm_planner

/// Two JSON objects: the paper's method and ours.
int main() {
  swarm_planner::study(true, false);
  swarm_planner::study(false, true);
  return 0;
}
