// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/scene_markers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/marker_shapes.hpp"

namespace swarm_planner {
namespace {

using visualization_msgs::Marker;

// Around an obstacle's equator.
constexpr int kObstacleSlices = 40;
// How far ahead a velocity arrow points [s].
constexpr double kArrowTime = 4.0;
// Characters in a line of a label; a note in a single line would run off the screen.
constexpr std::size_t kLabelWidth = 36;
// So long a guide, or a corridor, is shown after it was drawn last [s].
constexpr double kGuideLifetime = 0.5;
// Slower is shown as standing still [m/s].
constexpr double kStandstill = 1e-3;

std_msgs::ColorRGBA color(float r, float g, float b, float a) {
  std_msgs::ColorRGBA rgba;
  rgba.r = r;
  rgba.g = g;
  rgba.b = b;
  rgba.a = a;
  return rgba;
}

std::vector<geometry_msgs::Point> toPoints(const std::vector<Vector3>& vectors) {
  std::vector<geometry_msgs::Point> points;
  points.reserve(vectors.size());
  for (const Vector3& vector : vectors) points.push_back(toPoint(vector));
  return points;
}

std_msgs::ColorRGBA alarmColor(float alpha) { return color(0.9F, 0.0F, 0.0F, alpha); }

std_msgs::ColorRGBA textColor(Concern concern) {
  switch (concern) {
    case Concern::kNone:
      return color(0.1F, 0.1F, 0.12F, 1.0F);
    case Concern::kCaution:
      return color(0.85F, 0.4F, 0.0F, 1.0F);
    case Concern::kAlarm:
      break;
  }
  return alarmColor(1.0F);
}

/// `text` with line breaks in place of blanks, so that lines that can be broken are no longer than `width`.
std::string wrapped(std::string text, std::size_t width) {
  std::size_t begin = 0;
  while (text.size() - begin > width) {
    std::size_t blank = text.rfind(' ', begin + width);
    if (blank == std::string::npos || blank < begin) blank = text.find(' ', begin);
    if (blank == std::string::npos) break;
    text[blank] = '\n';
    begin = blank + 1;
  }
  return text;
}

void setScale(const Vector3& scale, Marker& marker) { marker.scale = toVector3Message(scale); }

}  // namespace

std_msgs::ColorRGBA uavColor(int index, float alpha) {
  constexpr double kGoldenRatio = 0.618033988749895;
  const double hue = 6.0 * std::fmod(0.58 + kGoldenRatio * index, 1.0);
  const auto channel = [hue](double peak) {
    const double distance = std::abs(std::remainder(hue - peak, 6.0));
    const double value = std::min(1.0, std::max(0.0, 2.0 - distance));
    return static_cast<float>(0.08 + 0.84 * value);
  };
  return color(channel(0.0), channel(2.0), channel(4.0), alpha);
}

SceneMarkers::SceneMarkers(std::string frame, const MarkerSizes& sizes)
    : frame_(std::move(frame)), sizes_(sizes), uav_mesh_(toPoints(quadrotorMesh(sizes.uav))) {}

void SceneMarkers::begin(const ros::Time& stamp) {
  stamp_ = stamp;
  message_.markers.clear();
  labels_top_ = -std::numeric_limits<double>::infinity();
}

visualization_msgs::Marker& SceneMarkers::add(const char* ns, int id, int type) {
  message_.markers.emplace_back();
  Marker& marker = message_.markers.back();
  marker.header.frame_id = frame_;
  marker.header.stamp = stamp_;
  marker.ns = ns;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

void SceneMarkers::addUav(int index, const UavDrawing& uav) {
  const bool alarm = uav.concern == Concern::kAlarm;
  if (uav.located) {
    Marker& body = add("uav", index, Marker::TRIANGLE_LIST);
    body.pose.position = toPoint(uav.position);
    body.pose.orientation = toQuaternionMessage(uav.orientation);
    setScale(Vector3::Ones(), body);
    body.color = uavColor(index, 1.0F);
    body.points = uav_mesh_;

    Marker& separation = add("separation", index, Marker::SPHERE);
    separation.pose.position = body.pose.position;
    setScale(2.0 * sizes_.pair_axes, separation);
    separation.color = alarm ? alarmColor(0.45F) : uavColor(index, 0.2F);

    Marker& label = add("label", index, Marker::TEXT_VIEW_FACING);
    label.scale.z = 0.8 * sizes_.uav;
    label.text = wrapped(uav.note.empty() ? uav.name : uav.name + ": " + uav.note, kLabelWidth);
    // Text is centred about its position: of many lines the last is to stay above the UAV.
    const auto breaks = static_cast<double>(std::count(label.text.begin(), label.text.end(), '\n'));
    label.pose.position = toPoint(uav.position + (sizes_.uav + 0.5 * breaks * label.scale.z) * Vector3::UnitZ());
    label.color = textColor(uav.concern);
    labels_top_ = std::max(labels_top_, label.pose.position.z + 0.5 * (breaks + 1.0) * label.scale.z);
  }
  if (uav.trail.size() > 1) {
    Marker& trail = add("trail", index, Marker::LINE_STRIP);
    trail.points = toPoints(uav.trail);
    trail.scale.x = 0.12 * sizes_.uav;
    trail.color = uavColor(index, 0.9F);
  }
  if (uav.planned) addPlan(index, uav);
  if (uav.targeted) addTarget(index, uav);
  if (uav.guide.size() > 1) addGuide(index, uav);
  if (!uav.corridor.empty()) addCorridor(index, uav);
}

void SceneMarkers::addPlan(int index, const UavDrawing& uav) {
  const bool alarm = uav.concern == Concern::kAlarm;
  Marker& plan = add("plan", index, Marker::LINE_STRIP);
  constexpr int kPointsPerSegment = 2;
  // A line of one point is none: a motion at rest is drawn from its place to the same.
  for (int i = 0; i <= std::max(1, kPointsPerSegment * uav.plan.pieces()); ++i) {
    plan.points.push_back(toPoint(uav.plan.after(i * uav.plan.dt() / kPointsPerSegment).p));
  }
  plan.scale.x = 0.3 * sizes_.uav;
  plan.color = alarm ? alarmColor(0.9F) : uavColor(index, 0.45F);

  Marker& rest = add("rest", index, Marker::CUBE);
  rest.pose.position = toPoint(uav.plan.restingPlace());
  setScale(Vector3::Constant(0.35 * sizes_.uav), rest);
  rest.color = alarm ? alarmColor(0.9F) : uavColor(index, 0.9F);
}

void SceneMarkers::addTarget(int index, const UavDrawing& uav) {
  Marker& target = add("target", index, Marker::SPHERE);
  target.pose.position = toPoint(uav.target.p);
  setScale(Vector3::Constant(0.6 * sizes_.uav), target);
  target.color = uavColor(index, 0.9F);
}

void SceneMarkers::addGuide(int index, const UavDrawing& uav) {
  Marker& guide = add("guide", index, Marker::LINE_STRIP);
  guide.points = toPoints(uav.guide);
  guide.scale.x = 0.08 * sizes_.uav;
  guide.color = uavColor(index, 0.9F);
  // Nobody takes it away when the reference is clear again.
  guide.lifetime = ros::Duration(kGuideLifetime);
}

void SceneMarkers::addCorridor(int index, const UavDrawing& uav) {
  Marker& corridor = add("corridor", index, Marker::LINE_LIST);
  corridor.points = toPoints(uav.corridor);
  corridor.scale.x = 0.04 * sizes_.uav;
  corridor.color = uavColor(index, 0.5F);
  corridor.lifetime = ros::Duration(kGuideLifetime);
}

void SceneMarkers::addReference(int index, const MovingTarget& reference, double until) {
  const std::vector<Vector3> ends = dashes(reference.path, until, sizes_.uav);
  if (ends.empty()) return;
  Marker& line = add("reference", index, Marker::LINE_LIST);
  line.points = toPoints(ends);
  line.scale.x = 0.08 * sizes_.uav;
  line.color = color(0.2F, 0.55F, 0.25F, 0.8F);
}

void SceneMarkers::addObstacle(const TrackedObstacle& obstacle, double now) {
  const Superellipsoid body = obstacle.shape.movedBy(now - obstacle.stamp);
  const bool moves = body.velocity().norm() > kStandstill;
  Marker& surface = add("obstacle", body.id(), Marker::TRIANGLE_LIST);
  surface.points = toPoints(superellipsoidMesh(body.radii(), body.exponents(), kObstacleSlices));
  surface.pose.position = toPoint(body.center());
  surface.pose.orientation = toQuaternionMessage(yawRotation(body.yaw()));
  setScale(Vector3::Ones(), surface);
  surface.color = moves ? color(1.0F, 0.6F, 0.25F, 0.65F) : color(0.75F, 0.79F, 0.85F, 0.65F);

  if (!moves) {
    add("velocity", body.id(), Marker::ARROW).action = Marker::DELETE;
    return;
  }
  Marker& arrow = add("velocity", body.id(), Marker::ARROW);
  const Vector3 top = body.center() + (body.radii().z() + 0.5 * sizes_.uav) * Vector3::UnitZ();
  arrow.points = {toPoint(top), toPoint(top + kArrowTime * body.velocity())};
  setScale(sizes_.uav * Vector3(0.2, 0.5, 0.7), arrow);
  arrow.color = color(0.8F, 0.2F, 0.05F, 1.0F);
}

void SceneMarkers::removeObstacle(int id) {
  for (const char* ns : {"obstacle", "velocity"}) add(ns, id, Marker::TRIANGLE_LIST).action = Marker::DELETE;
}

void SceneMarkers::addStatus(const Vector3& position, const std::string& text, Concern concern) {
  Marker& line = add("status", 0, Marker::TEXT_VIEW_FACING);
  line.pose.position = toPoint(position);
  line.scale.z = sizes_.text;
  line.pose.position.z = std::max(position.z(), labels_top_ + line.scale.z);
  line.text = text;
  line.color = textColor(concern);
}

void SceneMarkers::removeAll() { add("", 0, Marker::CUBE).action = Marker::DELETEALL; }

}  // namespace swarm_planner
