// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a map that ships is not the one that is documented, or a scenario begins inside a wall.
#include <gtest/gtest.h>

#include "support/temporary_directory.hpp"
#include "swarm_planner/config/tight_scenarios.hpp"
#include "swarm_planner/experiments/flight_bounds.hpp"
#include "swarm_planner/experiments/generated_maps.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {
namespace {

TEST(GeneratedMaps, ShippedFilesAreWhatTheGeneratorMakes) {
  ASSERT_GE(generatedMaps().size(), 2U);
  for (const GeneratedMap& map : generatedMaps()) {
    const std::vector<std::uint8_t> made = map.file();
    const std::string shipped = contentOf("config/maps/" + map.name + ".bt");
    EXPECT_TRUE(std::string(made.begin(), made.end()) == shipped) << map.name;
    EXPECT_LT(made.size(), 200000U) << map.name;
  }
}

TEST(GeneratedMaps, TheForestHasItsTreesAsVoxels) {
  Scenario expected = forest(10, kForestGap, 0);
  const Mission mission = loadMission("config/scenarios/forest_map.yaml", {});
  for (const ScenarioObstacle& obstacle : expected.obstacles) {
    const Vector3 trunk(obstacle.center.x(), obstacle.center.y(), 2.5);
    EXPECT_TRUE(mission.map->isOccupied(trunk)) << obstacle.id;
    // A voxel's corner is 0.17 m from its middle.
    EXPECT_LE(mission.map->distance(trunk + Vector3(obstacle.radii.x(), 0, 0), 1.0), 0.2) << obstacle.id;
  }
  expected.obstacles.clear();
  expected.name = "forest_map";
  expected.map_file = mission.scenario.map_file;
  EXPECT_EQ(toYaml(mission.scenario), toYaml(expected));
}

TEST(GeneratedMaps, EveryReferenceInTheBuildingIsFree) {
  const Mission mission = loadMission("config/scenarios/building.yaml", {});
  for (const ScenarioUav& uav : mission.scenario.uavs) {
    for (std::size_t i = 1; i < uav.reference.size(); ++i) {
      for (double share = 0.0; share <= 1.0; share += 0.01) {
        const Vector3 p = uav.reference[i - 1] + share * (uav.reference[i] - uav.reference[i - 1]);
        EXPECT_GE(mission.map->distance(p, 1.0), 0.35) << uav.name << ' ' << p.transpose();
      }
    }
  }
}

TEST(GeneratedMaps, UnknownSpaceOutsideTheBuildingMayCountAsOccupied) {
  const TemporaryDirectory directory;
  Scenario scenario = loadMission("config/scenarios/building.yaml", {}).scenario;
  scenario.unknown_is_occupied = true;
  const Mission mission = makeMission(scenario, {}, "test");
  EXPECT_TRUE(mission.map->isOccupied(Vector3(-1, 6, 1.2)));
  EXPECT_FALSE(mission.map->isOccupied(Vector3(9, 6, 1.2)));
}

TEST(GeneratedMaps, TheShortestPathLeadsThroughADoor) {
  Scenario scenario = loadMission("config/scenarios/building.yaml", {}).scenario;
  // From the middle room in the south straight into the middle room in the north.
  scenario.uavs.resize(1);
  scenario.uavs[0].start = Vector3(7.5, 4.0, 1.2);
  scenario.uavs[0].reference = {Vector3(7.5, 4.0, 1.2), Vector3(7.5, 8.0, 1.2)};
  const auto bounds = flightBounds(makeMission(scenario, {}, "test"), true);
  ASSERT_TRUE(bounds[0].shortest_path);
  // Doors begin at x = 8.6 and 9.6 m: by (8.8, 4.8), (8.8, 5), (9.8, 7) and (9.8, 7.2), 0.2 m off the corners, 6.6 m.
  EXPECT_GT(*bounds[0].shortest_path, 6.3);
  EXPECT_LT(*bounds[0].shortest_path, 6.9);
}

}  // namespace
}  // namespace swarm_planner
