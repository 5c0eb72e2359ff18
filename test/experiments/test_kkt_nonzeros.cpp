// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The published problem size. Counted here a second way: by posing the constraints as matrices.
#include <gtest/gtest.h>

#include "swarm_planner/experiments/kkt_nonzeros.hpp"
#include "swarm_planner/sqp/linearisation.hpp"

namespace swarm_planner {
namespace {

/// Entries of a row with normal `n` on an output: where n and the output's gain are nonzero.
long long entries(const OutputGains& gains, const Vector3& n) {
  long long count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (n(axis) == 0.0) continue;
    count += (gains.p != 0.0 ? 1 : 0) + (gains.v != 0.0 ? 1 : 0) + (gains.a != 0.0 ? 1 : 0);
  }
  return count;
}

class KktCount {
 public:
  explicit KktCount(const Mission& mission) : gains_(makeQpModels(mission.parameters).straight.outputs()) {}

  /// On the outputs of so many UAVs.
  void addRow(Output output, const Vector3& n, int uavs = 1) {
    // The row and its slack, the slack's sign, both mirrored; the slack's penalty.
    total_ += 2 * (uavs * entries(gains_[static_cast<std::size_t>(output)], n) + 1) + 2 + 1;
  }
  void addDynamics() {
    for (int k = 0; k < kHorizon; ++k) {
      // Columns of propagate(): how many of p, v, a each entry of the state or input moves.
      for (int column = 0; column < 12; ++column) {
        KinematicState x;
        Vector3 jerk = Vector3::Zero();
        (column < 3 ? x.p : column < 6 ? x.v : column < 9 ? x.a : jerk)(column % 3) = 1.0;
        if (k == 0 && column < 9) continue;
        const KinematicState next = propagate(x, jerk, 0.3);
        for (const Vector3& part : {next.p, next.v, next.a}) total_ += 2 * (part.array() != 0.0).count();
      }
      total_ += 2 * 9;                     // x_{k+1} itself
      total_ += 9 + 3 + 3;                 // Hessian
      if (k == kHorizon - 1) total_ += 3;  // that of the last acceleration
    }
  }
  long long total() const { return total_; }

