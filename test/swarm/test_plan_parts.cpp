// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a UAV whose plan ends badly gives up its beginning, too, or is told to fly what it cannot.
#include <gtest/gtest.h>

#include <vector>

#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/plan_parts.hpp"

namespace swarm_planner {
namespace {

class PlanPartsTest : public ::testing::Test {
 protected:
  PlanPartsTest() : bounds_(parameters_, nullptr) {
    plan_.dt = shifted_.dt = parameters_.time.sampling_time;
    // Speeds up for three stages, flies on at that speed, and turns a little.
    for (std::size_t k = 0; k < kHorizon; ++k) {
      plan_.jerks[k] = Vector3(k == 0 ? 5.0 : (k == 2 ? -5.0 : 0.0), k % 2 == 0 ? 0.5 : -0.5, 0.0);
      shifted_.jerks[k] = Vector3(0.0, 0.0, k == 0 ? 1.0 : (k == 1 ? -1.0 : 0.0));
    }
    rollOut(KinematicState(), plan_);
    rollOut(KinematicState(), shifted_);
  }

  std::vector<Trajectory> partsOf(double conflict) {
    std::vector<Trajectory> all;
    PlanParts parts(plan_, shifted_, conflict, bounds_);
    Trajectory part;
    early_stops_ = 0;
    while (parts.next(part)) {
      early_stops_ += parts.stopsEarly() ? 1 : 0;
      stayed_ = parts.stays();
      all.push_back(part);
    }
    return all;
  }

  Parameters parameters_;
  FlightBounds bounds_;
  Trajectory plan_, shifted_;
  int early_stops_ = 0;
  bool stayed_ = false;
};

TEST_F(PlanPartsTest, AnEarlyStopKeepsTheBeginningAndRestsWithinTheBounds) {
  Trajectory part = plan_;
  ASSERT_TRUE(stopEarly(8, bounds_, part));
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(part.jerks[k], plan_.jerks[k]);
  EXPECT_GT(plan_.knots[8].v.norm(), 0.3);
  EXPECT_LT(part.knots.back().v.norm(), 1e-9);
  EXPECT_LT(part.knots.back().a.norm(), 1e-9);
  EXPECT_LT((part.knots.back().p - plan_.knots[8].p).norm(), (plan_.knots.back().p - plan_.knots[8].p).norm());
  for (std::size_t k = 0; k < kHorizon; ++k) {
    EXPECT_EQ(findBreach(bounds_, part.knots[k], part.jerks[k], part.dt).bound, FlightBound::kNone);
  }
}

TEST_F(PlanPartsTest, ThereIsNoEarlyStopWhereNoneEndsWithinThePlan) {
  Trajectory part = plan_;
  EXPECT_FALSE(stopEarly(kHorizon - 1, bounds_, part));
  EXPECT_EQ(part.jerks, plan_.jerks);
}

TEST_F(PlanPartsTest, LongBeginningsComeFirstAndThenStepsBackToTheMotionFlown) {
  const std::vector<Trajectory> parts = partsOf(plan_.duration() + 1.0);
  ASSERT_EQ(early_stops_, 4);
  ASSERT_EQ(parts.size(), 7u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_LT(parts[i].knots.back().p.x(), parts[i - 1].knots.back().p.x());
    EXPECT_EQ(parts[i].jerks[3], plan_.jerks[3]);
  }
  EXPECT_LT((parts[4].jerks[0] - 0.5 * (plan_.jerks[0] + shifted_.jerks[0])).norm(), 1e-12);
  EXPECT_EQ(parts[6].jerks, shifted_.jerks);
  EXPECT_TRUE(stayed_);
}

// What the plan does up to the conflict is not kept beyond it.
TEST_F(PlanPartsTest, NoStopBeginsAfterTheConflict) {
  partsOf(8.5 * plan_.dt);
  EXPECT_EQ(early_stops_, 2);
  partsOf(0.0);
  EXPECT_EQ(early_stops_, 0);
}

}  // namespace
}  // namespace swarm_planner
