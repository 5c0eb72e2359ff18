// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {

/// Two UAVs of a joint problem that are to keep apart, eq. (14), both of them moving.
struct UavPair {
  std::size_t first = 0, second = 1;        ///< indices in JointProblem::uavs, first < second
  double horizontal = 0.0, vertical = 0.0;  ///< semi-axes of the pair ellipsoid [m]
  double margin = 0.0;                      ///< of them, that may be waived at a start that is too close [m]

  /// The second one's motion as the first one has to keep clear of it. The motion must outlive the body.
  MovingBody bodyOfSecond(const KinematicState& first_start, const PredictedMotion& second_motion) const;
};

/// Problem 1: the nonlinear programs of several UAVs as one. A UAV's own `bodies` hold what is not planned with it.
struct JointProblem {
  std::vector<const UavProblem*> uavs;
  std::vector<UavPair> pairs;  ///< ordered, each once
};

/// What others see of a plan on the stages of its own horizon; exact.
void predict(const Trajectory& plan, PredictedMotion& predicted);

/// The half-spaces of the newest QP: those of each UAV, and those of the pairs, whose SegmentPlane::body is the index
/// in JointProblem::pairs.
struct JointPlanes {
  std::vector<SegmentPlanes> of_uavs;
  SegmentPlanes of_pairs;
};

/// The exact penalty function that every step has to decrease, in parts.
struct JointMerit {
  std::vector<double> of_uavs;            ///< as each UAV's own problem has it
  std::vector<double> of_pairs;           ///< the penalty of each pair, counted once
  std::vector<double> largest_violation;  ///< of each UAV, pairs included

  double value() const;
};

/// `motions`: of the plans, see predict(). Writes to `merit`, which keeps its memory.
void findJointMerit(const JointProblem& problem, const std::vector<Trajectory>& plans,
                    const std::vector<PredictedMotion>& motions, const JointPlanes& planes, JointMerit& merit);

}  // namespace swarm_planner
