// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/mapped_space.hpp"

#include <limits>

namespace swarm_planner {
namespace {

/// How far about a plan its corridor reaches, in the way flown per stage at full speed.
constexpr double kBand = 1.5;
constexpr double kLooked = 0.5;  // beyond uav_radius, for a clearance that is reported [m]
constexpr double kSame = 1e-3;   // a clearance that is reported may be off by as much [m]

}  // namespace

void MappedSpace::findCorridor(const VoxelMap* map, const Trajectory& plan, CorridorMemory& memory,
                               UavProblem& problem) {
  builder_.buildAbout(requestFor(map, problem), plan, memory, problem);
}

void MappedSpace::findCorridorAlongPath(const VoxelMap* map, UavProblem& problem) {
  builder_.buildAlongPath(requestFor(map, problem), problem);
}

CorridorRequest MappedSpace::requestFor(const VoxelMap* map, const UavProblem& problem) const {
  const LimitParameters& limits = parameters_.limits;
  CorridorRequest request;
  request.map = map;
  request.distance = limits.uav_radius + limits.tracking_margin;
  request.margin = limits.tracking_margin;
  request.band = kBand * limits.max_speed * problem.dt + request.distance;
  return request;
}

double MappedSpace::clearance(const VoxelMap* map, const Trajectory& plan) const {
  if (map == nullptr) return std::numeric_limits<double>::infinity();
  const double radius = parameters_.limits.uav_radius;
  double least = radius + kLooked;
  Vector3 last = Vector3::Constant(std::numeric_limits<double>::infinity());
  for (const KinematicState& knot : plan.knots) {
    if ((knot.p - last).squaredNorm() < kSame * kSame) continue;
    last = knot.p;
    least = map->distance(knot.p, least);
  }
  return least < radius + kLooked ? least - radius : std::numeric_limits<double>::infinity();
}

}  // namespace swarm_planner
