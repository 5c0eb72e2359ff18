// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a run starts that cannot be flown safely, or its author is not told all that is wrong with it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include "support/temporary_directory.hpp"
#include "swarm_planner/map/octree_writer.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {
namespace {

ScenarioUav uavAt(const std::string& name, const Vector3& start) {
  ScenarioUav uav;
  uav.name = name;
  uav.start = start;
  uav.reference = {start, start + Vector3(100, 0, 0)};
  uav.target = {5.0, 3.0};
  return uav;
}

ScenarioObstacle obstacleAt(int id, const Vector3& center) {
  ScenarioObstacle obstacle;
  obstacle.id = id;
  obstacle.center = center;
  obstacle.radii = Vector3(1, 2, 3);
  obstacle.exponents = Vector3(2, 4, 2.5);
  return obstacle;
}

Scenario soundScenario() {
  Scenario scenario;
  scenario.name = "sound";
  scenario.end.duration = 10.0;
  scenario.uavs = {uavAt("alpha", Vector3(0, 0, 10)), uavAt("bravo", Vector3(0, 5, 10))};
  scenario.obstacles = {obstacleAt(3, Vector3(20, 0, 10))};
  return scenario;
}

/// The faults of a scenario, empty if it is sound.
std::string faultsOf(const Scenario& scenario, const ParameterMap& given = {}) {
  try {
    makeMission(scenario, given, "test");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" not found in: " << text;
}

TEST(Mission, KeepsASoundScenarioAndItsParameters) {
  Scenario scenario = soundScenario();
  scenario.overrides["max_speed"] = 4.0;
  const Mission mission = makeMission(scenario, {{"eta", 0.7}, {"max_speed", 2.0}}, "test");
  EXPECT_EQ(mission.scenario.uavs.size(), 2U);
  EXPECT_EQ(mission.scenario.uavs[1].name, "bravo");
  EXPECT_EQ(mission.parameters.cost.eta, 0.7);
  EXPECT_EQ(mission.parameters.limits.max_speed, 4.0);  // the scenario's own limit goes before what is given
}

TEST(Mission, RefusesUavsThatStartInsideThePairEllipsoid) {
  Scenario scenario = soundScenario();
  scenario.uavs[1].start = Vector3(1.0, 1.6, 10.5);
  const std::string faults = faultsOf(scenario);
  EXPECT_TRUE(contains(faults, "test"));
  EXPECT_TRUE(contains(faults, "uavs[1].start"));
  EXPECT_TRUE(contains(faults, "alpha"));
  EXPECT_TRUE(contains(faults, "bravo"));
  EXPECT_TRUE(contains(faults, "pair_distance"));
  // At exactly the distance they may start.
  scenario.uavs[1].start = Vector3(0, 2, 10);
  EXPECT_EQ(faultsOf(scenario), "");
}

TEST(Mission, TakesTheVerticalDistanceForPairsAboveEachOther) {
  Scenario scenario = soundScenario();
  scenario.uavs[1].start = Vector3(0.5, 0, 13);
  EXPECT_EQ(faultsOf(scenario), "");
  scenario.overrides["pair_distance_vertical"] = 4.0;
  EXPECT_TRUE(contains(faultsOf(scenario), "alpha and bravo"));
}

TEST(Mission, FindsEveryClosePairAlongAnyAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    Scenario scenario = soundScenario();
    scenario.uavs.clear();
    for (int i = 0; i < 30; ++i) {
      // Shuffled along the axis, each within 2 m of its two neighbours only.
      Vector3 start(-40, 20, 10);
      start[axis] += 1.5 * ((i * 7) % 30);
      scenario.uavs.push_back(uavAt("uav" + std::to_string(i), start));
    }
    EXPECT_EQ(count(faultsOf(scenario), " start 1.5 m apart"), 29U) << "axis " << axis;
  }
}

TEST(Mission, RefusesUavsOnTopOfEachOther) {
  Scenario scenario = soundScenario();
  scenario.uavs.push_back(uavAt("charlie", scenario.uavs[0].start));
  EXPECT_TRUE(contains(faultsOf(scenario), "alpha and charlie start 0 m apart"));
}

TEST(Mission, RefusesStartsInsideObstaclesAndTooCloseToThem) {
  Scenario scenario = soundScenario();
  scenario.uavs[0].start = Vector3(20.5, 0, 10);
  EXPECT_TRUE(contains(faultsOf(scenario), "alpha starts inside obstacle 3"));

  scenario.uavs[0].start = Vector3(18.8, 0, 10);  // 0.2 m from the surface
  const std::string faults = faultsOf(scenario);
  EXPECT_TRUE(contains(faults, "uavs[0].start"));
  EXPECT_TRUE(contains(faults, "alpha starts 0.2 m from the surface of obstacle 3"));
  EXPECT_TRUE(contains(faults, "uav_radius"));

  scenario.overrides["uav_radius"] = 0.15;
  EXPECT_EQ(faultsOf(scenario), "");
}

TEST(Mission, HeedsAnObstaclesYaw) {
  Scenario scenario = soundScenario();
  scenario.uavs[0].start = Vector3(21.5, 0, 10);
  EXPECT_EQ(faultsOf(scenario), "");
  scenario.obstacles[0].yaw = M_PI / 2;  // its long axis now points along x
  EXPECT_TRUE(contains(faultsOf(scenario), "alpha starts inside obstacle 3"));
}

TEST(Mission, RefusesStartsOutsideTheWorkspace) {
  Scenario scenario = soundScenario();
  scenario.workspace = Workspace{Vector3(-1, -1, 1), Vector3(100, 4, 20)};
  EXPECT_TRUE(contains(faultsOf(scenario), "bravo starts outside the workspace"));
  scenario.workspace->max.y() = 5.0;
  EXPECT_EQ(faultsOf(scenario), "");
}

TEST(Mission, ListsAllFaultsAtOnce) {
  Scenario scenario = soundScenario();
  scenario.uavs.push_back(uavAt("charlie", Vector3(0, 1, 10)));
  scenario.uavs.push_back(uavAt("delta", Vector3(20, 0, 10)));
  scenario.workspace = Workspace{Vector3(-1, -1, 1), Vector3(100, 4, 20)};
  const std::string faults = faultsOf(scenario, {{"eta", -1.0}, {"no_such_parameter", 1.0}});
  EXPECT_TRUE(contains(faults, "alpha and charlie"));
  EXPECT_TRUE(contains(faults, "delta starts inside"));
  EXPECT_TRUE(contains(faults, "bravo starts outside"));
  EXPECT_TRUE(contains(faults, "eta"));
  EXPECT_TRUE(contains(faults, "no_such_parameter"));
  EXPECT_EQ(count(faults, "\n"), 4U);
}

TEST(Mission, DoesNotJudgeStartsByAFaultyDistance) {
  Scenario scenario = soundScenario();
  scenario.uavs[1].start = Vector3(0, 1.5, 10);
  scenario.uavs[0].start = Vector3(0, 0, 10);
  const std::string faults = faultsOf(scenario, {{"pair_distance", -1.0}});
  EXPECT_TRUE(contains(faults, "pair_distance"));
  EXPECT_EQ(count(faults, "apart"), 0U);
}

TEST(Mission, HoldsAProgramsScenarioToTheRulesOfAFile) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scenario scenario = soundScenario();
  scenario.uavs.clear();
  EXPECT_TRUE(contains(faultsOf(scenario), "uavs"));

