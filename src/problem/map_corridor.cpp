// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/map_corridor.hpp"

#include <algorithm>

#include "swarm_planner/problem/uav_problem.hpp"

namespace swarm_planner {
namespace {

constexpr double kEnough = 0.5;       // of the distance: a segment with less leads through, or nearly
constexpr double kAmple = 1.25;       // of the distance: the free space that leaves as much serves one more segment
constexpr double kWindowShare = 0.6;  // of the band, from the window's faces likewise
constexpr double kAlike = 0.1;        // of the distance: segments whose control points lie closer are as good as equal
constexpr std::size_t kAhead = 2;     // segments after the one in work that the window has room for
constexpr int kReliefStages = 5;      // until nothing is waived any more
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

/// Whether a segment has ample room in a free space: neighbours mostly share it.
bool serves(const FreePolyhedron& polyhedron, const CorridorRequest& request, const SegmentPoints& segment) {
  const double room = kWindowShare * request.band;
  const Box& window = polyhedron.window;
  for (const Vector3& point : segment) {
    if (((point - window.min).array() < room).any() || ((window.max - point).array() < room).any()) return false;
    for (std::size_t i = 0; i < polyhedron.count; ++i) {
      const FreePlane& plane = polyhedron.planes[i];
      if (plane.n.dot(point) - plane.offset < kAmple * request.distance) return false;
    }
  }
  return true;
}

bool areAlike(const SegmentPoints& a, const SegmentPoints& b, double tolerance) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i] - b[i]).cwiseAbs().maxCoeff() > tolerance) return false;
  }
  return true;
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

void CorridorBuilder::buildAbout(const CorridorRequest& request, const Trajectory& plan, CorridorMemory& memory,
                                 UavProblem& problem) {
  problem.corridor.active = request.map != nullptr;
  if (request.map == nullptr) return;
  forgetChanged(*request.map, memory);
  known_ = &memory;
  next_known_ = 0;
  kept_.count = 0;
  findWay(problem);
  for (std::size_t k = 0; k < kHorizon; ++k) {
    planned_[k] = segmentPoints(plan.knots[k], plan.knots[k + 1], plan.dt);
  }
  // What a plan does behind a wall that it leads through does not count: from there on the path, up to where that is
  // not free either.
  bool on_way = false;
  bool has_ended = false;
  std::size_t free_stages = 0;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    if (has_ended) {
      assign(request, problem.start.p, k, problem.corridor.segments[k]);
      continue;
    }
    if (!on_way) {
      choose(request, planned_, k, false, problem);
      on_way = k > 0 && !isWithin(current_.polyhedron, planned_[k]);
      if (on_way) free_stages = freeStages(*request.map, way_);
    }
    if (!on_way) continue;
    if (k < free_stages) choose(request, way_, k, false, problem);
    has_ended = k >= free_stages || !isWithin(current_.polyhedron, way_[k]);
  }
  memory.count = kept_.count;
  std::copy_n(kept_.parts.begin(), kept_.count, memory.parts.begin());
}

void CorridorBuilder::buildAlongPath(const CorridorRequest& request, UavProblem& problem) {
  problem.corridor.active = request.map != nullptr;
  if (request.map == nullptr) return;
  known_ = nullptr;
  kept_.count = 0;
  findWay(problem);
  for (std::size_t k = 0; k < kHorizon; ++k) choose(request, way_, k, true, problem);
}

void CorridorBuilder::forgetChanged(const VoxelMap& map, CorridorMemory& memory) {
  std::size_t left = 0;
  for (std::size_t i = 0; i < memory.count; ++i) {
    const CorridorMemory::Part& part = memory.parts[i];
    if (map.fingerprint(part.polyhedron.window) != part.fingerprint) continue;
    if (left < i) memory.parts[left] = part;
    ++left;
  }
  memory.count = left;
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

void CorridorBuilder::choose(const CorridorRequest& request, const Segments& line, std::size_t k, bool or_at_its_end,
                             UavProblem& problem) {
  const bool is_served = (k > 0 && serves(current_.polyhedron, request, line[k])) || recall(request, line[k]);
  if (!is_served) findAnew(request, line, k, or_at_its_end);
  assign(request, problem.start.p, k, problem.corridor.segments[k]);
}

bool CorridorBuilder::recall(const CorridorRequest& request, const SegmentPoints& segment) {
  if (known_ == nullptr) return false;
  for (std::size_t i = next_known_; i < known_->count; ++i) {
    const CorridorMemory::Part& part = known_->parts[i];
    const bool is_alike = areAlike(part.segment, segment, kAlike * request.distance);
    if (!is_alike && !serves(part.polyhedron, request, segment)) continue;
    next_known_ = i + 1;
    current_ = part;
    keep();
    return true;
  }
  return false;
}

void CorridorBuilder::findAnew(const CorridorRequest& request, const Segments& line, std::size_t k,
                               bool or_at_its_end) {
  Box window;
  const double room = kWindowShare * request.band;
  for (std::size_t i = k; i < std::min(k + 1 + kAhead, line.size()); ++i) {
    const Vector3 beyond = Vector3::Constant(i == k ? request.band : room);
    for (const Vector3& point : line[i]) {
      window.include(point - beyond);
      window.include(point + beyond);
    }
  }
  const double enough = kEnough * request.distance;
  other_.segment = line[k];
  search_.find(*request.map, other_.segment, window, other_.polyhedron);
  if (k > 0 && or_at_its_end && other_.polyhedron.clearance < enough) {
    other_.segment = straight(line[k][3], line[k][3]);
    search_.find(*request.map, other_.segment, window, other_.polyhedron);
  }
  const bool is_enough = other_.polyhedron.clearance >= enough;
  if (k > 0 && !is_enough) return;
  current_ = other_;
  if (!is_enough) return;
  current_.fingerprint = request.map->fingerprint(current_.polyhedron.window);
  keep();
}

void CorridorBuilder::keep() {
  if (kept_.count < CorridorMemory::kMost) kept_.parts[kept_.count++] = current_;
}

void CorridorBuilder::assign(const CorridorRequest& request, const Vector3& start, std::size_t k,
                             CorridorSegment& segment) const {
  const double left = std::max(1.0 - static_cast<double>(k) / kReliefStages, 0.0);
  const FreePolyhedron& polyhedron = current_.polyhedron;
  // Right outside of the window may be a voxel: its faces are moved in like planes, as far as the segment leaves room.
  Box hull;
  for (const Vector3& point : current_.segment) hull.include(point);
  const Vector3 distance = Vector3::Constant(request.distance);
  segment.window = {(polyhedron.window.min + distance).cwiseMin(hull.min),
                    (polyhedron.window.max - distance).cwiseMax(hull.max)};
  segment.count = polyhedron.count;
  for (std::size_t i = 0; i < segment.count; ++i) {
    const FreePlane& plane = polyhedron.planes[i];
    const double lacking = plane.offset + request.distance - plane.n.dot(start);
    const double waived = left * std::clamp(lacking, 0.0, request.margin);
    segment.planes[i] = {{plane.n, plane.offset + request.distance - waived}, plane.voxel};
  }
}

}  // namespace swarm_planner
