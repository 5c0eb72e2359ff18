// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, UAVs fly into the walls of a map.
#include <gtest/gtest.h>

#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/experiments/collision_partner.hpp"

namespace swarm_planner {
namespace {

RunResult flown(const Scenario& scenario, const ParameterMap& given) {
  const Mission mission = makeMission(scenario, given, scenario.name);
  IterativePlanner planner(mission);
  return ClosedLoopRun(mission, planner, 0).fly();
}

TEST(MapFlights, EveryUavArrivesInTheBuilding) {
  const RunResult run = flown(loadMission("config/scenarios/building.yaml", {}).scenario, {});
  EXPECT_TRUE(run.flown.collisions.empty());
  EXPECT_EQ(run.flown.arrived_uavs, 6);
  ASSERT_TRUE(run.flown.min_obstacle_clearance);
  EXPECT_GT(*run.flown.min_obstacle_clearance, 0.0);
}

TEST(MapFlights, AUavThatIsSentThroughAWallKeepsClearOfItOnlyWithAvoidance) {
  Scenario scenario = loadMission("config/scenarios/building.yaml", {}).scenario;
  scenario.uavs.resize(1);
  scenario.uavs[0].start = Vector3(7.5, 3.5, 1.2);
  scenario.uavs[0].reference = {Vector3(7.5, 3.5, 1.2), Vector3(7.5, 9.0, 1.2)};
  scenario.end = EndCondition();
  scenario.end.duration = 10.0;
  EXPECT_TRUE(flown(scenario, {}).flown.collisions.empty());
  const RunResult run = flown(scenario, {{"avoidance", false}, {"plan_check", false}});
  ASSERT_EQ(run.flown.collisions.size(), 2U) << "both walls of the corridor";
  EXPECT_EQ(collisionPartner(run.flown.collisions[0], scenario), "the map");
}

}  // namespace
}  // namespace swarm_planner
