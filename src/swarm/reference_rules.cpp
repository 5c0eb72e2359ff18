// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/reference_rules.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "swarm_planner/config/plausible.hpp"

namespace swarm_planner {

void requireReference(const std::vector<Vector3>& path, double start, double speed) {
  if (path.empty()) throw std::invalid_argument("the path has no point");
  if (path.size() > kMostPathPoints) {
    throw std::invalid_argument("the path has " + std::to_string(path.size()) + " points, at most " +
                                std::to_string(kMostPathPoints) + " allowed");
  }
  if (!std::all_of(path.begin(), path.end(), [](const Vector3& point) { return point.allFinite(); })) {
    throw std::invalid_argument("the path has a point that is not finite");
  }
  if (!std::all_of(path.begin(), path.end(), [](const Vector3& point) { return isWithin(point, kMostCoordinate); })) {
    throw std::invalid_argument("the path has a point more than 1e7 m from the origin");
  }
  if (!(start >= 0.0) || !std::isfinite(start)) throw std::invalid_argument("start must be finite and >= 0");
  if (!(speed >= 0.0 && speed <= kMostSpeed)) throw std::invalid_argument("speed must be within [0, 1000] m/s");
}

}  // namespace swarm_planner
