// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimality/recorded_flights.hpp"

namespace swarm_planner {

/// Gaps relative to costs below this are relative to it: of UAVs that are where they should be nothing is left but
/// rounding. A UAV 4 cm from its target all along has it.
constexpr double kLeastCost = 1e-3;

/// One program, solved both ways from the same start.
struct ComparedProgram {
  std::string scenario;
  std::size_t uav = 0;
  double epoch = 0.0;           ///< [s]
  bool is_constrained = false;  ///< something was near enough to matter
  double start_cost = 0.0;      ///< of the guess
  double cost = 0.0;            ///< ours, with penalties, after the iterations in flight
  double reference = 0.0;       ///< of Ipopt's local optimum
  double nearby = 0.0;          ///< of that which Ipopt finds from our plan; only where `reference` is far better
  double converged = 0.0;       ///< ours after many more iterations; only where `reference` is far better
  int iterations = 0;           ///< ours
  double slack = 0.0;           ///< the largest violation of ours
  double reference_slack = 0.0;

  double gap() const;
  /// To the optimum next to our plan.
  double nearbyGap() const;
  /// What would be left after many more iterations.
  double convergedGap() const;
};

/// Ipopt could not solve a program: `failed` counts them.
struct ComparedPrograms {
  std::vector<ComparedProgram> programs;
  int failed = 0;
};

/// Compares our plans with Ipopt's, up to `most` programs of a mission.
void compareWithIpopt(const Mission& mission, int stride, int most, ComparedPrograms& result);

}  // namespace swarm_planner
