// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The planes between UAVs: where they leave less room than there is, plans that are clear count as violated, and crowds
// jam.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/flight_problem.hpp"
#include "support/random.hpp"
#include "support/resting_prediction.hpp"
#include "swarm_planner/problem/moving_body.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;

/// A UAV at rest in the origin.
MovingBody atRest(double horizontal, double vertical) {
  static PredictedMotion motion;
  predictResting(Vector3::Zero(), motion);
  return MovingBody::fromUav(motion, horizontal, vertical, Vector3::UnitX());
}

/// Least clearance of a segment's control points.
double leastClearance(const HalfSpace& half_space, const SegmentPoints& relative) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3& r : relative) least = std::min(least, half_space.clearance(r));
  return least;
}

// A UAV that passes by quickly: a plane that is turned towards the middle of its way cuts into the rest of it, and
// plans that are clear count as violated.
TEST(SeparatingHalfSpace, LeavesASegmentThatPassesByItsClearance) {
  const MovingBody body = atRest(0.5, 0.5);
  SegmentPoints passing;
  for (std::size_t i = 0; i < 4; ++i) passing[i] = Vector3(-0.7 + 0.45 * static_cast<double>(i), 0.6, 0.0);
  EXPECT_NEAR(leastClearance(body.separatingHalfSpace(passing), passing), 0.1, 1e-9);
  EXPECT_LT(leastClearance(body.supportingHalfSpace(midpoint(passing)), passing), 0.1 - 1e-3);
}

TEST(SeparatingHalfSpace, LeavesNearlyAllTheRoomThatThereIs) {
  Random random(17);
  int better = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double vertical = random.uniform(0.5, 2.0);
    const MovingBody body = atRest(1.0, vertical);
    const KinematicState begin{random.uniform(0.5, 5.0) * random.direction(), random.vector(-5.0, 5.0),
                               random.vector(-5.0, 5.0)};
    const SegmentPoints relative = segmentPoints(begin, propagate(begin, random.vector(-20.0, 20.0), kDt), kDt);
    const double clearance = leastClearance(body.separatingHalfSpace(relative), relative);
    const double towards_middle = leastClearance(body.supportingHalfSpace(midpoint(relative)), relative);
    // Every direction's plane is valid: none of many leaves much more.
    double most = towards_middle;
    for (int i = 0; i < 200; ++i) {
      most = std::max(most, leastClearance(body.supportingHalfSpace(random.direction()), relative));
    }
    if (most < 0.0) continue;
    EXPECT_GE(clearance, most - 0.03 * (1.0 + most)) << "trial " << trial;
    better += clearance > towards_middle + 0.01 ? 1 : 0;
  }
  EXPECT_GT(better, 200);
}

}  // namespace
}  // namespace swarm_planner
