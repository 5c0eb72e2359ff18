// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/kkt_nonzeros.hpp"

#include <cmath>

#include "swarm_planner/model/trajectory.hpp"

namespace swarm_planner {
namespace {

constexpr long long kAxes = 3;

/// Rows and their entries in the state.
struct RowCount {
  long long rows = 0;
  long long entries = 0;

  void add(long long count, long long entries_each) {
    rows += count;
    entries += count * entries_each;
  }
};

/// `per_point` half-spaces on the control points of all segments, or `at_knots` alone, with `axes` entries per part of
/// the state. The first three points of the first segment are fixed by the start.
void addControlPointRows(long long per_point, long long axes, bool at_knots, bool with_first_point, RowCount& count) {
  count.add(per_point * kHorizon, axes);  // the next stage's p
  if (at_knots) return;
  const long long free_segments = kHorizon - 1;
  if (with_first_point) count.add(per_point * free_segments, axes);  // p
  count.add(per_point * free_segments, 2 * axes);                    // p and v
  count.add(per_point * free_segments, 3 * axes);                    // p, v and a
}

/// Rows of one UAV that keeps clear of `bodies` that it does not plan for itself.
RowCount countRows(const Mission& mission, std::size_t bodies) {
  const Scenario& scenario = mission.scenario;
  const LimitParameters& limits = mission.parameters.limits;
  const bool at_knots = !limits.segment_constraints;
  RowCount count;
  count.add(kHorizon, kAxes);                                              // speed
  if (!at_knots) count.add(kHorizon, 2 * kAxes);                           // speed between the samples: v and a
  if (std::isfinite(limits.max_acceleration)) count.add(kHorizon, kAxes);  // acceleration
  count.add(kHorizon, 2 * kAxes);                                          // most thrust: v and a
  count.add(kHorizon, 2);                                                  // least thrust, upwards
  if (scenario.workspace) addControlPointRows(2 * kAxes, 1, at_knots, false, count);
  if (limits.avoidance) addControlPointRows(static_cast<long long>(bodies), kAxes, at_knots, true, count);
  return count;
}

/// Hessian and dynamics, one triangle of the latter, with the acceleration as input: its change couples neighbours.
long long heldAccelerationEntries() {
  const long long hessian = kHorizon * (kAxes * kAxes + kAxes + kAxes) + (kHorizon - 1) * 2 * kAxes;
  const long long dynamics = kHorizon * (6 + 6) + (kHorizon - 1) * 9;
  return hessian + 2 * dynamics;
}

/// Of the QP of so many UAVs with these rows.
long long nonzeros(long long uavs, const RowCount& rows) {
  const long long last_acceleration = kAxes;
  const long long hessian = kHorizon * (kAxes * kAxes + kAxes + kAxes) + last_acceleration;
  const long long dynamics = kHorizon * (9 + 9) + (kHorizon - 1) * 18;
  const long long inequalities = rows.entries + 2 * rows.rows;
  return uavs * (hessian + 2 * dynamics) + rows.rows + 2 * inequalities;
}

}  // namespace

long long kktNonzeros(const Mission& mission) {
  const std::size_t others = mission.scenario.uavs.empty() ? 0 : mission.scenario.uavs.size() - 1;
  const RowCount rows = countRows(mission, mission.scenario.obstacles.size() + others);
  if (mission.parameters.limits.as_paper) {
    return heldAccelerationEntries() + rows.rows + 2 * (rows.entries + 2 * rows.rows);
  }
  return nonzeros(1, rows);
}

long long jointKktNonzeros(const Mission& mission) {
  const auto uavs = static_cast<long long>(mission.scenario.uavs.size());
  const RowCount own = countRows(mission, mission.scenario.obstacles.size());
  RowCount rows{uavs * own.rows, uavs * own.entries};
  const LimitParameters& limits = mission.parameters.limits;
  if (limits.avoidance) {
    addControlPointRows(uavs * (uavs - 1) / 2, 2 * kAxes, !limits.segment_constraints, true, rows);
  }
  return nonzeros(uavs, rows);
}

}  // namespace swarm_planner
