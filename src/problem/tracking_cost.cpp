// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/tracking_cost.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "swarm_planner/obstacles/robustness.hpp"

namespace swarm_planner {
namespace {

constexpr double kVerticalPath = 1e-3;  // horizontal part of a unit tangent below which a path counts as vertical

void addRobustness(const UavProblem& problem, int stage, const Vector3& p, StageCost& cost) {
  const CostParameters& weights = problem.parameters->cost;
  if (weights.robustness_gain == 0.0) return;
  const RobustnessParameters parameters(weights);
  const double reach = std::sqrt(parameters.outer);  // |u_i| beyond reach * extent makes S > r_b, exponents >= 2
  for (const MovingBody& body : problem.bodies) {
    if (body.isUav()) continue;
    const Superellipsoid& obstacle = *body.obstacle();
    const Vector3 point = p - stage * problem.dt * obstacle.velocity();
    if (((point - obstacle.center()).cwiseAbs().array() > reach * obstacle.halfExtents().array()).any()) continue;
    const Robustness term = robustness(obstacle, point, parameters);
    cost.value += problem.dt * term.value;
    cost.position_gradient += problem.dt * term.gradient;
    cost.robustness_hessian += problem.dt * term.projected;
  }
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
    frames[k] = makeStageFrame(problem.path->nearest(plan.knots[k].p, near));
    near = frames[k].foot.arc_length;
  }
}

StageCost stageCost(const UavProblem& problem, int stage, const StageFrame& frame, const KinematicState& x) {
  const CostParameters& weights = problem.parameters->cost;
  const TargetState& target = problem.targets[static_cast<std::size_t>(stage)];
  const double dt = problem.dt;
  const double across = frame.horizontal.dot(x.p - frame.foot.position);
  const double above = frame.vertical.dot(x.p - frame.foot.position);
  const Vector3 behind = x.p - target.p;
  const Vector3 slower = x.v - target.v;
  const double velocity_weight = weights.eta * weights.velocity_time * weights.velocity_time;

  StageCost cost;
  cost.value = dt * (weights.alpha * across * across + weights.beta * above * above +
                     weights.eta * behind.squaredNorm() + velocity_weight * slower.squaredNorm());
  cost.position_gradient =
      2.0 * dt *
      (weights.alpha * across * frame.horizontal + weights.beta * above * frame.vertical + weights.eta * behind);
  cost.velocity_gradient = 2.0 * dt * velocity_weight * slower;
  cost.position_hessian =
      2.0 * dt *
      (weights.alpha * frame.horizontal * frame.horizontal.transpose() +
       weights.beta * frame.vertical * frame.vertical.transpose() + weights.eta * Matrix3::Identity());
  addRobustness(problem, stage, x.p, cost);
  cost.position_hessian += cost.robustness_hessian;
  return cost;
}

double velocityWeight(const Parameters& parameters) {
  const CostParameters& weights = parameters.cost;
  return 2.0 * parameters.time.sampling_time * weights.eta * weights.velocity_time * weights.velocity_time;
}

double jerkWeight(const Parameters& parameters) { return 2.0 * parameters.time.sampling_time * parameters.cost.zeta; }

double planCost(const UavProblem& problem, const Trajectory& plan) {
  StageFrames frames;
  findStageFrames(problem, plan, frames);
  double sum = 0.0;
  for (int k = 1; k <= kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    sum += stageCost(problem, k, frames[i], plan.knots[i]).value;
    sum += 0.5 * jerkWeight(*problem.parameters) * plan.jerks[i - 1].squaredNorm();
  }
  return sum;
}

}  // namespace swarm_planner
