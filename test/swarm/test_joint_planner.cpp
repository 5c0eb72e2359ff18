// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A small swarm planned at once: no UAV may be worse off than planned for one by one, and no plan may fly unchecked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "perfect_flight.hpp"
#include "swarm_planner/swarm/joint_planner.hpp"

namespace swarm_planner {
namespace {

constexpr double kRoundingOfGauge = 1e-6;

/// UAVs on a circle that change places with their opposites.
Mission swap(int uavs, double radius) {
  std::vector<Vector3> starts, ends;
  for (int i = 0; i < uavs; ++i) {
    const double angle = 2.0 * M_PI * i / uavs + 0.01 * i * i;
    starts.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 10.0);
    ends.emplace_back(-starts.back().x(), -starts.back().y(), 10.0);
  }
  return makeTestMission(starts, ends, 2.0);
}

TEST(JointPlanner, SwapsPlacesWithoutACollision) {
  for (const int uavs : {2, 4, 8}) {
    SCOPED_TRACE(uavs);
    PerfectFlight flight(swap(uavs, 12.0), 0.0, PlanningMode::kJoint);
    int refused = 0;
    for (int cycle = 0; cycle < 60; ++cycle) {
      const CycleReport& report = flight.cycle();
      for (const UavReport& uav : report.uavs) {
        EXPECT_TRUE(uav.planned);
        refused += uav.state != UavState::kTracking;
      }
    }
    EXPECT_GE(flight.leastPairGauge(), 1.0 - kRoundingOfGauge);
    EXPECT_LE(refused, 60 * uavs / 20);
    const Mission mission = swap(uavs, 12.0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(uavs); ++i) {
      EXPECT_LT((flight.vehicle(i).p - mission.scenario.uavs[i].reference.back()).norm(), 3.0) << "UAV " << i;
    }
  }
}

// Negative control: where nothing is avoided the same flight collides.
TEST(JointPlanner, WithoutAvoidanceTheSwapCollides) {
  Mission mission = swap(4, 12.0);
  mission.parameters.limits.avoidance = false;
  PerfectFlight flight(mission, 0.0, PlanningMode::kJoint);
  flight.cycles(40);
  EXPECT_LT(flight.leastPairGauge(), 0.9);
}

TEST(JointPlanner, UavsThatDoNotMeetFlyAsTheyWouldAlone) {
  const Mission mission = twoAbreast();
  PerfectFlight joint(mission, 0.0, PlanningMode::kJoint), iterative(mission);
  for (int cycle = 0; cycle < 30; ++cycle) {
    joint.cycle();
    iterative.cycle();
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LT((joint.vehicle(i).p - iterative.vehicle(i).p).norm(), 0.01) << "cycle " << cycle;
    }
  }
}

TEST(JointPlanner, OfUavsThatAreSentToOnePlaceOneGetsThereAndTheOthersPark) {
  const Vector3 end(0, 0, 10);
  const std::vector<Vector3> starts{{-9, 0, 10}, {0, 9, 10}, {8, 0, 10}, {0, -8, 10}};
  PerfectFlight flight(makeTestMission(starts, std::vector<Vector3>(starts.size(), end), 2.0), 0.0,
                       PlanningMode::kJoint);
  flight.cycles(60);
  int there = 0, parked = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    there += (flight.vehicle(i).p - end).norm() < 0.2 ? 1 : 0;
    parked += flight.planner().report().uavs[i].reason == Reason::kParked ? 1 : 0;
  }
  EXPECT_EQ(there, 1);
  EXPECT_EQ(parked, 3);
  EXPECT_GE(flight.leastPairGauge(), 1.0 - kRoundingOfGauge);
}

TEST(JointPlanner, SolvesNoFurtherQpOnceTheTimeIsSpent) {
  PerfectFlight flight(swap(4, 12.0), 0.0, PlanningMode::kJoint), unhurried(swap(4, 12.0), 0.0, PlanningMode::kJoint);
  int most = 0;
  for (int cycle = 0; cycle < 60; ++cycle) {
    const CycleReport& report = flight.cycle(nullptr, 0.0);
    // The first is planned for anew if its joint plan is refused.
    for (std::size_t i = 1; i < 4; ++i) EXPECT_LE(report.uavs[i].sqp_iterations, 1) << "cycle " << cycle;
    for (const UavReport& uav : unhurried.cycle().uavs) most = std::max(most, uav.sqp_iterations);
  }
  EXPECT_GT(most, 1) << "no QP more would have been solved anyway";
  EXPECT_GE(flight.leastPairGauge(), 1.0 - kRoundingOfGauge);
}

TEST(JointPlanner, GoesOnWhereAUavIsNotSeen) {
  PerfectFlight flight(crossingPair(), 0.0, PlanningMode::kJoint);
  flight.cycles(10);
  for (int cycle = 0; cycle < 30; ++cycle) {
    const CycleReport& report = flight.cycle([](Snapshot& snapshot) { snapshot.uavs[0].stamp -= 100.0; });
    EXPECT_EQ(report.uavs[0].state, UavState::kLost);
    EXPECT_TRUE(report.uavs[1].planned);
  }
  EXPECT_GE(flight.leastPairGauge(), 1.0 - kRoundingOfGauge);
}

TEST(JointPlanner, LandsAndHoldsWithTheOthersFlying) {
  PerfectFlight flight(swap(4, 12.0), 0.0, PlanningMode::kJoint);
  flight.cycles(5);
  EXPECT_TRUE(flight.planner().command(0, FlightCommand::kHold).accepted);
  EXPECT_TRUE(flight.planner().command(1, FlightCommand::kLand).accepted);
  flight.cycles(60);
  EXPECT_GE(flight.leastPairGauge(), 1.0 - kRoundingOfGauge);
  EXPECT_LT(flight.vehicle(0).v.norm(), 0.05);
}

TEST(JointPlanner, RefusesMoreUavsThanItsSolverIsMadeFor) {
  EXPECT_FALSE(planningModeFault(PlanningMode::kIterative, 1000, true));
  EXPECT_FALSE(planningModeFault(PlanningMode::kJoint, kMostJointUavs, false));
  const auto fault = planningModeFault(PlanningMode::kJoint, kMostJointUavs + 1, false);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find("at most 8"), std::string::npos) << *fault;
  EXPECT_NE(fault->find("has 9"), std::string::npos) << *fault;
  EXPECT_THROW(SwarmPlanner(swap(9, 20.0), PlanningMode::kJoint), std::invalid_argument);
}

TEST(JointPlanner, RefusesThePapersMethodAlone) {
  EXPECT_TRUE(planningModeFault(PlanningMode::kJoint, 2, true));
  EXPECT_TRUE(planningModeFault(PlanningMode::kGroups, 2, true));
}

}  // namespace
}  // namespace swarm_planner
