// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "swarm_planner/solver/qp.hpp"

namespace swarm_planner {

/// Most UAVs of a JointQp, and most rows for pairs of them: a row for each pair, segment and control point. Fixed when
/// the solver is generated.
constexpr std::size_t kMostJointUavs = 8;
constexpr std::size_t kMostPairRows = kMostJointUavs * (kMostJointUavs - 1) / 2 * kHorizon * 4;

/// Soft half-space n . (y_first - y_second) + s >= d on an output of two UAVs at a stage; penalty as QpRow's.
struct PairRow {
  int stage = 1;
  Output output = Output::kPosition;
  std::size_t first = 0, second = 1;  ///< indices in JointQp::uavs
  Vector3 n = Vector3::Zero();
  double d = 0.0;
  RowSource source = 0;
};

/// Pair rows that are active at an optimum; a guess of those of the next QP.
struct ActivePairRows {
  std::vector<ActiveRow> rows;  ///< room for kMostPairRows

  ActivePairRows() { rows.reserve(kMostPairRows); }
  /// Moves all `stages` stages towards the horizon's start; what passes it is dropped.
  void shift(int stages);
};

/// The QPs of several UAVs as one, with rows for pairs of them. Always feasible since every row is soft.
struct JointQp {
  std::size_t count = 0;  ///< of UAVs in use
  /// UAVs that are left as they are: the rest is the problem, and no pair row touches them.
  std::array<bool, kMostJointUavs> is_left{};
  std::vector<std::unique_ptr<Qp>> uavs;  ///< kMostJointUavs; every model has the same penalty
  std::vector<PairRow> pair_rows;         ///< at most kMostPairRows

  JointQp();
};

/// For each UAV the number of its component: UAVs that pair rows connect, directly or by others. Numbers begin at 0.
using JointComponents = std::array<std::size_t, kMostJointUavs>;
/// Gives UAVs of two components the same number.
void join(std::size_t first, std::size_t second, std::size_t count, JointComponents& components);
JointComponents findComponents(const JointQp& qp);

/// Objective of one component's plans, with every row's slack at its best. `plans`: one for each UAV.
double objective(const JointQp& qp, const std::vector<Trajectory>& plans, const JointComponents& components,
                 std::size_t component);

struct JointQpSolution {
  QpStatus status = QpStatus::kNoAnswer;
  int iterations = 0;  ///< changes of the active set
  double max_slack = 0.0;
  std::array<std::array<Vector3, kHorizon>, kMostJointUavs> jerks;
  std::array<ActiveRows, kMostJointUavs> active;
  ActivePairRows active_pairs;
};

/// A solver of JointQp. Keeps its memory; never allocates while solving.
class JointQpSolver {
 public:
  virtual ~JointQpSolver() = default;
  /// The active rows as they come in are taken for a guess, which changes the time, not the answer. What the solution
  /// says of UAVs that are left stays as it is.
  virtual QpStatus solve(const JointQp& qp, JointQpSolution& solution) = 0;
};

}  // namespace swarm_planner