  scenario = soundScenario();
  scenario.uavs[1].name = "alpha";
  EXPECT_TRUE(contains(faultsOf(scenario), "uavs[1].name"));

  scenario = soundScenario();
  scenario.uavs[0].start.y() = nan;
  scenario.uavs[1].reference.clear();
  scenario.obstacles[0].radii.x() = 0.0;
  scenario.obstacles[0].exponents.z() = 1.0;
  const std::string faults = faultsOf(scenario);
  EXPECT_TRUE(contains(faults, "uavs[0].start"));
  EXPECT_TRUE(contains(faults, "uavs[1].reference"));
  EXPECT_TRUE(contains(faults, "obstacles[0].radii"));
  EXPECT_TRUE(contains(faults, "obstacles[0].exponents"));
}

TEST(Mission, OfOneUavIsSound) {
  Scenario scenario = soundScenario();
  scenario.uavs.pop_back();
  scenario.obstacles.clear();
  EXPECT_EQ(faultsOf(scenario), "");
}

class ScenarioFile : public testing::Test {
 protected:
  void SetUp() override { path_ = testing::TempDir() + "mission_test_scenario.yaml"; }
  void TearDown() override { std::remove(path_.c_str()); }

  void write(const std::string& yaml) const { std::ofstream(path_) << yaml; }

  std::string path_;
};

TEST_F(ScenarioFile, IsLoadedWithItsParameters) {
  Scenario scenario = soundScenario();
  scenario.overrides["uav_radius"] = 0.25;
  write(toYaml(scenario));
  const Mission mission = loadMission(path_, {});
  EXPECT_EQ(mission.scenario.name, "sound");
  EXPECT_EQ(mission.parameters.limits.uav_radius, 0.25);
}

