// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/marker_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kPi = 3.14159265358979323846;

void addFace(const Vector3& a, const Vector3& b, const Vector3& c, TriangleMesh& mesh) {
  mesh.push_back(a);
  mesh.push_back(b);
  mesh.push_back(c);
}

void addQuad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, TriangleMesh& mesh) {
  addFace(a, b, c, mesh);
  addFace(a, c, d, mesh);
}

// A vertical prism over a convex polygon given counter-clockwise, from z = bottom to z = top.
void addPrism(const std::vector<Vector3>& outline, double bottom, double top, TriangleMesh& mesh) {
  const Vector3 low = bottom * Vector3::UnitZ();
  const Vector3 high = top * Vector3::UnitZ();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector3& a = outline[i];
    const Vector3& b = outline[(i + 1) % outline.size()];
    addQuad(a + low, b + low, b + high, a + high, mesh);
    if (i == 0 || i + 1 == outline.size()) continue;
    addFace(outline[0] + high, a + high, b + high, mesh);
    addFace(outline[0] + low, b + low, a + low, mesh);
  }
}

std::vector<Vector3> circle(const Vector3& center, double radius, int corners) {
  std::vector<Vector3> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * kPi * i / corners;
    outline.push_back(center + radius * Vector3(std::cos(angle), std::sin(angle), 0.0));
  }
  return outline;
}

// A bar of the given half width between two points of the plane z = 0.
std::vector<Vector3> bar(const Vector3& from, const Vector3& to, double half_width) {
  const Vector3 side = half_width * Vector3::UnitZ().cross(to - from).normalized();
  return {from - side, to - side, to + side, from + side};
}

double signedPower(double base, double exponent) { return std::copysign(std::pow(std::abs(base), exponent), base); }

// How far the target of a UAV gets in a run [m].
double arcLengthAtEnd(const ScenarioUav& uav, const ReferencePath& path, const EndCondition& end) {
  if (!end.duration) return path.length();
  return std::min(path.length(), uav.target.start + uav.target.speed * *end.duration);
}

}  // namespace

TriangleMesh superellipsoidMesh(const Vector3& radii, const Vector3& exponents, int slices) {
  const auto vertex = [&](int slice, int ring, int rings) -> Vector3 {
    // Poles and seam by their exact directions: cos(pi / 2) is not zero, and a small power makes much of little.
    const double latitude = kPi * (static_cast<double>(ring) / rings - 0.5);
    const double longitude = 2.0 * kPi * (slice % slices) / slices;
    const double across = ring == 0 || ring == rings ? 0.0 : std::cos(latitude);
    Vector3 s(across * std::cos(longitude), across * std::sin(longitude), std::sin(latitude));
    s = (s.array().abs() < 1e-12).select(0.0, s);
    return Vector3(radii.x() * signedPower(s.x(), 2.0 / exponents.x()),
                   radii.y() * signedPower(s.y(), 2.0 / exponents.y()),
                   radii.z() * signedPower(s.z(), 2.0 / exponents.z()));
  };
  const int rings = std::max(2, slices / 2);
  TriangleMesh mesh;
  for (int ring = 0; ring < rings; ++ring) {
    for (int slice = 0; slice < slices; ++slice) {
      const Vector3 a = vertex(slice, ring, rings);
      const Vector3 b = vertex(slice + 1, ring, rings);
      const Vector3 c = vertex(slice + 1, ring + 1, rings);
      const Vector3 d = vertex(slice, ring + 1, rings);
      if (ring > 0) addFace(a, b, c, mesh);
      if (ring + 1 < rings) addFace(a, c, d, mesh);
    }
  }
  return mesh;
}

TriangleMesh quadrotorMesh(double width) {
  TriangleMesh mesh;
  const double rotor_radius = 0.19 * width;
  const double arm = 0.5 * width - rotor_radius;
  const double thickness = 0.03 * width;
  for (const Vector3& axis : {Vector3(1, 1, 0), Vector3(-1, 1, 0)}) {
    const Vector3 tip = arm * axis.normalized();
    addPrism(bar(-tip, tip, 0.03 * width), -thickness, thickness, mesh);
    addPrism(circle(tip, rotor_radius, 16), thickness, 2.0 * thickness, mesh);
    addPrism(circle(-tip, rotor_radius, 16), thickness, 2.0 * thickness, mesh);
  }
  addPrism(circle(Vector3::Zero(), 0.12 * width, 12), -2.0 * thickness, 3.0 * thickness, mesh);
  const Vector3 nose(0.55 * width, 0.0, 0.0);
  addPrism({Vector3(0.2 * width, -0.1 * width, 0.0), nose, Vector3(0.2 * width, 0.1 * width, 0.0)}, -thickness,
           thickness, mesh);
  return mesh;
}

std::vector<Vector3> dashes(const ReferencePath& path, double until, double dash) {
  std::vector<Vector3> ends;
  const double length = std::min(path.length(), until);
  for (double from = 0.0; from < length; from += 2.0 * dash) {
    ends.push_back(path.at(from).position);
    ends.push_back(path.at(std::min(from + dash, length)).position);
  }
  return ends;
}

std::vector<Vector3> scenePoints(const Scenario& scenario) {
  std::vector<Vector3> points;
  for (const ScenarioUav& uav : scenario.uavs) {
    points.push_back(uav.start);
    const ReferencePath path(uav.reference);
    const double length = arcLengthAtEnd(uav, path, scenario.end);
    constexpr int kSamples = 100;
    for (int i = 0; i <= kSamples; ++i) {
      Vector3 point = path.at(length * i / kSamples).position;
      if (scenario.end.target_x) point.x() = std::min(point.x(), *scenario.end.target_x);
      points.push_back(point);
    }
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    const Superellipsoid body = makeObstacle(obstacle);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 reach = body.halfExtents()[axis] * Vector3::Unit(axis);
      points.push_back(body.center() - reach);
      points.push_back(body.center() + reach);
    }
  }
  return points;
}

Eigen::AlignedBox3d boundingBox(const std::vector<Vector3>& points) {
  if (points.empty()) return Eigen::AlignedBox3d(Vector3(Vector3::Zero()));
  Eigen::AlignedBox3d box;
  for (const Vector3& point : points) box.extend(point);
  return box;
}

Vector3 statusPosition(const Eigen::AlignedBox3d& scene) {
  constexpr double kHeightShare = 0.1;  // of the diagonal
  const double top = scene.max().z() + kHeightShare * scene.diagonal().norm();
  return Vector3(scene.center().x(), scene.center().y(), top);
}

}  // namespace swarm_planner
