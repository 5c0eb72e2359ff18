// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Without ROS time there are no cycles, and nobody would tell the operator.
#include <gtest/gtest.h>

#include "swarm_planner/ros/clock_watch.hpp"

namespace swarm_planner {
namespace {

TEST(ClockWatch, IsContentWhileTimeGoesOn) {
  ClockWatch watch;
  for (int i = 0; i < 20; ++i) {
    watch.note(1.0 + 1e-3 * i, 0.9 * i);  // a thousandth of real time
    EXPECT_EQ(watch.fault(), "");
  }
}

TEST(ClockWatch, TellsTimeThatNeverCame) {
  ClockWatch watch;
  watch.note(0.0, 5.0);
  EXPECT_EQ(watch.fault(), "");
  watch.note(0.0, 6.5);
  EXPECT_NE(watch.fault().find("waiting for ROS time"), std::string::npos);
  watch.note(3.0, 7.0);
  EXPECT_EQ(watch.fault(), "");
}

TEST(ClockWatch, TellsTimeThatStandsStillUntilItGoesOnForthOrBack) {
  for (const double next : {10.1, 2.0}) {
    ClockWatch watch;
    watch.note(10.0, 5.0);
    watch.note(10.0, 5.9);
    EXPECT_EQ(watch.fault(), "");
    watch.note(10.0, 7.0);
    EXPECT_NE(watch.fault().find("stood still at 10.00 s for 2 s"), std::string::npos) << watch.fault();
    watch.note(next, 8.0);
    EXPECT_EQ(watch.fault(), "");
  }
}

}  // namespace
}  // namespace swarm_planner
