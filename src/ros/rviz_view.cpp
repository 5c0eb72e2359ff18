// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/rviz_view.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "swarm_planner/config/types.hpp"

namespace swarm_planner {
namespace {

// rviz's field of view is vertical; its window is wider than high. The box shall leave a border free.
constexpr double kTangent = 0.4142;  // of half the 45 degrees that rviz sees
constexpr double kAspect = 1.4;
constexpr double kFilled = 0.92;
// A lone hovering UAV still needs a surrounding to be seen in [m].
constexpr double kLeastView = 5.0;
// Cells along the diagonal, and the grid's width over the diagonal.
constexpr double kCells = 20.0;
constexpr double kGridShare = 2.0;

// The largest of 1, 2, 5 times a power of ten that is not above `value`.
double roundedDown(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= value) return step * decade;
  }
  return decade;
}

void setPoint(const Vector3& point, YAML::Node node) {
  node["X"] = point.x();
  node["Y"] = point.y();
  node["Z"] = point.z();
}

// Distance from the box's centre at which a camera that looks from (yaw, pitch) sees every corner [m]. A corner at
// (right, up, ahead) of the centre is seen if |up| <= (d + ahead) tan(fov / 2), and likewise to the right.
double fittingDistance(const Eigen::AlignedBox3d& box, double yaw, double pitch) {
  const Vector3 ahead(-std::cos(yaw) * std::cos(pitch), -std::sin(yaw) * std::cos(pitch), -std::sin(pitch));
  const Vector3 right = ahead.cross(Vector3::UnitZ()).normalized();
  const Vector3 up = right.cross(ahead);
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 offset = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - box.center();
    const double least =
        std::max(std::abs(up.dot(offset)), std::abs(right.dot(offset)) / kAspect) / (kFilled * kTangent);
    distance = std::max(distance, least - ahead.dot(offset));
  }
  return distance;
}

void fitGrid(const Eigen::AlignedBox3d& box, double diagonal, YAML::Node grid) {
  const double cell = roundedDown(diagonal / kCells);
  grid["Cell Size"] = cell;
  grid["Plane Cell Count"] = static_cast<int>(std::ceil(kGridShare * diagonal / cell));
  const Vector3 center = (box.center() / cell).array().round() * cell;
  setPoint(Vector3(center.x(), center.y(), 0.0), grid["Offset"]);
}

}  // namespace

std::string fitView(const std::string& rviz_config, const Eigen::AlignedBox3d& box, const std::string& frame) {
  YAML::Node config = YAML::Load(rviz_config);
  YAML::Node manager = config["Visualization Manager"];
  YAML::Node view = manager ? manager["Views"]["Current"] : YAML::Node();
  if (!view || !view["Focal Point"] || !view["Yaw"] || !view["Pitch"])
    throw std::invalid_argument("the rviz configuration has no orbit camera");
  const double diagonal = std::max(kLeastView, box.diagonal().norm());
  const double distance = fittingDistance(box, view["Yaw"].as<double>(), view["Pitch"].as<double>());
  view["Distance"] = std::max(kLeastView, distance);
  setPoint(box.center(), view["Focal Point"]);
  manager["Global Options"]["Fixed Frame"] = frame;
  for (YAML::Node display : manager["Displays"]) {
    if (display["Class"].as<std::string>("") == "rviz/Grid") fitGrid(box, diagonal, display);
  }
  return YAML::Dump(config) + "\n";
}

}  // namespace swarm_planner
