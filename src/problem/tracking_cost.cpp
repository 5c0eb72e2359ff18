// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/tracking_cost.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "swarm_planner/obstacles/robustness.hpp"

namespace swarm_planner {
namespace {

constexpr double kVerticalPath = 1e-3;  // horizontal part of a unit tangent below which a path counts as vertical

/// Calls add(obstacle, point, parameters) for every obstacle that may have a robustness term at the stage's position
/// `p`; `point` is p as the obstacle's frame has it, which stays where it is at the epoch.
template <class Function>
void forEachObstacleNear(const UavProblem& problem, int stage, const Vector3& p, const Function& add) {
  const CostParameters& weights = problem.parameters->cost;
  if (weights.robustness_gain == 0.0) return;
  const RobustnessParameters parameters(weights);
  const double reach = std::sqrt(parameters.outer);  // |u_i| beyond reach * extent makes S > r_b, exponents >= 2
  for (const MovingBody& body : problem.bodies) {
    if (body.isUav()) continue;
    const Superellipsoid& obstacle = *body.obstacle();
    const Vector3 point = p - stage * problem.dt * obstacle.velocity();
    if (((point - obstacle.center()).cwiseAbs().array() > reach * obstacle.halfExtents().array()).any()) continue;
    add(obstacle, point, parameters);
  }
}

/// A state's deviations from the reference and from the target, at the last stage from rest.
struct Deviation {
  Deviation(const UavProblem& problem, int stage, const StageFrame& frame, const KinematicState& x)
      : across(frame.horizontal.dot(x.p - frame.foot.position)),
        above(frame.vertical.dot(x.p - frame.foot.position)),
        behind(x.p - problem.targets[static_cast<std::size_t>(stage)].p),
        at_end(stage == kHorizon && !problem.parameters->limits.as_paper),
        faster(x.v - (at_end ? Vector3(Vector3::Zero()) : problem.targets[static_cast<std::size_t>(stage)].v)),
        acceleration(x.a) {}

  /// Cost (16) without robustness term and jerk; at the last stage with rest instead of the target's velocity.
  double cost(const Parameters& parameters) const {
    const CostParameters& weights = parameters.cost;
    const double squared_time = weights.velocity_time * weights.velocity_time;
    const double position =
        weights.alpha * across * across + weights.beta * above * above + weights.eta * behind.squaredNorm();
    if (!at_end) return position + weights.eta * squared_time * faster.squaredNorm();
    const double third = parameters.time.sampling_time / 3.0;
    return position +
           weights.stop_weight * squared_time * (faster.squaredNorm() + third * third * acceleration.squaredNorm());
  }

  double across;
  double above;
  Vector3 behind;
  bool at_end;  ///< of the horizon, where it is to rest
  Vector3 faster;
  Vector3 acceleration;
};

double stageCostValue(const UavProblem& problem, int stage, const StageFrame& frame, const KinematicState& x) {
  double value = Deviation(problem, stage, frame, x).cost(*problem.parameters);
  forEachObstacleNear(
      problem, stage, x.p,
      [&](const Superellipsoid& obstacle, const Vector3& point, const RobustnessParameters& parameters) {
        value += robustnessValue(obstacle, point, parameters);
      });
  return problem.dt * value;
}

}  // namespace

StageFrame makeStageFrame(const PathPoint& foot) {
  StageFrame frame;
  frame.foot = foot;
  const Vector3 across = upward().cross(foot.tangent);
  frame.horizontal = across.norm() > kVerticalPath ? Vector3(across.normalized()) : Vector3(Vector3::UnitY());
  frame.vertical = foot.tangent.cross(frame.horizontal);
  return frame;
}

void findStageFrames(const UavProblem& problem, const Trajectory& plan, StageFrames& frames) {
  double near = problem.progress;
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    const PathPoint foot = problem.path->nearest(plan.knots[k].p, near);
    if (k > 0 && foot.tangent == frames[k - 1].foot.tangent) {
      frames[k] = {foot, frames[k - 1].horizontal, frames[k - 1].vertical};
    } else {
      frames[k] = makeStageFrame(foot);
    }
    near = foot.arc_length;
  }
}

StageCost stageCost(const UavProblem& problem, int stage, const StageFrame& frame, const KinematicState& x) {
  const CostParameters& weights = problem.parameters->cost;
  const double dt = problem.dt;
  const Deviation deviation(problem, stage, frame, x);

  StageCost cost;
  cost.value = dt * deviation.cost(*problem.parameters);
  cost.position_gradient = 2.0 * dt *
                           (weights.alpha * deviation.across * frame.horizontal +
                            weights.beta * deviation.above * frame.vertical + weights.eta * deviation.behind);
  cost.velocity_gradient = velocityWeight(*problem.parameters, stage) * deviation.faster;
  cost.position_hessian =
      2.0 * dt *
      (weights.alpha * frame.horizontal * frame.horizontal.transpose() +
       weights.beta * frame.vertical * frame.vertical.transpose() + weights.eta * Matrix3::Identity());
  forEachObstacleNear(
      problem, stage, x.p,
      [&](const Superellipsoid& obstacle, const Vector3& point, const RobustnessParameters& parameters) {
        const Robustness term = robustness(obstacle, point, parameters);
        cost.value += dt * term.value;
        cost.position_gradient += dt * term.gradient;
        cost.robustness_hessian += dt * term.projected;
      });
  cost.position_hessian += cost.robustness_hessian;
  return cost;
}

double velocityWeight(const Parameters& parameters, int stage) {
  const CostParameters& weights = parameters.cost;
  const bool at_end = stage == kHorizon && !parameters.limits.as_paper;
  const double weight = at_end ? weights.stop_weight : weights.eta;
  return 2.0 * parameters.time.sampling_time * weight * weights.velocity_time * weights.velocity_time;
}

double accelerationWeight(const Parameters& parameters, int stage) {
  if (stage != kHorizon || parameters.limits.as_paper) return 0.0;
  const double third = parameters.time.sampling_time / 3.0;
  return velocityWeight(parameters, stage) * third * third;
}

double jerkWeight(const Parameters& parameters) { return 2.0 * parameters.time.sampling_time * parameters.cost.zeta; }

double planCost(const UavProblem& problem, const Trajectory& plan) {
  StageFrames frames;
  findStageFrames(problem, plan, frames);
  double sum = 0.0;
  for (int k = 1; k <= kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    sum += stageCostValue(problem, k, frames[i], plan.knots[i]);
    sum += 0.5 * jerkWeight(*problem.parameters) * plan.jerks[i - 1].squaredNorm();
  }
  return sum;
}

}  // namespace swarm_planner
