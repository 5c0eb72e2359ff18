// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "support/random.hpp"
#include "swarm_planner/solver/recorded_problems.hpp"

namespace swarm_planner {

/// A problem of the recorded kind, N = 20, and the multipliers of its optimum.
struct KnownRecordedProblem {
  RecordedProblem problem;
  RecordedMultipliers multipliers;
  int softened = 0;  ///< half-spaces with slack at the optimum
};

/// Controls that touch bounds of velocity and acceleration, thrust limits and half-spaces; the references are then
/// chosen so that these controls are optimal. Data are rounded to single precision, as in a file, and the conditions
/// of the optimum solved once more for them, by one dense factorisation. The guess is the optimum's.
/// @param rows half-spaces per stage
KnownRecordedProblem makeRecordedProblem(int rows, Random& random);

/// Writes a "QMPCQP01" file.
void writeRecordedProblems(const std::string& path, const RecordedProblems& file);

}  // namespace swarm_planner
