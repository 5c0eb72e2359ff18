// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/rviz_view.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "swarm_planner/ros/marker_shapes.hpp"

namespace swarm_planner {
namespace {

// rviz's field of view is vertical; its window is wider than high. The scene shall leave a border free.
constexpr double kTangent = 0.4142;  // of half the 45 degrees that rviz sees
constexpr double kAspect = 1.4;
constexpr double kFilled = 0.92;
// A lone hovering UAV still needs a surrounding to be seen in [m].
constexpr double kLeastView = 5.0;
// Cells along the diagonal, and the grid's width over the diagonal.
constexpr double kCells = 20.0;
constexpr double kGridShare = 2.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// The axes of a picture taken from the direction (yaw, pitch).
struct CameraAxes {
  CameraAxes(double yaw, double pitch)
      : ahead(-std::cos(yaw) * std::cos(pitch), -std::sin(yaw) * std::cos(pitch), -std::sin(pitch)),
        right(ahead.cross(Vector3::UnitZ()).normalized()),
        up(right.cross(ahead)) {}
  Vector3 ahead, right, up;
};

// Where across the picture, and at most how far ahead, a camera must be for every point p to be seen:
// |across . (p - c)| <= tangent ahead . (p - c), two half-planes for c, met in their corner.
struct Corner {
  Corner(const std::vector<Vector3>& points, const Vector3& across, const Vector3& ahead, double tangent) {
    double left = -kInfinity, right = -kInfinity;
    for (const Vector3& point : points) {
      right = std::max(right, across.dot(point) - tangent * ahead.dot(point));
      left = std::max(left, -across.dot(point) - tangent * ahead.dot(point));
    }
    offset = 0.5 * (right - left);
    depth = -0.5 * (right + left) / tangent;
  }
  double offset, depth;
};

// Moves the camera, its direction kept, to the nearest place that sees every point; its focus is as deep as `middle`.
void fitCamera(const std::vector<Vector3>& points, const Vector3& middle, YAML::Node view) {
  const CameraAxes axes(view["Yaw"].as<double>(), view["Pitch"].as<double>());
  const Corner across(points, axes.right, axes.ahead, kFilled * kAspect * kTangent);
  const Corner upward(points, axes.up, axes.ahead, kFilled * kTangent);
  const double depth = axes.ahead.dot(middle);
  setPoint(across.offset * axes.right + upward.offset * axes.up + depth * axes.ahead, view["Focal Point"]);
  view["Distance"] = std::max(kLeastView, depth - std::min(across.depth, upward.depth));
}

void fitGrid(const Eigen::AlignedBox3d& box, double diagonal, YAML::Node grid) {
  const double cell = roundedDown(diagonal / kCells);
  grid["Cell Size"] = cell;
  grid["Plane Cell Count"] = static_cast<int>(std::ceil(kGridShare * diagonal / cell));
  const Vector3 center = (box.center() / cell).array().round() * cell;
  setPoint(Vector3(center.x(), center.y(), 0.0), grid["Offset"]);
}

}  // namespace

std::string fitView(const std::string& rviz_config, const std::vector<Vector3>& points, const std::string& frame) {
  const Eigen::AlignedBox3d box = boundingBox(points);
  YAML::Node config = YAML::Load(rviz_config);
  YAML::Node manager = config["Visualization Manager"];
  YAML::Node view = manager ? manager["Views"]["Current"] : YAML::Node();
  if (!view || !view["Focal Point"] || !view["Yaw"] || !view["Pitch"]) {
    throw std::invalid_argument("the rviz configuration has no orbit camera");
  }
  const double diagonal = std::max(kLeastView, box.diagonal().norm());
  fitCamera(points, box.center(), view);
  manager["Global Options"]["Fixed Frame"] = frame;
  for (YAML::Node display : manager["Displays"]) {
    if (display["Class"].as<std::string>("") == "rviz/Grid") fitGrid(box, diagonal, display);
  }
  return YAML::Dump(config) + "\n";
}

}  // namespace swarm_planner
