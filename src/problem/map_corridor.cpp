// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/map_corridor.hpp"

#include <algorithm>
#include <utility>

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {
namespace {

constexpr double kEnough = 0.5;   // of the distance: a segment with less leads through, or nearly
constexpr int kReliefStages = 5;  // until nothing is waived any more

/// The straight way of the target during a stage.
SegmentPoints targetSegment(const UavProblem& problem, std::size_t k) {
  const Vector3& from = problem.targets[k].p;
  const Vector3 step = (problem.targets[k + 1].p - from) / 3.0;
  return {from, from + step, from + 2.0 * step, problem.targets[k + 1].p};
}

}  // namespace

void CorridorBuilder::build(const CorridorRequest& request, const Trajectory& plan, UavProblem& problem) {
  problem.corridor.active = request.map != nullptr;
  if (request.map == nullptr) return;
  const double enough = kEnough * request.distance;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const SegmentPoints segment = segmentPoints(plan.knots[k], plan.knots[k + 1], plan.dt);
    search_.find(*request.map, segment, request.band, other_);
    if (k > 0 && other_.clearance < enough) {
      search_.find(*request.map, targetSegment(problem, k), request.band, other_);
      if (other_.clearance < enough) other_ = polyhedron_;
    }
    polyhedron_ = other_;
    assign(request, problem.start.p, static_cast<int>(k), problem.corridor.segments[k]);
  }
}

void CorridorBuilder::assign(const CorridorRequest& request, const Vector3& start, int k,
                             CorridorSegment& segment) const {
  const double left = std::max(1.0 - static_cast<double>(k) / kReliefStages, 0.0);
  segment.window = polyhedron_.window;
  segment.count = polyhedron_.count;
  for (std::size_t i = 0; i < segment.count; ++i) {
    const FreePlane& plane = polyhedron_.planes[i];
    const double lacking = plane.offset + request.distance - plane.n.dot(start);
    const double waived = left * std::clamp(lacking, 0.0, request.margin);
    segment.planes[i] = {{plane.n, plane.offset + request.distance - waived}, plane.voxel};
  }
}

}  // namespace swarm_planner
