// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/corridor_drawing.hpp"

#include <Eigen/Geometry>
#include <cstddef>

namespace swarm_planner {
namespace {

// Of a plan's pieces one of so many is drawn: those between look much the same.
constexpr int kEvery = 5;

/// n . p >= offset
struct Side {
  Vector3 n;
  double offset;
};

std::vector<Side> sidesOf(const FreePolyhedron& polyhedron) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < polyhedron.count; ++i) {
    sides.push_back({polyhedron.planes[i].n, polyhedron.planes[i].offset});
  }
  for (int axis = 0; axis < 3; ++axis) {
    sides.push_back({Vector3::Unit(axis), polyhedron.window.min[axis]});
    sides.push_back({-Vector3::Unit(axis), -polyhedron.window.max[axis]});
  }
  return sides;
}

/// A square in the plane of a side, about the foot of `center`.
std::vector<Vector3> squareOn(const Side& side, const Vector3& center, double half_width) {
  const Vector3 foot = center + (side.offset - side.n.dot(center)) * side.n;
  const Vector3 u = half_width * side.n.unitOrthogonal();
  const Vector3 v = side.n.cross(u);
  return {foot + u + v, foot - u + v, foot - u - v, foot + u - v};
}

/// What of a convex polygon is on the inner side.
std::vector<Vector3> clipped(const std::vector<Vector3>& polygon, const Side& side) {
  std::vector<Vector3> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3& a = polygon[i];
    const Vector3& b = polygon[(i + 1) % polygon.size()];
    const double of_a = side.n.dot(a) - side.offset;
    const double of_b = side.n.dot(b) - side.offset;
    if (of_a >= 0.0) inside.push_back(a);
    if ((of_a < 0.0) != (of_b < 0.0)) inside.push_back(a + of_a / (of_a - of_b) * (b - a));
  }
  return inside;
}

}  // namespace

std::vector<Vector3> edgesOf(const FreePolyhedron& polyhedron) {
  const std::vector<Side> sides = sidesOf(polyhedron);
  const Vector3 center = 0.5 * (polyhedron.window.min + polyhedron.window.max);
  const double half_width = (polyhedron.window.max - polyhedron.window.min).norm();
  std::vector<Vector3> ends;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    std::vector<Vector3> face = squareOn(sides[i], center, half_width);
    for (std::size_t other = 0; other < sides.size(); ++other) {
      if (other != i) face = clipped(face, sides[other]);
    }
    for (std::size_t corner = 0; corner < face.size(); ++corner) {
      ends.push_back(face[corner]);
      ends.push_back(face[(corner + 1) % face.size()]);
    }
  }
  return ends;
}

std::vector<Vector3> CorridorDrawing::edges(const VoxelMap& map, const CommittedMotion& plan, double band) {
  std::vector<Vector3> ends;
  for (int piece = 0; piece <= plan.pieces(); piece += kEvery) {
    const SegmentPoints segment = plan.piece(piece);
    Box window;
    for (const Vector3& point : segment) {
      window.include(point - Vector3::Constant(band));
      window.include(point + Vector3::Constant(band));
    }
    search_.find(map, segment, window, polyhedron_);
    if (polyhedron_.clearance <= 0.0) continue;
    const std::vector<Vector3> more = edgesOf(polyhedron_);
    ends.insert(ends.end(), more.begin(), more.end());
  }
  return ends;
}

}  // namespace swarm_planner
