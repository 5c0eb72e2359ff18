// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/swarm/plan_check.hpp"

namespace swarm_planner {

/// Whether a motion keeps clear of another UAV's, its doubt included, on the union of their knots. `committed` as for
/// checkPlan.
CheckVerdict checkPair(const CommittedMotion& motion, const OtherMotion& other, const Vector3& committed,
                       const CheckLimits& limits);

/// The share of the other's doubt that the motion flown now keeps clear of: 1, 3/4, 1/2, 1/4 or 0. No more than that
/// may be demanded of a plan: a UAV that is lost beside another must not leave that one without any motion that passes.
double bearableShare(const CommittedMotion& flown, const OtherMotion& other, const CheckLimits& limits);

/// Of UAVs that are not seen, the motion flown now may already be nearer than their doubt allows: so much is demanded
/// of a plan at `epoch` [s] as that motion has. `rest` is left the motion's part from then on, where there is doubt.
void limitDoubts(double epoch, const CommittedMotion& flown, const CheckLimits& limits, CommittedMotion& rest,
                 std::vector<OtherMotion>& others);

}  // namespace swarm_planner
