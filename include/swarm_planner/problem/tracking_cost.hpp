// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// What cost (16) is measured against at one stage: the foot on the reference and the directions across it.
struct StageFrame {
  PathPoint foot;
  Vector3 horizontal = Vector3::UnitY();  ///< h = e3 x t normalised (e2 if the path is vertical)
  Vector3 vertical = Vector3::UnitZ();    ///< b = t x h
};
using StageFrames = std::array<StageFrame, kHorizon + 1>;

StageFrame makeStageFrame(const PathPoint& foot);

/// The frames of stages 1..N for a plan: each foot near the one before, so that it cannot jump where a path
/// crosses itself; stage 0 holds the start's.
void findStageFrames(const UavProblem& problem, const Trajectory& plan, StageFrames& frames);

/// Cost of one stage's state and its derivatives: the integrand of (17) without the jerk term, times dt. At the last
/// stage the velocity is not held against the target's but, with the acceleration, against rest, so that a plan ends
/// nearly at rest and the stop behind it is short: instead of eta's velocity term there stands, times dt,
///   stop_weight velocity_time^2 (|v_N|^2 + (dt / 3)^2 |a_N|^2).
/// The shortest stop takes two stages and goes dt (v_N + dt / 3 a_N): both count for as far as they carry. With
/// as_paper the last stage is like the others, as in (16). The gradient in the acceleration is accelerationWeight a.
struct StageCost {
  double value = 0.0;
  Vector3 position_gradient = Vector3::Zero();
  Vector3 velocity_gradient = Vector3::Zero();
  Matrix3 position_hessian = Matrix3::Zero();    ///< positive semi-definite
  Matrix3 robustness_hessian = Matrix3::Zero();  ///< the robustness term's part of it, projected
};
StageCost stageCost(const UavProblem& problem, int stage, const StageFrame& frame, const KinematicState& x);

/// Weights of 1/2 |v|^2 and 1/2 |a|^2 at stage 1..N and of 1/2 |jerk|^2 in the sum over the stages.
double velocityWeight(const Parameters& parameters, int stage);
double accelerationWeight(const Parameters& parameters, int stage);
double jerkWeight(const Parameters& parameters);

/// Cost (17) of a plan, its end held at rest, summed over the stages times dt; the constant -1 of (8) is left out.
double planCost(const UavProblem& problem, const Trajectory& plan);

}  // namespace swarm_planner
