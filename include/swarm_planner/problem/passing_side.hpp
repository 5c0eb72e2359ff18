// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <optional>

#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/problem/moving_body.hpp"

namespace swarm_planner {

/// Where a plan runs through a body, the half-spaces that support it towards the plan's own points contradict
/// each other (stay before it; be behind it) and a face met head on has no sideways gradient. There the half-space is
/// taken at a point moved sideways out of the body instead, on one side for the whole passage.
class PassingSide {
 public:
  /// Looks for the shortest way out across the relative motion, among eight directions. `relative`: the segment
  /// that runs deepest through the body; `position`: its middle in the planning frame; `reach` [m]: how far the UAV can
  /// move sideways until then. Directions that leave the workspace are not considered. A draw between the sides goes to
  /// the right, one between above and below to above if eastbound: opposite ways for two UAVs that meet. None if no
  /// way out is within reach.
  static std::optional<PassingSide> choose(const MovingBody& body, const SegmentPoints& relative,
                                           const Vector3& position, double reach, const Workspace& workspace);

  /// The half-space for a segment with middle `r` relative to the body.
  HalfSpace halfSpace(const MovingBody& body, const Vector3& r) const;

 private:
  PassingSide(const Vector3& along, const Vector3& sideways) : along_(along), sideways_(sideways) {}

  Vector3 along_;     ///< direction of the relative motion, unit
  Vector3 sideways_;  ///< direction of the way out, unit, across `along_`
};

}  // namespace swarm_planner
