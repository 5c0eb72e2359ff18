// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/map_markers.hpp"

#include <ros/node_handle.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/node_constants.hpp"

namespace swarm_planner {
namespace {

constexpr double kAboveUavs = 0.5;  // [m]

bool canBeSeen(const VoxelMap& map, const VoxelIndex& voxel) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      VoxelIndex neighbour = voxel;
      neighbour[axis] += step;
      if (!map.isOccupied(neighbour)) return true;
    }
  }
  return false;
}

/// The cubes of twice the width that these lie in.
void coarsen(std::vector<VoxelIndex>& cubes) {
  for (VoxelIndex& cube : cubes) cube = cube.unaryExpr([](int i) { return i >> 1; });
  const auto inOrder = [](const VoxelIndex& a, const VoxelIndex& b) {
    return std::make_tuple(a.z(), a.y(), a.x()) < std::make_tuple(b.z(), b.y(), b.x());
  };
  std::sort(cubes.begin(), cubes.end(), inOrder);
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
}

/// From dark blue at 0 over green to pale yellow at 1.
std_msgs::ColorRGBA heightColor(double share) {
  static const Vector3 kColors[] = {{0.27, 0.35, 0.55}, {0.42, 0.66, 0.60}, {0.93, 0.83, 0.55}};
  const std::size_t below = share < 0.5 ? 0 : 1;
  const double weight = 2.0 * share - static_cast<double>(below);
  const Eigen::Vector3f mixed = ((1.0 - weight) * kColors[below] + weight * kColors[below + 1]).cast<float>();
  std_msgs::ColorRGBA color;
  color.r = mixed.x();
  color.g = mixed.y();
  color.b = mixed.z();
  color.a = 1.0F;
  return color;
}

}  // namespace

MapDrawing drawingOf(const VoxelMap& map, double top, std::size_t most) {
  std::vector<VoxelIndex> cubes;
  Box box = map.bounds();
  box.max.z() = std::min(box.max.z(), top);
  map.forEachOccupied(box, [&](const VoxelIndex& voxel) {
    const double middle = map.resolution() * (voxel.z() + 0.5);
    if (middle < top && canBeSeen(map, voxel)) cubes.push_back(voxel);
  });
  MapDrawing drawing;
  drawing.width = map.resolution();
  while (cubes.size() > most) {
    coarsen(cubes);
    drawing.width *= 2.0;
  }
  for (const VoxelIndex& cube : cubes) {
    drawing.centers.push_back(drawing.width * (cube.cast<double>() + Vector3::Constant(0.5)));
  }
  return drawing;
}

double highestPoint(const Scenario& scenario) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const ScenarioUav& uav : scenario.uavs) {
    highest = std::max(highest, uav.start.z());
    for (const Vector3& corner : uav.reference) highest = std::max(highest, corner.z());
  }
  return highest;
}

MapMarkers::MapMarkers(const Mission& mission, std::string frame, const MapOptions& options)
    : frame_(std::move(frame)),
      top_(highestPoint(mission.scenario) + kAboveUavs),
      most_(static_cast<std::size_t>(options.marker_voxels)) {
  constexpr bool kLatched = true;
  if (most_ == 0) return;
  publisher_ =
      ros::NodeHandle("~").advertise<visualization_msgs::MarkerArray>(kMapMarkersTopic, kMarkersQueueSize, kLatched);
}

void MapMarkers::show(const VoxelMap& map) {
  if (!publisher_) return;
  const MapDrawing drawing = drawingOf(map, top_, most_);
  visualization_msgs::MarkerArray message;
  message.markers.resize(1);
  visualization_msgs::Marker& marker = message.markers.front();
  marker.header.frame_id = frame_;
  marker.ns = "map";
  marker.type = visualization_msgs::Marker::CUBE_LIST;
  marker.action = drawing.centers.empty() ? visualization_msgs::Marker::DELETE : visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale = toVector3Message(Vector3::Constant(drawing.width));
  marker.color.a = 1.0F;
  double low = top_, high = -std::numeric_limits<double>::infinity();
  for (const Vector3& center : drawing.centers) {
    low = std::min(low, center.z());
    high = std::max(high, center.z());
  }
  for (const Vector3& center : drawing.centers) {
    marker.points.push_back(toPoint(center));
    marker.colors.push_back(heightColor(high > low ? (center.z() - low) / (high - low) : 0.0));
  }
  publisher_.publish(message);
}

}  // namespace swarm_planner
