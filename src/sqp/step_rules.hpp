// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "swarm_planner/model/trajectory.hpp"

namespace swarm_planner {

// What the SQP runs of one UAV and of several have in common.

constexpr std::array<double, 4> kStepLengths{1.0, 0.5, 0.25, 0.125};
constexpr double kForetold = 1e-3;    // of the gain
constexpr double kSlightGain = 1e-3;  // of the merit
constexpr int kMostTurns = 3;         // QPs of a run by which the planes of a plan that leans on bodies turn
constexpr double kSampleBand = 2.0;   // width of the band that gets rows, in the way flown per stage at full speed

/// Whether another QP after this one, the run's `number`th, has no more to gain, as it foretold what its step has
/// gained. A plan that leans on bodies gains more by planes that have turned with it, which no QP foretells: there the
/// gain has to be slight, too, or the planes have turned often enough for one cycle.
inline bool isForetold(double gain, double promised, double merit, bool leans, int number) {
  const bool planes_turn = leans && number < kMostTurns && gain >= kSlightGain * merit;
  return std::abs(gain - promised) < kForetold * promised && !planes_turn;
}

/// Largest distance between the knots of two plans [m].
inline double largestMove(const Trajectory& from, const Trajectory& to) {
  double largest = 0.0;
  for (std::size_t k = 0; k <= kHorizon; ++k) largest = std::max(largest, (to.knots[k].p - from.knots[k].p).norm());
  return largest;
}

/// The plan a step of `length` from `plan` towards the jerks of a QP's answer.
inline void stepTowards(const std::array<Vector3, kHorizon>& answer, double length, const KinematicState& start,
                        const Trajectory& plan, Trajectory& step) {
  for (std::size_t k = 0; k < kHorizon; ++k) step.jerks[k] = plan.jerks[k] + length * (answer[k] - plan.jerks[k]);
  rollOut(start, step);
}

}  // namespace swarm_planner
