// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: rviz opens on an empty view.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/ros/rviz_view.hpp"

namespace swarm_planner {
namespace {

const std::vector<Vector3> kScene = {Vector3(0, 0, 0), Vector3(9, 9, 9)};

std::string shippedConfig() {
  std::ifstream file("rviz/swarm.rviz");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// A corner's place in rviz's picture: right and up, -1 to 1 from edge to edge of a square view of 45 degrees.
Vector3 projected(const YAML::Node& view, const Vector3& point) {
  const double yaw = view["Yaw"].as<double>();
  const double pitch = view["Pitch"].as<double>();
  const YAML::Node focus = view["Focal Point"];
  const Vector3 center(focus["X"].as<double>(), focus["Y"].as<double>(), focus["Z"].as<double>());
  const Vector3 back(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  const Vector3 camera = center + view["Distance"].as<double>() * back;
  const Vector3 right = Vector3::UnitZ().cross(back).normalized();
  const Vector3 up = back.cross(right);
  const double depth = (camera - point).dot(back);
  const double edge = depth * std::tan(0.785398 / 2.0);
  return Vector3((point - camera).dot(right) / edge, (point - camera).dot(up) / edge, depth);
}

TEST(RvizView, CameraSeesScenesOfAnySize) {
  const std::vector<Vector3> scenes[] = {
      {Vector3(0, -10, 5), Vector3(300, 310, 60), Vector3(0, 300, 5)},
      {Vector3(-40, 0, 20), Vector3(40, 0, 100), Vector3(0, -40, 60)},
      {Vector3(2, 3, 0), Vector3(6, 9, 2.5)},  // a room
  };
  for (const std::vector<Vector3>& scene : scenes) {
    const YAML::Node config = YAML::Load(fitView(shippedConfig(), scene, "world"));
    const YAML::Node view = config["Visualization Manager"]["Views"]["Current"];
    double widest = 0.0;
    for (const Vector3& point : scene) {
      const Vector3 place = projected(view, point);
      EXPECT_GT(place.z(), 0.0);
      EXPECT_LT(std::abs(place.x()), 1.4);
      EXPECT_LT(std::abs(place.y()), 1.0);
      widest = std::max({widest, std::abs(place.x()) / 1.4, std::abs(place.y())});
    }
    EXPECT_GT(widest, 0.8) << "the scene is a speck";
    EXPECT_EQ(config["Visualization Manager"]["Global Options"]["Fixed Frame"].as<std::string>(), "world");
  }
}

TEST(RvizView, LeavesEverythingElseAsItWas) {
  const YAML::Node before = YAML::Load(shippedConfig());
  const YAML::Node after = YAML::Load(fitView(shippedConfig(), kScene, "map"));
  for (const char* part : {"Panels", "Window Geometry", "Preferences"}) {
    EXPECT_EQ(YAML::Dump(before[part]), YAML::Dump(after[part])) << part;
  }
  const YAML::Node displays = after["Visualization Manager"]["Displays"];
  ASSERT_EQ(displays.size(), before["Visualization Manager"]["Displays"].size());
  EXPECT_EQ(displays[1]["Marker Topic"].as<std::string>(), "planner_node/markers");
}

TEST(RvizView, SaysWhenThereIsNoCameraToMove) {
  EXPECT_THROW(fitView("Panels: []", kScene, "map"), std::invalid_argument);
  EXPECT_THROW(fitView("a: [", kScene, "map"), YAML::Exception);
}

}  // namespace
}  // namespace swarm_planner
