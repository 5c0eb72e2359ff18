// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "swarm_planner/config/types.hpp"
#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// A triangle mesh: every three points make a face, counter-clockwise seen from outside.
using TriangleMesh = std::vector<Vector3>;

/// The surface |x/a|^p_x + |y/b|^p_y + |z/c|^p_z = 1 about the origin in the body's own axes [m], exact at every
/// vertex: with s on the unit sphere, x = a sgn(s_x) |s_x|^(2 / p_x) and so on. `slices` around, half as many up.
TriangleMesh superellipsoidMesh(const Vector3& radii, const Vector3& exponents, int slices);

/// A quadrotor of the given width [m], rotor tip to rotor tip, its nose along +x.
TriangleMesh quadrotorMesh(double width);

/// A polyline as dashes of length `dash` with equal gaps up to `until` [m] of arc length: pairs of points.
std::vector<Vector3> dashes(const ReferencePath& path, double until, double dash);

/// Points that a view of a run must hold [m]: starts, extremes of the obstacles at t = 0, and references as far as the
/// run goes.
std::vector<Vector3> scenePoints(const Scenario& scenario);

/// The axis-aligned box about points; that of no points is a point at the origin.
Eigen::AlignedBox3d boundingBox(const std::vector<Vector3>& points);

/// Where the status line floats: above the middle of the scene, clear of it.
Vector3 statusPosition(const Eigen::AlignedBox3d& scene);

}  // namespace swarm_planner