TEST_F(ScenarioFile, WithFaultsIsNamedWithAllOfThem) {
  Scenario scenario = soundScenario();
  scenario.uavs[1].start = Vector3(0, 1, 10);
  write(toYaml(scenario));
  try {
    loadMission(path_, {{"eta", -1.0}});
    FAIL() << "a mission with faults was accepted";
  } catch (const ConfigError& error) {
    EXPECT_TRUE(contains(error.what(), path_));
    EXPECT_TRUE(contains(error.what(), "alpha and bravo"));
    EXPECT_TRUE(contains(error.what(), "eta"));
  }
  write(toYaml(scenario) + "colour: red\n");
  try {
    loadMission(path_, {{"eta", -1.0}});
    FAIL() << "a mission with faults was accepted";
  } catch (const ConfigError& error) {
    EXPECT_TRUE(contains(error.what(), "colour"));
    EXPECT_TRUE(contains(error.what(), "eta"));
  }
}

TEST_F(ScenarioFile, ThatIsMissingIsAFault) { EXPECT_THROW(loadMission("/no/such/file.yaml", {}), ConfigError); }

TEST(Obstacle, HasTheShapeOfItsScenario) {
  ScenarioObstacle obstacle = obstacleAt(9, Vector3(1, 2, 3));
  obstacle.yaw = 0.5;
  obstacle.velocity = Vector3(0, 1, 0);
  const Superellipsoid shape = makeObstacle(obstacle);
  EXPECT_EQ(shape.id(), 9);
  EXPECT_EQ((shape.center() - Vector3(1, 2, 3)).norm(), 0.0);
  EXPECT_EQ((shape.radii() - Vector3(1, 2, 3)).norm(), 0.0);
  EXPECT_EQ((shape.exponents() - Vector3(2, 4, 2.5)).norm(), 0.0);
  EXPECT_EQ(shape.yaw(), 0.5);
  EXPECT_EQ((shape.velocity() - Vector3(0, 1, 0)).norm(), 0.0);
  obstacle.radii.y() = 0.0;
  EXPECT_THROW(makeObstacle(obstacle), std::invalid_argument);
}

/// A scenario whose file lies beside a map: a wall of voxels 1 m wide at x = 4 to 5 m, y from 0 to 10, z from 5 to 15.
class MissionWithMap : public testing::Test {
 protected:
  MissionWithMap() {
    OctreeWriter writer(1.0);
    for (int y = 0; y < 10; ++y) {
      for (int z = 5; z < 15; ++z) writer.set({4, y, z}, true);
    }
    const std::vector<std::uint8_t> bytes = writer.file();
    std::ofstream(directory_.file("wall.bt"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  std::string write(Scenario scenario, const std::string& map_file) {
    scenario.map_file = map_file;
    const std::string path = directory_.file("scenario.yaml");
    std::ofstream(path) << toYaml(scenario);
    return path;
  }
  std::string faults(const Scenario& scenario, const std::string& map_file) {
    try {
      loadMission(write(scenario, map_file), {});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryDirectory directory_;
};

TEST_F(MissionWithMap, TheMapIsReadFromBesideTheScenario) {
  const Mission mission = loadMission(write(soundScenario(), "wall.bt"), {});
  ASSERT_NE(mission.map, nullptr);
  EXPECT_EQ(mission.map->occupiedCount(), 100U);
  EXPECT_NE(loadMission(write(soundScenario(), directory_.file("wall.bt")), {}).map, nullptr) << "an absolute path";
  EXPECT_EQ(loadMission(write(soundScenario(), ""), {}).map, nullptr);
}

TEST_F(MissionWithMap, UavsThatStartInTheMapAreAllNamed) {
  Scenario scenario = soundScenario();
  scenario.uavs[0].start = Vector3(3.8, 2.5, 10.0);
  scenario.uavs[1].start = Vector3(4.5, 7.5, 10.0);
  const std::string text = faults(scenario, "wall.bt");
  EXPECT_NE(text.find("uavs[0].start: alpha starts 0.2 m from an occupied voxel of the map, less than uav_radius 0.3"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("uavs[1].start: bravo starts inside an occupied voxel of the map"), std::string::npos) << text;
}

TEST_F(MissionWithMap, UavsThatStartInUnknownSpaceAreNamedWhereItCountsAsOccupied) {
  Scenario scenario = soundScenario();
  scenario.unknown_is_occupied = true;
  const std::string text = faults(scenario, "wall.bt");
  EXPECT_NE(text.find("uavs[0].start: alpha starts inside an occupied voxel"), std::string::npos) << text;
}

TEST_F(MissionWithMap, ABadMapIsOneFaultAmongTheOthers) {
  Scenario scenario = soundScenario();
  scenario.uavs[1].start = scenario.uavs[0].start + Vector3(1, 0, 0);
  const std::string text = faults(scenario, "missing.bt");
  EXPECT_NE(text.find("map.octomap: cannot use '" + directory_.file("missing.bt") + "': there is no such file"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("inside the pair ellipsoid"), std::string::npos) << text;
  EXPECT_NE(faults(soundScenario(), "scenario.yaml").find("it is no file of OctoMap"), std::string::npos);
}

}  // namespace
}  // namespace swarm_planner