 private:
  std::array<OutputGains, kOutputCount> gains_;
  long long total_ = 0;
};

constexpr std::array<Output, 4> kControlPoints = {Output::kPosition, Output::kControlPoint1, Output::kControlPoint2,
                                                  Output::kPosition};

TEST(KktNonzeros, CountsEveryEntryOfThePosedProblem) {
  Mission mission;
  mission.scenario.uavs.resize(4);
  mission.scenario.obstacles.resize(5);
  mission.scenario.workspace = Workspace();
  mission.parameters.limits.max_acceleration = 8.0;
  KktCount count(mission);
  count.addDynamics();
  const Vector3 full(1.0, 1.0, 1.0);
  for (int k = 0; k < kHorizon; ++k) {
    for (const Output output :
         {Output::kVelocity, Output::kVelocityControlPoint, Output::kAcceleration, Output::kThrustAcceleration}) {
      count.addRow(output, full);
    }
    count.addRow(Output::kThrustAcceleration, Vector3::UnitZ());
    for (std::size_t point = k > 0 ? 0 : 3; point < 4; ++point) {
      for (int body = 0; body < 5 + 3; ++body) count.addRow(kControlPoints[point], full);
      if (point == 0) continue;  // it is the last one of the segment before
      for (int axis = 0; axis < 3; ++axis) {
        count.addRow(kControlPoints[point], Vector3::Unit(axis));
        count.addRow(kControlPoints[point], -Vector3::Unit(axis));
      }
    }
  }
  EXPECT_EQ(kktNonzeros(mission), count.total());
}

TEST(KktNonzeros, HasNoRowBetweenTheSamplesWhereConstraintsHoldAtTheKnots) {
  Mission mission;
  mission.parameters.limits.segment_constraints = false;
  mission.scenario.uavs.resize(4);
  mission.scenario.workspace = Workspace();
  KktCount count(mission);
  count.addDynamics();
  const Vector3 full(1.0, 1.0, 1.0);
  for (int k = 0; k < kHorizon; ++k) {
    for (const Output output : {Output::kVelocity, Output::kThrustAcceleration}) count.addRow(output, full);
    count.addRow(Output::kThrustAcceleration, Vector3::UnitZ());
    for (int body = 0; body < 3; ++body) count.addRow(Output::kPosition, full);
    for (int axis = 0; axis < 3; ++axis) {
      count.addRow(Output::kPosition, Vector3::Unit(axis));
      count.addRow(Output::kPosition, -Vector3::Unit(axis));
    }
  }
  EXPECT_EQ(kktNonzeros(mission), count.total());
}

/// Entries of the dynamics' columns, counted by moving one variable after the other.
TEST(KktNonzeros, WithThePapersMethodCountsItsVariables) {
  Mission mission;
  mission.parameters.limits.segment_constraints = false;
  mission.parameters.limits.as_paper = true;
  mission.scenario.uavs.resize(1);
  long long count = 0;
  for (int k = 0; k < kHorizon; ++k) {
    for (int column = 0; column < 9; ++column) {
      KinematicState x;
      Vector3 a = Vector3::Zero();
      (column < 3 ? x.p : column < 6 ? x.v : a)(column % 3) = 1.0;
      if (k == 0 && column < 6) continue;
      const KinematicState next = propagateHeld(x, a, 0.3);
      for (const Vector3& part : {next.p, next.v}) count += 2 * (part.array() != 0.0).count();
    }
    count += 2 * 6;             // x_{k+1} itself
    count += 9 + 3 + 3;         // weights of p, v, and of a with its change
    if (k > 0) count += 2 * 3;  // the change, on either side of the diagonal
    count += 2 * (3 + 2) + 1;   // speed
    count += 2 * (6 + 2) + 1;   // most thrust
    count += 2 * (2 + 2) + 1;   // least thrust
  }
  EXPECT_EQ(kktNonzeros(mission), count);
  mission.scenario.obstacles.resize(1);
  EXPECT_EQ(kktNonzeros(mission), count + kHorizon * (2 * (3 + 2) + 1));
}

TEST(KktNonzeros, GrowsByTheSameForEveryUavOrObstacle) {
  Mission mission;
  mission.scenario.uavs.resize(1);
  const long long alone = kktNonzeros(mission);
  mission.scenario.uavs.resize(2);
  const long long two = kktNonzeros(mission);
  mission.scenario.uavs.resize(64);
  EXPECT_EQ(kktNonzeros(mission) - alone, 63 * (two - alone));
  mission.scenario.uavs.resize(1);
  mission.scenario.obstacles.resize(1);
  EXPECT_EQ(kktNonzeros(mission), two);
  mission.parameters.limits.avoidance = false;
  EXPECT_EQ(kktNonzeros(mission), alone);
}

// Of one UAV the joint problem is its own; of several, each pair's rows stand once and have the entries of both.
TEST(KktNonzeros, OfAllUavsAtOnceCountsEachPairOnce) {
  Mission mission;
  mission.scenario.obstacles.resize(3);
  mission.scenario.uavs.resize(1);
  const long long one = jointKktNonzeros(mission);
  EXPECT_EQ(one, kktNonzeros(mission));
  const Vector3 full(1.0, 1.0, 1.0);
  KktCount pair(mission);
  for (int k = 0; k < kHorizon; ++k) {
    for (std::size_t point = k > 0 ? 0 : 3; point < 4; ++point) pair.addRow(kControlPoints[point], full, 2);
  }
  mission.scenario.uavs.resize(6);
  EXPECT_EQ(jointKktNonzeros(mission), 6 * one + 15 * pair.total());
}

}  // namespace
}  // namespace swarm_planner
