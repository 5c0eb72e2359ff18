// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <deque>
#include <limits>

#include "support/flight_problem.hpp"
#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// Limits of the default parameters without workspace: pairs 2 m + 0.2 m.
CheckLimits defaultCheckLimits();

/// A plan with all that it is checked against; owns what the surroundings point to.
class CheckScene {
 public:
  CheckScene() : limits(defaultCheckLimits()) {}
  CheckScene(const CheckScene&) = delete;
  CheckScene& operator=(const CheckScene&) = delete;

  /// Plans from `start` with small random jerks, dt 0.15 s or 0.3 s, epoch about 1e6 s; `speed` up to [m/s].
  void planRandomly(Random& random, double speed);
  void plan(const Trajectory& trajectory);
  /// An obstacle of any shape, exponents 2 to 10, about `clearance` [m] from where the motion is at some time.
  void addRandomObstacle(Random& random, double clearance);
  /// 0.5 m from its surface; seen at the epoch.
  void addObstacle(const Superellipsoid& body);
  /// A UAV on a random motion of its own epoch and dt, about `gauge` from this one at some time.
  void addRandomUav(Random& random, double gauge);
  void addUav(const Trajectory& trajectory);
  void addMotion(const CommittedMotion& other, double valid_until = std::numeric_limits<double>::infinity());

  CheckVerdict check() { return checkPlan(trajectory, start, committed, limits, surroundings, motion); }

  CheckLimits limits;
  CheckSurroundings surroundings;
  Trajectory trajectory;
  KinematicState start;
  /// Where the motion committed before is at the epoch [m]: clear of everything unless a test places it.
  Vector3 committed = Vector3::Constant(1e5);
  CommittedMotion motion;  ///< of the plan, whether it was accepted or not
  std::deque<Superellipsoid> bodies;
  std::deque<CommittedMotion> others;
};

/// The least clearance beyond what the rule of plan_check.hpp demands, by samples 1 ms apart until the end of the
/// look-ahead: obstacles in metres, pairs in metres along the shorter semi-axis. Computed from the rule as it is
/// stated, with none of the check's code but CommittedMotion::after. `waived`: whether less than the
/// least was demanded, since the motion before had less. Where it gets 0.3 m too small the rest is left out.
struct SampledSlack {
  double slack = 0.0;
  double time = 0.0;  ///< of the least [s]
  bool waived = false;
};
SampledSlack sampledSlack(const CheckScene& scene);
SampledSlack sampledObstacleSlack(const CheckScene& scene, const PredictedObstacle& obstacle);
SampledSlack sampledPairSlack(const CheckScene& scene, const OtherMotion& other);

}  // namespace swarm_planner
