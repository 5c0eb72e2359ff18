// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/map_corridor.hpp"

#include <algorithm>

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {
namespace {

constexpr double kEnough = 0.5;         // of the distance: a segment with less leads through, or nearly
constexpr double kAmple = 1.25;         // of the distance: the free space that leaves as much serves one more segment
constexpr double kWindowShare = 0.6;    // of the band, from the window's faces likewise
constexpr int kReliefStages = 5;        // until nothing is waived any more
constexpr double kGatheringStages = 5;  // from rest to full speed along the path, and back to it from beside

SegmentPoints straight(const Vector3& from, const Vector3& to) {
  return {from, from + (to - from) / 3.0, from + 2.0 * (to - from) / 3.0, to};
}

bool isWithin(const FreePolyhedron& polyhedron, const SegmentPoints& segment) {
  return std::all_of(segment.begin(), segment.end(), [&polyhedron](const Vector3& point) {
    const Box& window = polyhedron.window;
    bool inside = (point.array() >= window.min.array()).all() && (point.array() <= window.max.array()).all();
    for (std::size_t i = 0; i < polyhedron.count; ++i) {
      inside = inside && polyhedron.planes[i].n.dot(point) >= polyhedron.planes[i].offset;
    }
    return inside;
  });
}

/// How many segments from the first on meet no voxel; one that comes very near to one may count as meeting it.
std::size_t freeStages(const VoxelMap& map, const std::array<SegmentPoints, kHorizon>& way) {
  constexpr int kParts = 4;
  for (std::size_t k = 0; k < way.size(); ++k) {
    const Vector3 step = (way[k][3] - way[k][0]) / kParts;
    for (int i = 0; i < kParts; ++i) {
      Box box;
      box.include(way[k][0] + i * step);
      box.include(way[k][0] + (i + 1) * step);
      if (!map.isEmpty(box)) return k;
    }
  }
  return way.size();
}

}  // namespace

void CorridorBuilder::buildAbout(const CorridorRequest& request, const Trajectory& plan, UavProblem& problem) {
  problem.corridor.active = request.map != nullptr;
  if (request.map == nullptr) return;
  findWay(problem);
  // What a plan does behind a wall that it leads through does not count: from there on the path, up to where that is
  // not free either.
  bool on_way = false;
  bool has_ended = false;
  std::size_t free_stages = 0;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    if (has_ended) {
      assign(request, problem.start.p, static_cast<int>(k), problem.corridor.segments[k]);
      continue;
    }
    const SegmentPoints segment = segmentPoints(plan.knots[k], plan.knots[k + 1], plan.dt);
    if (!on_way) {
      choose(request, segment, segment, static_cast<int>(k), problem);
      on_way = k > 0 && !isWithin(polyhedron_, segment);
      if (on_way) free_stages = freeStages(*request.map, way_);
    }
    if (!on_way) continue;
    if (k < free_stages) choose(request, way_[k], way_[k], static_cast<int>(k), problem);
    has_ended = k >= free_stages || !isWithin(polyhedron_, way_[k]);
  }
}

void CorridorBuilder::buildAlongPath(const CorridorRequest& request, UavProblem& problem) {
  problem.corridor.active = request.map != nullptr;
  if (request.map == nullptr) return;
  findWay(problem);
  for (std::size_t k = 0; k < kHorizon; ++k) {
    choose(request, way_[k], straight(way_[k][3], way_[k][3]), static_cast<int>(k), problem);
  }
}

void CorridorBuilder::findWay(const UavProblem& problem) {
  const PathPoint foot = problem.path->at(problem.progress);
  const Vector3 beside = problem.start.p - foot.position;
  const double full_speed = problem.bounds.max_speed;
  double speed = std::clamp(problem.start.v.dot(foot.tangent), 0.0, full_speed);
  double way = problem.progress;
  Vector3 from = problem.start.p;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    speed = std::min(speed + full_speed / kGatheringStages, full_speed);
    const double wanted = problem.targets[k + 1].arc_length;
    way = std::max(std::min(wanted, way + speed * problem.dt), way);
    const double left = std::max(1.0 - static_cast<double>(k + 1) / kGatheringStages, 0.0);
    const Vector3 to = problem.path->at(way).position + left * beside;
    way_[k] = straight(from, to);
    from = to;
  }
}

void CorridorBuilder::choose(const CorridorRequest& request, const SegmentPoints& first, const SegmentPoints& second,
                             int k, UavProblem& problem) {
  if (k > 0 && serves(request, first)) {
    assign(request, problem.start.p, k, problem.corridor.segments[static_cast<std::size_t>(k)]);
    return;
  }
  const double enough = kEnough * request.distance;
  search_.find(*request.map, first, request.band, other_);
  if (k > 0 && other_.clearance < enough) {
    search_.find(*request.map, second, request.band, other_);
    if (other_.clearance < enough) other_ = polyhedron_;
  }
  polyhedron_ = other_;
  assign(request, problem.start.p, k, problem.corridor.segments[static_cast<std::size_t>(k)]);
}

bool CorridorBuilder::serves(const CorridorRequest& request, const SegmentPoints& segment) const {
  const double room = kWindowShare * request.band;
  for (const Vector3& point : segment) {
    const Box& window = polyhedron_.window;
    if (((point - window.min).array() < room).any() || ((window.max - point).array() < room).any()) return false;
    for (std::size_t i = 0; i < polyhedron_.count; ++i) {
      const FreePlane& plane = polyhedron_.planes[i];
      if (plane.n.dot(point) - plane.offset < kAmple * request.distance) return false;
    }
  }
  return true;
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
