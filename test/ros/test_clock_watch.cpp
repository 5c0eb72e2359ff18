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

TEST(ClockWatch, TellsTimeThatJumpsBackAgainAndAgainButNotOnce) {
  ClockWatch watch;
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(watch.noteJumpBack(5.0 + i), i + 1 < ClockWatch::kMostJumps);
    watch.note(20.0 + i, 5.0 + i);
    const bool told = watch.fault().find("second source of /clock") != std::string::npos;
    EXPECT_EQ(told, i + 1 >= ClockWatch::kMostJumps) << i << ": " << watch.fault();
  }
  for (double wall = 10.0; wall < 14.9; wall += 0.5) {
    watch.note(20.0 + wall, wall);
    EXPECT_NE(watch.fault(), "");
  }
  watch.note(40.0, 15.1);
  EXPECT_EQ(watch.fault(), "");
  // Seldom enough, each is one of its own: a bag that loops.
  for (int i = 0; i < 6; ++i) {
    const double wall = 100.0 + i * ClockWatch::kCalm;
    EXPECT_TRUE(watch.noteJumpBack(wall));
    watch.note(wall, wall);
    EXPECT_EQ(watch.fault(), "");
  }
}

TEST(ClockWatch, SeesTwoClocksThatNoCycleFallsBetween) {
  ClockWatch watch;
  for (int i = 0; i < 8; ++i) {
    watch.note(i % 2 == 0 ? 100.0 + i : 40.0 + i, 5.0 + i);
    const bool told = watch.fault().find("second source of /clock") != std::string::npos;
    EXPECT_EQ(told, (i + 1) / 2 >= ClockWatch::kMostJumps) << i << ": " << watch.fault();
  }
}

}  // namespace
}  // namespace swarm_planner
