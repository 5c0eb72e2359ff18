// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/sqp/separating_planes.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "swarm_planner/problem/passing_side.hpp"

namespace swarm_planner {
namespace {

constexpr double kReachableSpeed = 0.7;  // of max_speed, sideways, when judging whether a way out can be reached
constexpr double kSlight = 0.02;  // of the distance to keep; a plan that violates it by less leads past, not through
constexpr double kGetsOn = 0.5;   // of the way at full speed; a plan that leads less far does not get on
constexpr int kDropped = -1;      // in the place of a plane's segment

/// The segments of an iterate as one body sees them.
struct Passage {
  std::array<SegmentPoints, kHorizon> relative;
  std::array<std::optional<SegmentClearance>, kHorizon> near;  ///< set where the segment lies within the band
  int deepest = -1;  ///< segment that violates the distance most, and not only slightly
};

/// Whether a plan leads less far than it could although its targets are farther off.
bool isHeldUp(const UavProblem& problem, const PlanPoints& points) {
  const Vector3& end = points.back()[3];
  const double full = problem.bounds.max_speed * problem.dt * kHorizon;
  return (end - points.front()[0]).norm() < kGetsOn * full &&
         (problem.targets.back().p - end).norm() > 2.0 * problem.parameters->limits.pair_distance;
}

void findPassage(const UavProblem& problem, const MovingBody& body, const PlanPoints& points, double band,
                 Passage& passage) {
  // Plans that lean on a body violate it by a hair as its surface turns. The plane of another way past would have them
  // violate it by metres, and the step that mends this costs more than it gains. Unless leaning leads nowhere.
  double least = isHeldUp(problem, points) ? 0.0 : -kSlight * body.distance();
  passage.deepest = -1;
  for (int k = 0; k < kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    passage.relative[i] = relativeConstrainedPoints(problem, points, k, body);
    passage.near[i].reset();
    if (isBeyond(body, passage.relative[i], band)) continue;
    const SegmentClearance segment = segmentClearance(body, k, passage.relative[i]);
    if (segment.clearance > band) continue;
    passage.near[i] = segment;
    if (segment.clearance >= least) continue;
    least = segment.clearance;
    passage.deepest = k;
  }
}

/// Keeps of each segment's planes those of the nearest bodies, and their order.
void keepNearest(SegmentPlanes& planes) {
  std::array<std::size_t, kHorizon + 1> begin{};  // of each segment's part of `ranked`
  for (const SegmentPlane& plane : planes) ++begin[static_cast<std::size_t>(plane.segment) + 1];
  if (*std::max_element(begin.begin(), begin.end()) <= kMostSegmentPlanes) return;
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::array<std::size_t, kSegmentPlaneRoom> ranked;
  std::array<std::size_t, kHorizon + 1> end = begin;
  for (std::size_t i = 0; i < planes.size(); ++i) ranked[end[static_cast<std::size_t>(planes[i].segment)]++] = i;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    if (end[k] - begin[k] <= kMostSegmentPlanes) continue;
    const auto first = ranked.begin() + static_cast<std::ptrdiff_t>(begin[k]);
    const auto last = ranked.begin() + static_cast<std::ptrdiff_t>(end[k]);
    const auto kept = first + static_cast<std::ptrdiff_t>(kMostSegmentPlanes);
    std::nth_element(first, kept, last, [&planes](std::size_t a, std::size_t b) {
      if (planes[a].clearance != planes[b].clearance) return planes[a].clearance < planes[b].clearance;
      return a < b;
    });
    std::for_each(kept, last, [&planes](std::size_t i) { planes[i].segment = kDropped; });
  }
  planes.erase(
      std::remove_if(planes.begin(), planes.end(), [](const SegmentPlane& plane) { return plane.segment == kDropped; }),
      planes.end());
}

}  // namespace

void addSeparatingPlanes(const UavProblem& problem, const MovingBody& body, std::size_t index, const PlanPoints& points,
                         double band, SegmentPlanes& planes) {
  Passage passage;
  findPassage(problem, body, points, band, passage);
  std::optional<PassingSide> side;
  if (passage.deepest > 0 && !problem.parameters->limits.as_paper) {
    const auto i = static_cast<std::size_t>(passage.deepest);
    const double time = passage.deepest * problem.dt;
    const Vector3 position = midpoint(points[i]);
    side = PassingSide::choose(body.grownTo(passage.deepest), passage.relative[i], position,
                               kReachableSpeed * problem.bounds.max_speed * time, problem.bounds.workspace);
  }
  for (int k = 0; k < kHorizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!passage.near[i]) continue;
    const double clearance = passage.near[i]->clearance;
    HalfSpace half_space = passage.near[i]->half_space;
    if (side && clearance < 0.0) half_space = side->halfSpace(body.grownTo(k), midpoint(passage.relative[i]));
    planes.push_back({index, k, half_space, clearance});
  }
}

void findSeparatingPlanes(const UavProblem& problem, const Trajectory& iterate, double band, SegmentPlanes& planes) {
  planes.clear();
  PlanPoints points;
  findConstrainedPoints(problem, iterate, points);
  const Box box = planBox(points);
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    if (!problem.bodies[i].box().near(box, band)) continue;
    if (planes.size() + kHorizon > kSegmentPlaneRoom) keepNearest(planes);
    addSeparatingPlanes(problem, problem.bodies[i], i, points, band, planes);
  }
  keepNearest(planes);
}

int firstRowPoint(const FlightBounds& bounds, const SegmentPlanes& planes, std::size_t i) {
  constexpr double kSame = 1e-9;
  const auto first = static_cast<int>(firstConstrainedPoint(bounds));
  if (i == 0 || first > 0) return first;
  const SegmentPlane &before = planes[i - 1], &plane = planes[i];
  const bool is_repeated = before.body == plane.body && before.segment + 1 == plane.segment &&
                           (before.half_space.n - plane.half_space.n).cwiseAbs().maxCoeff() <= kSame &&
                           before.half_space.offset >= plane.half_space.offset - kSame;
  return is_repeated ? 1 : 0;
}

}  // namespace swarm_planner
